// Space has no preferred direction: turn, mirror or reverse everything, and the answer turns,
// mirrors or reverses with it. Rigs drawn from seeds, with gravity, unbalance and contact.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "tests/loop/physics/random_plant.hpp"

namespace levitas::plant {
namespace {

constexpr double kMirroredSpeed_rad_per_s = 300.0;
constexpr int kPeriods = 150;

// Positions of some 1e-4 m. Angles and sums are rounded differently on both sides; the negative
// stiffness and the contact let that grow by less than 1e6 in 15 ms.
constexpr double kTolerance_m = 1e-13;

class Symmetry : public testing::TestWithParam<std::uint64_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Symmetry, testing::Range<std::uint64_t>(1, 11));

// Half an ampere on every axis drives the rotor well into its touchdown bearings.
struct Answer {
  AxisArray reading_m{};
  AxisArray position_m{};
  AxisArray force_n{};
  double contact_n{};
};

template <class Commands>
Answer AnswerOf(const PlantConfig& config, double speed_rad_per_s, double angle_rad,
                const Commands& commands) {
  Plant plant(config, 1);
  plant.SetSpeed(speed_rad_per_s, angle_rad);
  Answer answer;
  for (int i = 0; i < kPeriods; ++i) {
    PlantCommand command = Wave(i, 0.5, speed_rad_per_s);
    command.control_current_a = commands(command.control_current_a);
    answer.reading_m = plant.Sample().position_m;
    plant.Advance(command);
    answer.contact_n = std::max(answer.contact_n, plant.ContactForce());
  }
  answer.position_m = plant.ActuatorPosition();
  answer.force_n = plant.MagnetForce();
  return answer;
}

AxisArray Same(const AxisArray& a) { return a; }
AxisArray QuarterTurn(const AxisArray& a) { return {-a[1], a[0], -a[3], a[2]}; }
AxisArray MirrorY(const AxisArray& a) { return {a[0], -a[1], a[2], -a[3]}; }
AxisArray SwapEnds(const AxisArray& a) { return {a[2], a[3], a[0], a[1]}; }

void ExpectSame(const Answer& found, const Answer& expected) {
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_NEAR(found.position_m[axis], expected.position_m[axis], kTolerance_m) << axis;
    EXPECT_NEAR(found.reading_m[axis], expected.reading_m[axis], kTolerance_m) << axis;
    // At 1e6 N/m or less.
    EXPECT_NEAR(found.force_n[axis], expected.force_n[axis], 1e6 * kTolerance_m) << axis;
  }
  EXPECT_NEAR(found.contact_n, expected.contact_n, 1e-6 * expected.contact_n);
}

template <class Map>
Answer Mapped(const Answer& a, const Map& map) {
  return {map(a.reading_m), map(a.position_m), map(a.force_n), a.contact_n};
}

// The wiring is per axis; here it must not depend on the axis.
PlantConfig Rig(std::uint64_t seed) {
  PlantConfig config = RandomPlant(seed);
  config.sensor_polarity = {1.0, 1.0, 1.0, 1.0};
  config.actuator_polarity = {1.0, 1.0, 1.0, 1.0};
  return config;
}

TEST_P(Symmetry, AQuarterTurnOfEverythingTurnsTheAnswer) {
  const PlantConfig config = Rig(GetParam());
  PlantConfig turned = config;
  turned.gravity_direction_rad += std::numbers::pi / 2.0;
  for (auto& mass : turned.unbalance) mass.phase_rad += std::numbers::pi / 2.0;
  const Answer straight = AnswerOf(config, kMirroredSpeed_rad_per_s, 0.4, Same);
  ExpectSame(AnswerOf(turned, kMirroredSpeed_rad_per_s, 0.4, QuarterTurn),
             Mapped(straight, QuarterTurn));
}

TEST_P(Symmetry, TurningTheUnbalanceIsTurningTheAngleOfTheShaft) {
  const PlantConfig config = Rig(GetParam());
  PlantConfig turned = config;
  for (auto& mass : turned.unbalance) mass.phase_rad += 0.7;
  ExpectSame(AnswerOf(turned, kMirroredSpeed_rad_per_s, 0.4, Same),
             AnswerOf(config, kMirroredSpeed_rad_per_s, 1.1, Same));
}

