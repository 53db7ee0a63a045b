// Small motions add up, and the numbers of the simulation (period, substeps, seed) are not physics.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/loop/physics/random_plant.hpp"

namespace levitas::plant {
namespace {

constexpr double kSpeed_rad_per_s = 300.0;
constexpr double kSmall_a = 1e-6;  // moves the lightest rotor by 0.15 um: (x/s0)^2 = 2e-7

class Linearity : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Linearity, testing::Range<std::uint64_t>(1, 11));

// Coils powered, no gravity, unbalance or contact: at rest this rig stays where it is.
std::vector<AxisArray> Response(const PlantConfig& config, double first_a, double second_a) {
  Plant plant(config, 1);
  plant.SetSpeed(kSpeed_rad_per_s, 0.0);
  std::vector<AxisArray> output;
  for (int i = 0; i < 100; ++i) {
    PlantCommand command = Wave(i, 0.0, kSpeed_rad_per_s);
    command.control_current_a[0] = first_a * std::sin(0.3 * i);
    command.control_current_a[3] = second_a * std::cos(0.2 * i);
    plant.Advance(command);
    output.push_back(plant.SensorOutput());
  }
  return output;
}

double Largest(const std::vector<AxisArray>& output) {
  double largest = 0.0;
  for (const auto& o : output) {
    for (const double value : o) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

TEST_P(Linearity, SmallForcesSuperpose) {
  const auto config = RandomFreeRotor(GetParam());
  const auto first = Response(config, kSmall_a, 0.0);
  const auto second = Response(config, 0.0, -2.0 * kSmall_a);
  const auto both = Response(config, kSmall_a, -2.0 * kSmall_a);
  const double scale = Largest(both);
  for (std::size_t i = 0; i < both.size(); ++i) {
    for (std::size_t axis = 0; axis < 4; ++axis) {
      EXPECT_NEAR(both[i][axis], first[i][axis] + second[i][axis], 1e-6 * scale) << i;  // (x/s0)^2
    }
  }
}

TEST_P(Linearity, FailsWithTheSquareOfTheMotionBecauseTheMagnetDoes) {
  // The force is odd, so its first deviation is cubic: of the response, the square.
  const auto config = RandomFreeRotor(GetParam());
  const auto small = Response(config, kSmall_a, 0.0);
  const auto deviation = [&](double factor) {
    const auto large = Response(config, factor * kSmall_a, 0.0);
    double most = 0.0;
    for (std::size_t i = 0; i < large.size(); ++i) {
      for (std::size_t axis = 0; axis < 4; ++axis) {
        most = std::max(most, std::abs(large[i][axis] / factor - small[i][axis]));
      }
    }
    return most / Largest(small);
  };
  // Some 1 % of the gap, far above rounding, but no coil near its zero: bias 1 A.
  const double reach = std::min(2e-6 / Largest(small), 0.2 / kSmall_a);
  // Four for the pure square; the small response deviates too, by nothing that shows.
  EXPECT_NEAR(deviation(2.0 * reach) / deviation(reach), 4.0, 0.1);
}

TEST_P(Linearity, TheSampledLinearModelPredictsTheRigForAnyDelay) {
  auto config = RandomFreeRotor(GetParam());
  config.sensor_polarity = {1.0, 1.0, 1.0, 1.0};  // the model speaks the bearing frame
  config.actuator_polarity = {1.0, 1.0, 1.0, 1.0};
  config.rotor.modal_damping_ratio = 0.005;
  config.substeps = 64;
  const auto model = Discretise(Linearise(config, kSpeed_rad_per_s), 1e-4, config.delay_samples);
  const auto measured = Response(config, kSmall_a, kSmall_a);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.a.rows());
  const double scale = Largest(measured);
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector4d input = Eigen::Vector4d::Zero();
    input[0] = kSmall_a * std::sin(0.3 * i);
    input[3] = kSmall_a * std::cos(0.2 * i);
    x = model.a * x + model.b * input;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      // The substep's second order: (1.6 us x 2 pi 2000 Hz)^2/12 = 3e-5 in the fastest filter.
      EXPECT_NEAR(model.c.row(static_cast<Eigen::Index>(axis)).dot(x),
                  measured[static_cast<std::size_t>(i)][axis], 1e-4 * scale)
          << i << " axis " << axis;
    }
  }
}

// The whole rig, gravity and contact included, sampled `per_period` times in 100 us; the command
// changes every 100 us and acts after a whole number of them, so the physics is the same.
AxisArray After15Ms(std::uint64_t seed, int per_period, int substeps) {
  auto config = RandomPlant(seed);
  config.period_ns = 100'000 / per_period;
  config.delay_samples = per_period;
  config.substeps = substeps;
  Plant plant(config, 1);
  plant.SetSpeed(kSpeed_rad_per_s, 0.0);
  for (int i = 0; i < 150; ++i) {
    for (int part = 0; part < per_period; ++part) plant.Advance(Wave(i, 0.3, kSpeed_rad_per_s));
  }
  return plant.ActuatorPosition();
}

TEST_P(Linearity, ThePeriodIsNotPhysicsOnlyTheSubstepIs) {
  const auto once = After15Ms(GetParam(), 1, 8);
  for (const int per_period : {2, 4}) {
    const auto often = After15Ms(GetParam(), per_period, 8 / per_period);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      // The same substeps to the bit but for the rounding of their length and of the angle.
      EXPECT_NEAR(often[axis], once[axis], 1e-12) << per_period << " per period, axis " << axis;
    }
  }
}

TEST_P(Linearity, PeriodsOf50And100UsConvergeToOneMotion) {
  const auto difference_m = [&](int substeps) {
    const auto slow = After15Ms(GetParam(), 1, substeps);
    const auto fast = After15Ms(GetParam(), 2, substeps);  // half the substep
    double most = 0.0;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      most = std::max(most, std::abs(fast[axis] - slow[axis]));
    }
    return most;
  };
  // Below a thousandth of the touchdown clearance at the finest, and falling: impacts begin within
  // a substep, so the order is between one and two.
  EXPECT_LT(difference_m(128), 0.19e-6);
  EXPECT_LT(difference_m(128), 0.5 * difference_m(8) + 1e-12);
}

TEST_P(Linearity, TheSeedOfTheNoiseReachesTheReadingsAndNothingElse) {
  auto config = RandomPlant(GetParam());
  for (auto& b : config.bearings) b.sensor.noise_rms_m = 1e-6;
  Plant one(config, 1);
  Plant same(config, 1);
  Plant other(config, 2);
  bool differs = false;
  for (int i = 0; i < 100; ++i) {
    const auto reading_m = one.Sample().position_m;
    EXPECT_EQ(same.Sample().position_m, reading_m) << i;
    differs = differs || other.Sample().position_m != reading_m;
    for (Plant* plant : {&one, &same, &other}) plant->Advance(Wave(i, 0.3, kSpeed_rad_per_s));
  }
  EXPECT_TRUE(differs);
  EXPECT_TRUE(std::equal(one.state().begin(), one.state().end(), other.state().begin()));
  EXPECT_EQ(one.angle_rad(), other.angle_rad());
}

}  // namespace
}  // namespace levitas::plant
