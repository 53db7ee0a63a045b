// Magnets: the force of each effect against its closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "tests/loop/effects/effect_rig.hpp"

namespace levitas::plant::test {
namespace {

using effect::Id;

// Of the rig: ki = 40 N/A, i0 = 1 A, s0 = 0.381 mm, so k = ki s0^2/(4 i0), ks = ki i0/s0.
constexpr double kGap_m = 0.381e-3;
constexpr double kKi_n_per_a = 40.0;
constexpr double kKs_n_per_m = kKi_n_per_a / kGap_m;
constexpr double kK = kKi_n_per_a * kGap_m * kGap_m / 4.0;

/// Magnet forces with the given control currents and places of the actuator planes.
AxisArray ForceOf(const std::shared_ptr<const PlantModel>& model, const AxisArray& control_a,
                  const AxisArray& position_m) {
  Plant plant(model, 1);
  plant.PlaceAtRest(position_m);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    plant.mutable_state()[plant.layout().coil_current + axis] = control_a[axis];
  }
  return plant.MagnetForce();
}

const AxisArray kCurrents{0.2, -0.1, 0.3, 0.15};
const AxisArray kPlaces{20e-6, -30e-6, 10e-6, 40e-6};

/// Rounding of forces of up to 100 N.
constexpr double kRounding_n = 1e-12;

TEST(CurrentGain, ScalesTheForceOfTheCurrentAndLeavesTheStiffness) {
  auto entry = Entry(Id::kCurrentGain, {0.8});
  entry.axes = 0b0101;  // x of both bearings
  const auto model = QuietWith(entry);
  const AxisArray centred = ForceOf(model, kCurrents, {});
  for (std::size_t axis = 0; axis < 4; ++axis) {
    // With the rotor centred the force is linear: ki ic.
    const double ratio = axis % 2 == 0 ? 0.8 : 1.0;
    EXPECT_NEAR(centred[axis], ratio * kKi_n_per_a * kCurrents[axis], kRounding_n);
  }
  EXPECT_EQ(ForceOf(model, {}, kPlaces), ForceOf(Quiet(), {}, kPlaces));
}

TEST(ForceConstant, ScalesTheForceOfCurrentAndDisplacementAlike) {
  const auto model = QuietWith(Entry(Id::kForceConstant, {0.8}));
  const AxisArray with = ForceOf(model, kCurrents, kPlaces);
  const AxisArray without = ForceOf(Quiet(), kCurrents, kPlaces);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(with[axis], 0.8 * without[axis], 1e-12 * std::abs(without[axis]));
  }
}

TEST(MagneticCoupling, IsTheSameFromXToYAndBackAndAddsNothingElse) {
  auto entry = Entry(Id::kMagneticCoupling, {0.1});
  entry.bearing = 1;
  const auto model = QuietWith(entry);
  const AxisArray with = ForceOf(model, kCurrents, kPlaces);
  const AxisArray without = ForceOf(Quiet(), kCurrents, kPlaces);
  EXPECT_EQ(with[0], without[0]);
  EXPECT_EQ(with[1], without[1]);
  EXPECT_NEAR(with[2] - without[2], 0.1 * kKi_n_per_a * kCurrents[3], 1e-9);
  EXPECT_NEAR(with[3] - without[3], 0.1 * kKi_n_per_a * kCurrents[2], 1e-9);
}

TEST(DisplacementStiffness, AddsAShareOfKsTimesDisplacementAndNothingWithoutIt) {
  const auto model = QuietWith(Entry(Id::kDisplacementStiffness, {1.25}));
  const AxisArray with = ForceOf(model, kCurrents, kPlaces);
  const AxisArray without = ForceOf(Quiet(), kCurrents, kPlaces);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(with[axis] - without[axis], 0.25 * kKs_n_per_m * kPlaces[axis], 1e-9);
  }
  EXPECT_EQ(ForceOf(model, kCurrents, {}), ForceOf(Quiet(), kCurrents, {}));
}

TEST(CoilAsymmetry, AddsAnEvenForceTowardsTheStrongerCoil) {
  constexpr double kRatio = 1.2;
  const double a = (kRatio - 1.0) / (kRatio + 1.0);
  const auto model = QuietWith(Entry(Id::kCoilAsymmetry, {kRatio}));
  for (const double i : {-0.4, -0.1, 0.0, 0.1, 0.4}) {
    const double force_n = ForceOf(model, {i, 0.0, 0.0, 0.0}, {})[0];
    // k/s0^2 [(1 + a)(i0 + i)^2 - (1 - a)(i0 - i)^2] = ki i + 2 a k (i0^2 + i^2)/s0^2
    const double even_n = 2.0 * a * kK * (1.0 + i * i) / (kGap_m * kGap_m);
    EXPECT_NEAR(force_n, kKi_n_per_a * i + even_n, kRounding_n);
  }
  EXPECT_NEAR(ForceOf(model, {}, {})[0], a * kKi_n_per_a / 2.0, kRounding_n);
}