TEST_P(Symmetry, AMirrorReversesTheRotationAndTheAnswer) {
  const PlantConfig config = Rig(GetParam());
  PlantConfig mirrored = config;
  mirrored.gravity_direction_rad = -config.gravity_direction_rad;
  for (auto& mass : mirrored.unbalance) mass.phase_rad = -mass.phase_rad;
  const Answer straight = AnswerOf(config, kMirroredSpeed_rad_per_s, 0.4, Same);
  ExpectSame(AnswerOf(mirrored, -kMirroredSpeed_rad_per_s, -0.4, MirrorY),
             Mapped(straight, MirrorY));
  EXPECT_GT(straight.contact_n, 0.0);  // friction was part of it
}

TEST_P(Symmetry, WithoutTheReversalOfRotationTheMirrorImageIsAnother) {
  // The pair of the test before: rotation really distinguishes left from right.
  const PlantConfig config = Rig(GetParam());
  PlantConfig mirrored = config;
  mirrored.gravity_direction_rad = -config.gravity_direction_rad;
  for (auto& mass : mirrored.unbalance) mass.phase_rad = -mass.phase_rad;
  const Answer straight = Mapped(AnswerOf(config, kMirroredSpeed_rad_per_s, 0.4, Same), MirrorY);
  const Answer image = AnswerOf(mirrored, kMirroredSpeed_rad_per_s, -0.4, MirrorY);
  double difference_m = 0.0;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    difference_m =
        std::max(difference_m, std::abs(image.position_m[axis] - straight.position_m[axis]));
  }
  EXPECT_GT(difference_m, 1e4 * kTolerance_m);
}

TEST_P(Symmetry, SeenFromTheOtherEndItIsTheSameRig) {
  const PlantConfig config = Rig(GetParam());
  double length_m = 0.0;
  for (const auto& section : config.rotor.sections) length_m += section.length_m;
  const auto turn = [length_m](double& z_m) { z_m = length_m - z_m; };
  PlantConfig reversed = config;
  std::reverse(reversed.rotor.sections.begin(), reversed.rotor.sections.end());
  for (auto& disc : reversed.rotor.discs) turn(disc.z_m);
  for (auto& ring : reversed.rotor.rings) turn(ring.z_m);
  for (auto& mass : reversed.unbalance) turn(mass.z_m);
  std::reverse(reversed.bearings.begin(), reversed.bearings.end());
  for (auto& bearing : reversed.bearings) {
    turn(bearing.actuator_z_m);
    turn(bearing.sensor_z_m);
  }
  const Answer straight = AnswerOf(config, kMirroredSpeed_rad_per_s, 0.4, Same);
  const Answer other = AnswerOf(reversed, kMirroredSpeed_rad_per_s, 0.4, SwapEnds);
  const Answer expected = Mapped(straight, SwapEnds);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    // The modes of two assembled matrices: the solver's rounding, 1e-9 of 1e-4 m, has grown too.
    EXPECT_NEAR(other.position_m[axis], expected.position_m[axis], 1e-9) << axis;
    EXPECT_NEAR(other.reading_m[axis], expected.reading_m[axis], 1e-9) << axis;
  }
}

TEST_P(Symmetry, WiringIsUndoneBySignsAndByNothingElse) {
  const PlantConfig config = Rig(GetParam());
  PlantConfig wired = config;
  wired.sensor_polarity = RandomPlant(GetParam()).sensor_polarity;
  wired.actuator_polarity = RandomPlant(GetParam()).actuator_polarity;
  const auto by = [](const AxisArray& sign) {
    return [sign](AxisArray a) {
      for (std::size_t axis = 0; axis < 4; ++axis) a[axis] *= sign[axis];
      return a;
    };
  };
  const Answer straight = AnswerOf(config, kMirroredSpeed_rad_per_s, 0.4, Same);
  const Answer other = AnswerOf(wired, kMirroredSpeed_rad_per_s, 0.4, by(wired.actuator_polarity));
  EXPECT_EQ(other.position_m, straight.position_m);  // the very same numbers
  EXPECT_EQ(by(wired.sensor_polarity)(other.reading_m), straight.reading_m);
}

}  // namespace
}  // namespace levitas::plant
