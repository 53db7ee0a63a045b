// What a set of causes leaves free, and whether a fit finds what is there.

#include "diagnosis/levitator/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/levitator/search.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "tests/unit/levitator/rig.hpp"

namespace levitas::levitator {
namespace {

const diagnosis::Hypothesis& CauseOf(effect::Id effect) {
  return *std::ranges::find(AllCauses(), effect, &diagnosis::Hypothesis::effect);
}

TEST(Causes, MoveParametersOfTheTableAndPayForTheirPlaces) {
  for (const diagnosis::Hypothesis& cause : AllCauses()) {
    ASSERT_FALSE(cause.terms.empty());
    EXPECT_EQ(cause.effect, Table()[cause.terms.front()].effect);
    double prior = 0.0;
    for (const diagnosis::Hypothesis& other : AllCauses()) {
      if (other.effect == cause.effect) prior += std::exp(other.log_prior);
    }
    EXPECT_NEAR(prior, 1.0, 1e-12) << effect::At(cause.effect).name;
  }
}

TEST(Causes, ReachEveryParameter) {
  for (std::size_t i = 0; i < kParameters; ++i) {
    EXPECT_TRUE(std::any_of(AllCauses().begin(), AllCauses().end(),
                            [&](const diagnosis::Hypothesis& cause) {
                              return std::find(cause.terms.begin(), cause.terms.end(), i) !=
                                     cause.terms.end();
                            }))
        << effect::At(Table()[i].effect).name;
  }
}

TEST(Alike, HoldsBothWaysAndNotForOneself) {
  EXPECT_TRUE(Alike(effect::Id::kForceConstant, effect::Id::kRotorMass));
  EXPECT_TRUE(Alike(effect::Id::kRotorMass, effect::Id::kForceConstant));
  EXPECT_FALSE(Alike(effect::Id::kRotorMass, effect::Id::kRotorMass));
  EXPECT_FALSE(Alike(effect::Id::kRotorMass, effect::Id::kExtraDelay));
}

TEST(Freedom, BoundsTolerancesAndSetsACauseFree) {
  const Freedom healthy = FreedomOf({}, 1);
  const Freedom hidden = FreedomOf({CauseOf(effect::Id::kCoilInductance)}, 1);
  ASSERT_EQ(healthy.active, hidden.active);  // the inductance has a tolerance, too
  const auto at = static_cast<Eigen::Index>(
      std::find(healthy.active.begin(), healthy.active.end(), kInductance) -
      healthy.active.begin());
  EXPECT_NEAR(healthy.most[at], kFarthest * At(kInductance).tolerance, 1e-15);
  EXPECT_GT(hidden.most[at], 1e6);
  EXPECT_GT(hidden.deviation[at], healthy.deviation[at]);
}

TEST(Freedom, AddsWhatNoHealthyRigHas) {
  EXPECT_EQ(FreedomOf({CauseOf(effect::Id::kDryFriction)}, 2).active.size(),
            FreedomOf({}, 2).active.size() + 1);
  EXPECT_EQ(FreedomOf({CauseOf(effect::Id::kDryFriction)}, 2).one_sided, 1U);
}

// Of two values whose sum is known far better than either, neither may move alone.
TEST(Freedom, KnowsOfHealthyRecordsWhatTheyKnowTogether) {
  Eigen::MatrixXd known = Eigen::MatrixXd::Zero(kParameters, kParameters);
  const auto one = static_cast<Eigen::Index>(kSupply);
  const auto other = static_cast<Eigen::Index>(kResistance);
  known(one, one) = known(other, other) = 1e-4;
  known(one, other) = known(other, one) = -0.9999e-4;
  const Freedom freedom = FreedomOf({}, 1, Zeros(0), known);
  ASSERT_EQ(freedom.active.size(), 4U) << "these two and the two of the record";
  EXPECT_NEAR(freedom.deviation[0], 0.01, 1e-12);
  EXPECT_NEAR(freedom.most[0], kFarthest * 0.01, 1e-12);
  Eigen::Vector4d together{1.0, 1.0, 0.0, 0.0};
  Eigen::Vector4d apart{1.0, -1.0, 0.0, 0.0};
  // Variance of the sum of both is 2 (1 - 0.9999) of one's: 1e4 in precision over that of the
  // difference, 2 (1 + 0.9999).
  EXPECT_NEAR(together.dot(freedom.precision * together), 2.0 / (1.0 - 0.9999), 1e-6);
  EXPECT_NEAR(apart.dot(freedom.precision * apart), 2.0 / (1.0 + 0.9999), 1e-9);
}

class FitOfAKnownRig : public testing::Test {
 protected:
  FitOfAKnownRig() {
    truth_[kProfile] = 0.6;
    truth_[kDelay] = 1.3;
    series_.push_back(test::LivelySeries(rig_, truth_, 3000, 5));
  }
  NominalRig rig_{NominalOf(test::LevitatorFile())};
  Theta truth_{Zeros(1)};
  std::vector<Series> series_;
};

TEST_F(FitOfAKnownRig, IsWorthOnOtherRecordsWhatItExplainsBlockByBlock) {
  const Misfit misfit(rig_, series_);
  const Filters filters = misfit.Whiten(truth_, kMemory);
  const diagnosis::FitGain gain = GainOn(misfit, filters, truth_, Zeros(1));
  EXPECT_NEAR(gain.value, misfit.SquaredSum(Zeros(1), filters) - misfit.SquaredSum(truth_, filters),
              1e-6 * gain.value);
  EXPECT_GT(gain.value, 3.0 * gain.deviation) << "every block gains";
  EXPECT_GT(gain.deviation, 0.0);
  const diagnosis::FitGain loss = GainOn(misfit, filters, Zeros(1), truth_);
  EXPECT_NEAR(loss.value, -gain.value, 1e-9 * gain.value);
}

TEST_F(FitOfAKnownRig, FindsItsParametersWithinThreeOfTheirDeviations) {
  const Misfit misfit(rig_, series_);
  const Fitter fitter(misfit);
  const Filters noise = misfit.Whiten(truth_, 0);
  const Fitted fitted =
      fitter.Fit({CauseOf(effect::Id::kInductanceProfile), CauseOf(effect::Id::kExtraDelay)},
                 Zeros(1), noise, 12);
  for (const Parameter p : {kProfile, kDelay}) {
    EXPECT_NEAR(fitted.theta[p], truth_[p], 3.0 * fitted.deviation[p])
        << effect::At(At(p).effect).name;
    EXPECT_LT(fitted.deviation[p], 0.1 * At(p).wide) << effect::At(At(p).effect).name;
  }
}

TEST_F(FitOfAKnownRig, SaysMoreForTheRightSetThanForAPartOfIt) {
  const Misfit misfit(rig_, series_);
  const Fitter fitter(misfit);
  const Filters noise = misfit.Whiten(truth_, 0);
  const Causes both{CauseOf(effect::Id::kInductanceProfile), CauseOf(effect::Id::kExtraDelay)};
  const double whole = fitter.Fit(both, Zeros(1), noise, 12).evidence;
  const double part = fitter.Fit({both.front()}, Zeros(1), noise, 12).evidence;
  EXPECT_GT(whole, part + 50.0);
}

TEST_F(FitOfAKnownRig, ScreensTheMissingCauseAsTheBest) {
  const Misfit misfit(rig_, series_);
  const Fitter fitter(misfit);
  const Filters noise = misfit.Whiten(truth_, 0);
  const Causes rest{CauseOf(effect::Id::kInductanceProfile)};
  const Fitted fitted = fitter.Fit(rest, Zeros(1), noise, 12);
  const std::vector<double> gain = fitter.Screen(rest, fitted, noise);
  const auto best =
      static_cast<std::size_t>(std::max_element(gain.begin(), gain.end()) - gain.begin());
  // A probe that is late reads as a delay of the command does.
  EXPECT_TRUE(AllCauses()[best].effect == effect::Id::kExtraDelay ||
              Alike(AllCauses()[best].effect, effect::Id::kExtraDelay))
      << effect::At(AllCauses()[best].effect).name;
}

TEST(Whitening, LeavesUnitVarianceOfWhatAModelLeaves) {
  const NominalRig rig = NominalOf(test::LevitatorFile());
  Series series = test::StillSeries(4000, 1.0, test::CarryingCurrent(rig, 0.0));
  Random random(6);
  for (std::size_t n = 0; n < series.size(); ++n) {
    for (auto& measured : series.measured_a) measured[n] += 5e-3 * random.Normal();
    series.position_m[n] += 16e-6 * random.Normal();
  }
  const Misfit misfit(rig, {series});
  const Filters filters = misfit.Whiten(Zeros(1), kMemory);
  const Sums sums = misfit.Linearise(Zeros(1), filters, {kSupply});
  EXPECT_NEAR(sums.ete / sums.values, 1.0, 0.02);  // its own autoregression, but for the edges
  EXPECT_NEAR(misfit.SquaredSum(Zeros(1), filters), sums.ete, 1e-6 * sums.ete);
}

}  // namespace
}  // namespace levitas::levitator
