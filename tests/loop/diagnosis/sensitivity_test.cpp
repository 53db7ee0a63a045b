// Derivatives of the innovations against finite differences of the nonlinear model.

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "benchmark/accuracy/trial.hpp"
#include "common/rotational_speed.hpp"
#include "diagnosis/inference/search.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

class Sensitivity : public ::testing::Test {
 protected:
  Sensitivity() : Sensitivity(accuracy::LoadTestRig("flexible_rotor", {"flexible_rotor"})) {}
  explicit Sensitivity(accuracy::TestRig bench) : bench_(std::move(bench)) {
    accuracy::TrialPlan plan;
    plan.seed = 21;
    plan.bits_per_axis = 500;
    plan.runup_s = 1.0;
    spinning_ = accuracy::MakeTrial(bench_, plan).records[1];
    gains_ = search_.DesignGains({spinning_}, kFast);
  }

  [[nodiscard]] std::size_t Find(const std::string& effect) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].effect_name() == effect) return i;
    }
    ADD_FAILURE() << effect;
    return 0;
  }

  [[nodiscard]] std::size_t FindAt(const std::string& effect, const std::string& place) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].effect_name() == effect && terms_[i].location.name == place) return i;
    }
    ADD_FAILURE() << effect << " " << place;
    return 0;
  }

  [[nodiscard]] Trajectory Run(const std::vector<double>& theta) const {
    return search_.Run({spinning_}, gains_, PointAt(terms_, theta)).front();
  }

  /// |propagated - difference| / |difference| over all axes and the samples that count.
  [[nodiscard]] double Disagreement(const std::string& effect, double step) const {
    return Disagreement(Find(effect), step, std::vector<double>(terms_.size(), 0.0));
  }

  /// The same about a rig that differs from its file by theta.
  [[nodiscard]] double Disagreement(const std::string& effect, double step,
                                    const std::vector<double>& theta,
                                    bool about_the_file = false) const {
    return Disagreement(Find(effect), step, theta, about_the_file);
  }
  [[nodiscard]] double Disagreement(std::size_t at, double step, std::vector<double> theta,
                                    bool about_the_file = false) const {
    const Trajectory base = Run(theta);
    const LinearChange change = about_the_file ? LinearChange{} : ChangeOf(terms_, theta);
    SensitivityBlock block(view_, LaneModels(view_, base.gains, change), terms_, theta, {at});
    theta[at] += step;
    const Trajectory moved = Run(theta);
    std::array<float, kMaxAxes * kLanes> d{};
    double apart = 0.0;
    double size = 0.0;
    for (std::size_t n = 0; n < base.moments.size(); ++n) {
      block.Step(base.moments[n], d.data());
      if (!base.moments[n].counts) continue;
      for (std::size_t a = 0; a < view_.axes; ++a) {
        const double propagated = static_cast<double>(d[a * kLanes]) / terms_[at].scale();
        const double difference = static_cast<double>(moved.moments[n].innovation_m[a] -
                                                      base.moments[n].innovation_m[a]) /
                                  step;
        apart += std::pow(propagated - difference, 2);
        size += std::pow(difference, 2);
      }
    }
    return std::sqrt(apart / size);
  }

  accuracy::TestRig bench_;
  RigView view_{bench_.rig.numbers, bench_.rig.plant};
  std::vector<Term> terms_ = AllTerms(view_, Tolerances{}, 50e-6);
  Search search_{view_, terms_};
  Record spinning_;
  Gains gains_;
};

// Steps move the innovations by some micrometres: far above single precision (1e-11 m), and the
// model's curvature is below a percent there. What is left is the middle of the period at which
// forces are taken: 3 % is asked of a screen whose candidates are refitted.
TEST_F(Sensitivity, OfAMagnetsGainIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("current_gain", 0.01), 0.03);
}
TEST_F(Sensitivity, OfASensorsGainIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("sensor_gain", 0.01), 0.03);
}
TEST_F(Sensitivity, OfUnbalanceIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("unbalance", 5e-6), 0.03);
}
TEST_F(Sensitivity, OfAModesFrequencyIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("modal_frequency", 0.003), 0.05);
}

/// A rig off by its tolerances, one standard deviation of each, up and down in turn, under the slow
/// observer, which leaves the modes to themselves.
class SensitivityAway : public Sensitivity {
 protected:
  SensitivityAway() { gains_ = search_.DesignGains({spinning_}, kSlow); }

  [[nodiscard]] std::vector<double> Away() const {
    std::vector<double> theta(terms_.size(), 0.0);
    double sign = 1.0;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (!terms_[i].nuisance()) continue;
      sign = -sign;
      theta[i] = sign * terms_[i].tolerance;
    }
    return theta;
  }
};

