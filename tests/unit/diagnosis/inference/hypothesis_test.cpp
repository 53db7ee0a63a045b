// The causes that a diagnosis considers, made from the terms of a rig.

#include "diagnosis/inference/hypothesis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

class HypothesesTest : public ::testing::Test {
 protected:
  [[nodiscard]] const Hypothesis& Of(effect::Id effect, const std::string& place) const {
    for (const Hypothesis& h : all_) {
      if (h.effect == effect && h.place == place) return h;
    }
    throw std::runtime_error("no hypothesis " + std::string(effect::At(effect).name) + " at " +
                             place);
  }
  std::vector<Term> terms_ = EveryTerm();
  std::vector<Hypothesis> all_ = MakeHypotheses(TheRig(), terms_);
};

TEST_F(HypothesesTest, EveryEffectWithATermIsConsideredAndNoOther) {
  std::set<effect::Id> of_terms;
  for (const Term& term : terms_) {
    if (term.effect) of_terms.insert(*term.effect);
  }
  std::set<effect::Id> considered;
  for (const Hypothesis& h : all_) considered.insert(h.effect);
  EXPECT_EQ(considered, of_terms);
}

TEST_F(HypothesesTest, EveryEffectCountsTheSameWhateverTheNumberOfItsPlaces) {
  std::map<effect::Id, double> weight;
  for (const Hypothesis& h : all_) weight[h.effect] += std::exp(h.log_prior);
  for (const auto& [effect, sum] : weight) EXPECT_NEAR(sum, 1.0, 1e-9) << effect::At(effect).name;
}

TEST_F(HypothesesTest, DirectionsMoveTheNamedTermsAndNoOther) {
  for (const Hypothesis& h : all_) {
    const std::set<std::size_t> named(h.terms.begin(), h.terms.end());
    ASSERT_EQ(h.directions.rows(), static_cast<Eigen::Index>(terms_.size()));
    ASSERT_GT(h.directions.cols(), 0);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const double size = h.directions.row(static_cast<Eigen::Index>(i)).norm();
      EXPECT_EQ(size > 0.0, named.contains(i)) << effect::At(h.effect).name << " at " << h.place;
    }
    for (const std::size_t i : h.terms) EXPECT_EQ(terms_[i].effect, h.effect);
  }
}

TEST_F(HypothesesTest, ABearingMovesBothAxesByTheSameAmount) {
  const Hypothesis& h = Of(effect::Id::kCurrentGain, "nde");
  ASSERT_EQ(h.directions.cols(), 1);
  ASSERT_EQ(h.terms.size(), 2U);
  EXPECT_EQ(terms_[h.terms[0]].location.name, "nde_x");
  EXPECT_EQ(terms_[h.terms[1]].location.name, "nde_y");
  EXPECT_EQ(h.directions(static_cast<Eigen::Index>(h.terms[0]), 0),
            h.directions(static_cast<Eigen::Index>(h.terms[1]), 0));
}

TEST_F(HypothesesTest, TheNameOfABearingIsNotFoundWithinAnothers) {
  // "de" ends "nde".
  for (const std::size_t i : Of(effect::Id::kCurrentGain, "de").terms) {
    EXPECT_TRUE(terms_[i].location.name.starts_with("de_")) << terms_[i].location.name;
  }
}

TEST_F(HypothesesTest, AHarmonicMovesItsCosineAndItsSine) {
  const Hypothesis& h = Of(effect::Id::kUnbalance, "z 299.2 mm");
  ASSERT_EQ(h.terms.size(), 2U);
  EXPECT_EQ(terms_[h.terms[0]].parameter, "cosine");
  EXPECT_EQ(terms_[h.terms[1]].parameter, "sine");
  EXPECT_EQ(h.directions.cols(), 2);
}

TEST_F(HypothesesTest, TheSameIsTheEffectAtItsPlaceWhateverItsColumns) {
  const Hypothesis& own = Of(effect::Id::kCurrentGain, "nde");
  Hypothesis held = own;
  held.directions *= 0.2;
  EXPECT_TRUE(AreSame(own, held));
  EXPECT_FALSE(AreSame(own, Of(effect::Id::kCurrentGain, "de")));
  EXPECT_FALSE(AreSame(own, Of(effect::Id::kSensorGain, "nde")));
  EXPECT_TRUE(IsAmong({Of(effect::Id::kCurrentGain, "de"), own}, held));
  EXPECT_FALSE(IsAmong({Of(effect::Id::kCurrentGain, "de")}, own));
  EXPECT_FALSE(IsAmong({}, own));
  EXPECT_TRUE(HasEffect({Of(effect::Id::kCurrentGain, "de")}, own.effect));
  EXPECT_FALSE(HasEffect({Of(effect::Id::kSensorGain, "nde")}, own.effect));
  const std::size_t at = IndexOf(all_, held);
  ASSERT_LT(at, all_.size());
  EXPECT_EQ(all_[at].place, "nde");
  EXPECT_EQ(all_[at].effect, effect::Id::kCurrentGain);
}

TEST_F(HypothesesTest, ASignIsAskedOfSingleAmountsOnly) {
  EXPECT_TRUE(Of(effect::Id::kEddyCurrent, "de_x").positive);
  EXPECT_FALSE(Of(effect::Id::kEddyCurrent, "every axis by itself").positive);
  EXPECT_FALSE(Of(effect::Id::kCurrentGain, "de_x").positive);
}

TEST_F(HypothesesTest, FormsOfOneLawAreNeverMixed) {
  std::size_t of_the_second_form = 0;
  for (const Hypothesis& h : all_) {
    for (const std::size_t t : h.terms) EXPECT_EQ(terms_[t].form, terms_[h.terms[0]].form);
    if (!terms_[h.terms[0]].form.empty()) ++of_the_second_form;
  }
  EXPECT_EQ(of_the_second_form, 8U);  // four axes, two bearings, all alike, each by itself
}

TEST_F(HypothesesTest, GridsOfAShapeAreAlternativesAndNeverSummed) {
  for (const Hypothesis& h : all_) {
    if (h.effect == effect::Id::kMagneticSaturation || h.effect == effect::Id::kSupportMode ||
        h.effect == effect::Id::kTouchdownRub || h.effect == effect::Id::kHysteresis) {
      // Stiffness and damping of one ring belong together.
      EXPECT_EQ(h.terms.size(), h.effect == effect::Id::kTouchdownRub ? 2U : 1U)
          << effect::At(h.effect).name << " at " << h.place;
    }
  }
}

TEST_F(HypothesesTest, RunoutIsConsideredByAxisByBearingAndByOrder) {
  EXPECT_EQ(Of(effect::Id::kSensorRunout, "order 2, de_x").terms.size(), 2U);
  EXPECT_EQ(Of(effect::Id::kSensorRunout, "order 2, de").terms.size(), 4U);
  EXPECT_EQ(Of(effect::Id::kSensorRunout, "order 2, all axes").terms.size(), 8U);
  EXPECT_EQ(Of(effect::Id::kSensorRunout, "all orders, all axes").terms.size(), 24U);
}

}  // namespace
}  // namespace levitas::diagnosis