TEST(MagneticSaturation, BendsTheForceOfEachCoilBelowItsSquare) {
  constexpr double kKnee_a = 1.3;
  const auto model = QuietWith(Entry(Id::kMagneticSaturation, {kKnee_a, 4.0}));
  const auto flux_a = [&](double i) {
    return i / std::pow(1.0 + std::pow(i / kKnee_a, 4.0), 0.25);
  };
  for (const double i : {-0.6, 0.0, 0.3, 0.9}) {
    const double towards = flux_a(1.0 + i);
    const double away = flux_a(1.0 - i);
    EXPECT_NEAR(ForceOf(model, {i, 0.0, 0.0, 0.0}, {})[0],
                kK / (kGap_m * kGap_m) * (towards * towards - away * away), 1e-11);
  }
  // An odd force: compression, no pull at rest.
  EXPECT_EQ(ForceOf(model, {}, {})[0], 0.0);
  EXPECT_LT(ForceOf(model, {0.9, 0.0, 0.0, 0.0}, {})[0], 0.9 * kKi_n_per_a);
}

/// Force of de_x after each period under control currents commanded one after the other.
std::vector<double> ForcesAfter(const std::shared_ptr<const PlantModel>& model,
                                const std::vector<double>& commands_a) {
  Plant plant(model, 1);
  std::vector<double> force_n;
  for (const double command_a : commands_a) {
    PlantCommand command;
    command.bias_current_a = 1.0;
    command.control_current_a[0] = command_a;
    plant.Advance(command);
    // The rotor is held where it is: only the current makes force.
    for (std::size_t s = 0; s < plant.layout().coil_current; ++s) plant.mutable_state()[s] = 0.0;
    force_n.push_back(plant.MagnetForce()[0]);
  }
  return force_n;
}

TEST(Hysteresis, LeavesTheForceOfHalfItsWidthWhenTheCurrentHasComeBackToZero) {
  constexpr double kWidth_a = 0.03;
  std::vector<double> up_and_back(100, 0.5);
  up_and_back.resize(300, 0.0);  // 100 periods of 0.1 ms: 45 time constants of the amplifier
  const auto play = ForcesAfter(QuietWith(Entry(Id::kHysteresis, {kWidth_a, 0.0})), up_and_back);
  // Play: lags by w on the way up, leads by w on the way down (larger than nominal: it lags).
  EXPECT_NEAR(play[99], kKi_n_per_a * (0.5 - kWidth_a), 1e-10);
  EXPECT_NEAR(play[299], kKi_n_per_a * kWidth_a, 1e-10);
  const auto smooth = ForcesAfter(QuietWith(Entry(Id::kHysteresis, {kWidth_a, 1.0})), up_and_back);
  // Exponential: z from -1 + ... back along 0.5 A: 1 - 2 exp(-0.5/(2 w)) of the width is left.
  EXPECT_NEAR(smooth[299], kKi_n_per_a * kWidth_a, kKi_n_per_a * kWidth_a * 1e-3);
}

TEST(EddyCurrent, AnswersAStepWithTheHalfOrderLawAndItsFullForceInTheEnd) {
  constexpr double kTau_s = 200e-6;
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.effects = {Entry(Id::kEddyCurrent, {kTau_s, 1.0})};
  // An amplifier without a lag of its own.
  for (auto& b : parameters.config.bearings) b.amplifier.bandwidth_hz = 1e5;
  const auto model = std::make_shared<const PlantModel>(parameters);
  const auto force_n = ForcesAfter(model, std::vector<double>(400, 0.1));
  for (const int after : {3, 5, 10, 30, 100, 399}) {
    // Step response of 1/(1 + sqrt(s tau)): 1 - e^(t/tau) erfc(sqrt(t/tau)).
    const double t = after * 1e-4 / kTau_s;
    const double exact = t < 500.0 ? 1.0 - std::exp(t) * std::erfc(std::sqrt(t)) : 1.0;
    // The bank's 0.6 % of the response, and half a substep of time: 12.5 us of slope.
    EXPECT_NEAR(force_n[static_cast<std::size_t>(after)] / (kKi_n_per_a * 0.1), exact, 0.012)
        << after;
  }
}

/// Force of de_x at the end of each period while the rotor is moved in x as `place` says, without
/// control current.
template <class Place>
std::vector<double> ForcesMoved(const std::shared_ptr<const PlantModel>& model, int periods,
                                const Place& place) {
  Plant plant(model, 1);
  PlantCommand command;
  command.bias_current_a = 1.0;
  Plant unit(model, 1);  // its state is that of a displacement of 1 um along x
  unit.PlaceAtRest({1e-6, 0.0, 1e-6, 0.0});
  const StateLayout& at = plant.layout();
  const auto put = [&](double time_s) {
    const auto [x_m, v_m_per_s] = place(time_s);
    for (std::size_t i = 0; i < at.modes; ++i) {
      const double per_m = unit.state()[at.q_x + i] / 1e-6;
      plant.mutable_state()[at.q_x + i] = per_m * x_m;
      plant.mutable_state()[at.v_x + i] = per_m * v_m_per_s;
    }
  };
  std::vector<double> force_n;
  for (int n = 0; n < periods; ++n) {
    put(n * 1e-4);
    plant.Advance(command);
    put((n + 1) * 1e-4);
    force_n.push_back(plant.MagnetForce()[0]);
  }
  return force_n;
}

