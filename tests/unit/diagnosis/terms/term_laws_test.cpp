// What every term of a diagnosis has to obey, whatever its effect.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

/// All numbers of an addition, each in units of what is usual for it.
std::vector<double> Numbers(const Contribution& add) {
  std::vector<double> all;
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    all.push_back(add.force_n[a]);
    all.push_back(add.coil_end_a[a]);
    all.push_back(add.coil_mean_a[a]);
    all.push_back(1e6 * add.reading_m[a]);
  }
  for (const double modal : add.modal) all.push_back(modal);
  return all;
}

double Largest(const Contribution& add) {
  double largest = 0.0;
  for (const double number : Numbers(add)) largest = std::max(largest, std::abs(number));
  return largest;
}

std::string Label(const Term& term) {
  return std::string(term.effect_name()) + ", " + term.location.name + ", " + term.parameter;
}

class TermLaws : public ::testing::Test {
 protected:
  Random random_{20261121};
  std::vector<Term> terms_ = EveryTerm();
};

TEST_F(TermLaws, NothingIsAddedAtZero) {
  for (Term& term : terms_) {
    const SamplePoint moment = Drawn(random_, 300.0);
    EXPECT_EQ(Largest(Added(term, moment, 0.0)), 0.0) << Label(term);
  }
}

TEST_F(TermLaws, WhatIsCalledLinearIsLinear) {
  for (const Term& term : terms_) {
    if (!term.linear) continue;
    const SamplePoint moment = Drawn(random_, 300.0);
    Term once_term = term;
    Term thrice_term = term;
    const auto once = Numbers(Added(once_term, moment, term.scale()));
    const auto thrice = Numbers(Added(thrice_term, moment, 3.0 * term.scale()));
    for (std::size_t i = 0; i < once.size(); ++i) {
      ASSERT_NEAR(thrice[i], 3.0 * once[i], 1e-9 * (1.0 + std::abs(thrice[i]))) << Label(term);
    }
  }
}

TEST_F(TermLaws, WhatIsNotCalledLinearIsSmoothAboutZero) {
  for (const Term& term : terms_) {
    if (term.linear || term.positive) continue;  // sqrt(tau) begins at a corner
    const SamplePoint moment = Drawn(random_, 300.0);
    Term small_term = term;
    Term smaller_term = term;
    const auto small = Numbers(Added(small_term, moment, term.step));
    const auto smaller = Numbers(Added(smaller_term, moment, 0.5 * term.step));
    double apart = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < small.size(); ++i) {
      apart += std::pow(small[i] - 2.0 * smaller[i], 2);
      size += std::pow(small[i], 2);
    }
    // Second order: a twentieth of the first at most at the step used for slopes.
    EXPECT_LE(apart, 0.0025 * size) << Label(term);
  }
}

TEST_F(TermLaws, WhatTurnsWithTheShaftIsSilentAtRest) {
  std::size_t rotating = 0;
  for (Term& term : terms_) {
    if (!term.rotating) continue;
    ++rotating;
    EXPECT_EQ(Largest(Added(term, Drawn(random_, 0.0), term.scale())), 0.0) << Label(term);
  }
  EXPECT_GT(rotating, 5U);
}

/// What follows the shaft's angle, and no speed, stays where the shaft stops.
TEST_F(TermLaws, WhatACouplingPushesStaysAtRest) {
  std::size_t seen = 0;
  for (Term& term : terms_) {
    if (term.effect != effect::Id::kMisalignment) continue;
    ++seen;
    double largest = 0.0;
    for (int draw = 0; draw < 20; ++draw) {
      largest = std::max(largest, Largest(Added(term, Drawn(random_, 0.0), term.scale())));
    }
    EXPECT_GT(largest, 0.0) << Label(term);
  }
  EXPECT_EQ(seen, 8U);
}

TEST_F(TermLaws, WhatIsNotSilentAtRestOrTurningAddsSomethingFinite) {
  for (Term& term : terms_) {
    double largest = 0.0;
    for (int period = 0; period < 50; ++period) {
      const Contribution add = Added(term, Drawn(random_, 300.0), term.scale());
      for (const double number : Numbers(add)) ASSERT_TRUE(std::isfinite(number)) << Label(term);
      largest = std::max(largest, Largest(add));
    }
    // A rub needs an orbit, a slew limit a step: those may stay silent in these draws.
    if (term.effect_name() == "touchdown_rub" || term.effect_name() == "amplifier_slew") continue;
    EXPECT_GT(largest, 0.0) << Label(term);
  }
}

TEST_F(TermLaws, ACopyHasMemoryOfItsOwn) {
  for (Term& term : terms_) {
    Term disturbed = term;
    Random other(7);
    for (int period = 0; period < 20; ++period) {
      static_cast<void>(Added(disturbed, Drawn(other, 300.0), disturbed.scale()));
    }
    Term fresh = term;
    const SamplePoint moment = Drawn(random_, 300.0);
    EXPECT_EQ(Numbers(Added(fresh, moment, fresh.scale())),
              Numbers(Added(term, moment, term.scale())))
        << Label(term);
  }
}

TEST_F(TermLaws, EveryTermHasAScaleAndAStep) {
  for (const Term& term : terms_) {
    EXPECT_GT(term.scale(), 0.0) << Label(term);
    EXPECT_NE(term.step, 0.0) << Label(term);
    EXPECT_FALSE(term.location.name.empty()) << Label(term);
    EXPECT_FALSE(term.parameter.empty()) << Label(term);
    EXPECT_TRUE(static_cast<bool>(term.drive) || static_cast<bool>(term.read)) << Label(term);
    // Without a name it is a nuisance and nothing else.
    if (!term.effect) {
      EXPECT_TRUE(term.nuisance()) << Label(term);
    }
  }
}

TEST_F(TermLaws, NoTwoTermsAreTheSameNumber) {
  std::vector<std::string> labels;
  for (const Term& term : terms_) labels.push_back(Label(term));
  std::sort(labels.begin(), labels.end());
  const auto twice = std::adjacent_find(labels.begin(), labels.end());
  EXPECT_EQ(twice, labels.end()) << *twice;
}

TEST_F(TermLaws, AHealthyRigIsKnownToItsTolerances) {
  const Tolerances tolerances;
  const auto tolerance = [this](const std::string& effect, const std::string& place) {
    return Named(terms_, effect, place).tolerance;
  };
  EXPECT_EQ(tolerance("current_gain", "de_x"), tolerances.current_gain);
  EXPECT_EQ(tolerance("sensor_gain", "nde_y"), tolerances.sensor_gain);
  EXPECT_EQ(tolerance("modal_frequency", "mode 1"), tolerances.modal_frequency);
  EXPECT_EQ(tolerance("unbalance", "z 299.2 mm"), tolerances.unbalance_kg_m);
  // Opposed coils are never quite alike: without this tolerance two of fifteen healthy rigs had one
  // axis named for it.
  EXPECT_EQ(tolerance("coil_asymmetry", "de_x"), 0.02);
  // What a healthy rig does not have at all is no nuisance.
  EXPECT_EQ(tolerance("eddy_current", "de_x"), 0.0);
}

}  // namespace
}  // namespace levitas::diagnosis