// A mode that is a per cent off rings at another frequency than the file's: about the file's mode
// the derivative of its frequency drifts out of phase with what the model does.
TEST_F(SensitivityAway, OfAModesFrequencyIsTheDifferenceOfTheModel) {
  EXPECT_GT(Disagreement("modal_frequency", 0.001, Away(), true), 0.2);
  EXPECT_LT(Disagreement("modal_frequency", 0.001, Away()), 0.1);
}
TEST_F(SensitivityAway, OfAMagnetsGainIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("current_gain", 0.01, Away()), 0.1);
}
TEST_F(SensitivityAway, OfASensorsGainIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("sensor_gain", 0.01, Away()), 0.1);
}
TEST_F(SensitivityAway, OfASensorsPlaceIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("sensor_position", 2e-4, Away()), 0.1);
}
TEST_F(SensitivityAway, OfAModesShapeAtASensorIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement(FindAt("", "sensor de, mode 1"), 0.01, Away()), 0.1);
}
TEST_F(SensitivityAway, OfUnbalanceIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("unbalance", 5e-6, Away()), 0.1);
}
TEST_F(SensitivityAway, OfAModesDampingIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("modal_damping", 0.1, Away()), 0.1);
}

/// Discs of four times the polar inertia at 9000 rpm, under the slow observer: gyroscopic moments
/// split the bending modes by more than they are damped.
class SensitivityOfAFastRotor : public Sensitivity {
 protected:
  SensitivityOfAFastRotor() : Sensitivity(Fast()) {
    gains_ = search_.DesignGains({spinning_}, kSlow);
  }

  static accuracy::TestRig Fast() {
    accuracy::TestRig bench = accuracy::LoadTestRig("flexible_rotor", {"flexible_rotor"});
    for (rotor::Disc& disc : bench.rig.plant.rotor.discs) disc.polar_inertia_kg_m2 *= 4.0;
    bench.trials.spinning_from_rpm = bench.trials.spinning_to_rpm = 9000.0;
    bench.rig.numbers.max_speed_rad_per_s = RpmToRadPerS(9000.0);
    return bench;
  }
};

TEST_F(SensitivityOfAFastRotor, OfAModesFrequencyIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("modal_frequency", 0.001), 0.1) << spinning_.mean_speed_rad_per_s;
}
TEST_F(SensitivityOfAFastRotor, OfAMagnetsGainIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("current_gain", 0.01), 0.1) << spinning_.mean_speed_rad_per_s;
}
TEST_F(Sensitivity, OfTheGyroscopicMomentsIsTheDifferenceOfTheModel) {
  EXPECT_LT(Disagreement("gyroscopic_inertia", 1e-4), 0.05);
}

TEST_F(Sensitivity, OfADelayIsTheDifferenceOfTheModel) {
  // Acts through the steps of the currents, which derivatives take in one piece: 4 % measured once.
  EXPECT_LT(Disagreement("extra_delay", 0.05), 0.06);
}

// A slewing amplifier rectifies noisy commands: what a bandwidth or a delay does to that moves the
// rotor more than what they do to the current by themselves.
TEST_F(SensitivityAway, OfTheTimingOfASlewingAmplifierIsTheDifferenceOfTheModel) {
  std::vector<double> theta = Away();
  theta[FindAt("amplifier_slew", "4000 A/s")] = 1.0;
  // Of the currents alone: 0.4 and 0.6.
  EXPECT_LT(Disagreement("extra_delay", 0.02, theta), 0.25);
  EXPECT_LT(Disagreement("amplifier_bandwidth", 0.01, theta), 0.1);
}

TEST_F(Sensitivity, OfWhatDoesNotDependOnOtherTermsInTheBlockIsTheSameAlone) {
  const std::vector<double> theta(terms_.size(), 0.0);
  const Trajectory run = Run(theta);
  const LaneModels model(view_, run.gains, LinearChange{});
  const std::size_t gain = Find("current_gain");
  const std::size_t mass = Find("unbalance");
  SensitivityBlock alone(view_, model, terms_, theta, {mass});
  SensitivityBlock both(view_, model, terms_, theta, {gain, mass});
  std::array<float, kMaxAxes * kLanes> one{};
  std::array<float, kMaxAxes * kLanes> two{};
  for (std::size_t n = 0; n < 3000; ++n) {
    alone.Step(run.moments[n], one.data());
    both.Step(run.moments[n], two.data());
    for (std::size_t a = 0; a < view_.axes; ++a) {
      ASSERT_EQ(one[a * kLanes], two[a * kLanes + 1]) << "sample " << n;
    }
  }
}

}  // namespace
}  // namespace levitas::diagnosis