TEST(EddyCurrent, DelaysTheForceOfADisplacementByTheSameLaw) {
  constexpr double kTau_s = 200e-6;
  static constexpr double kStep_m = 1e-6;
  const auto force_n =
      ForcesMoved(QuietWith(Entry(Id::kEddyCurrent, {kTau_s, 1.0})), 400, [](double) {
        return std::pair{kStep_m, 0.0};
      });
  for (const int after : {3, 10, 30, 100, 399}) {
    const double t = (after + 1) * 1e-4 / kTau_s;
    const double exact = t < 500.0 ? 1.0 - std::exp(t) * std::erfc(std::sqrt(t)) : 1.0;
    // The bank's 0.6 %, and the motion of the free rotor within a period: below 0.5 %.
    EXPECT_NEAR(force_n[static_cast<std::size_t>(after)] / (kKs_n_per_m * kStep_m), exact, 0.012)
        << after;
  }
}

TEST(EddyCurrent, TakesEnergyFromAVibrationByTheLagOfTheStiffness) {
  // F = ks x/(1 + sqrt(j w tau)): the part of F against the velocity is the imaginary one.
  constexpr double kTau_s = 200e-6;
  static constexpr double kAmplitude_m = 1e-6;
  constexpr int kPeriods = 2000;  // ten of the vibration count, after ten to settle
  const double w = 2.0 * std::numbers::pi * 100.0;
  const auto line = [&](const std::shared_ptr<const PlantModel>& model) {
    const auto force_n = ForcesMoved(model, kPeriods, [&](double t) {
      return std::pair{kAmplitude_m * std::cos(w * t), -w * kAmplitude_m * std::sin(w * t)};
    });
    std::complex<double> sum{};
    for (int n = kPeriods / 2; n < kPeriods; ++n) {
      sum += force_n[static_cast<std::size_t>(n)] * std::polar(1.0, -w * (n + 1) * 1e-4);
    }
    return sum * (4.0 / kPeriods) / (kKs_n_per_m * kAmplitude_m);
  };
  const auto exact = 1.0 / (1.0 + std::sqrt(std::complex<double>(0.0, w * kTau_s)));
  const auto with = line(QuietWith(Entry(Id::kEddyCurrent, {kTau_s, 1.0})));
  EXPECT_NEAR(with.real(), exact.real(), 0.012);  // the bank's 0.6 %, and a substep of time
  EXPECT_NEAR(with.imag(), exact.imag(), 0.012);
  EXPECT_LT(with.imag(), -0.1);  // far beyond those tolerances
  EXPECT_NEAR(line(Quiet()).imag(), 0.0, 1e-9);
}

TEST(AxisRotation, OfTheMagnetTurnsForcesOfCurrentAndLeavesTheIsotropicStiffness) {
  const double angle = 0.1;
  const auto model = QuietWith(Entry(Id::kAxisRotation, {angle}));  // bearing de
  const AxisArray force_n = ForceOf(model, {0.2, 0.0, 0.2, 0.0}, {});
  EXPECT_NEAR(force_n[0], kKi_n_per_a * 0.2 * std::cos(angle), kRounding_n);
  EXPECT_NEAR(force_n[1], kKi_n_per_a * 0.2 * std::sin(angle), kRounding_n);
  EXPECT_NEAR(force_n[2], kKi_n_per_a * 0.2, kRounding_n);
  EXPECT_EQ(force_n[3], 0.0);
  const AxisArray other_n = ForceOf(model, {0.0, 0.2, 0.0, 0.0}, {});
  EXPECT_NEAR(other_n[0], -kKi_n_per_a * 0.2 * std::sin(angle), kRounding_n);
  const AxisArray displaced_n = ForceOf(model, {}, {1e-6, 0.0, 0.0, 0.0});
  EXPECT_NEAR(displaced_n[0], kKs_n_per_m * 1e-6, 1e-5);  // cubic term: 2 (x/s0)^2 of 0.1 N
  EXPECT_NEAR(displaced_n[1], 0.0, 1e-5);
}

TEST(AxisRotation, OfTheSensorReadsALittleOfYOnX) {
  auto entry = Entry(Id::kAxisRotation, {0.1});
  entry.on_sensor = true;
  Plant plant(QuietWith(entry), 1);
  plant.PlaceAtRest({10e-6, 0.0, 10e-6, 0.0});
  const AxisArray reading_m = plant.SensorOutput();
  EXPECT_NEAR(reading_m[0], 10e-6 * std::cos(0.1), 1e-18);
  EXPECT_NEAR(reading_m[1], -10e-6 * std::sin(0.1), 1e-18);
  EXPECT_NEAR(reading_m[2], 10e-6, 1e-18);
  EXPECT_EQ(plant.MagnetForce(), [] {
    Plant nominal(Quiet(), 1);
    nominal.PlaceAtRest({10e-6, 0.0, 10e-6, 0.0});
    return nominal.MagnetForce();
  }());
}

}  // namespace
}  // namespace levitas::plant::test
