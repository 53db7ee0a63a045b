// Rotor and surroundings: the modal force that each effect adds, against its equation, at random
// motions. What is compared is the difference to the nominal rig, mode by mode: nothing else moves.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

#include "common/random.hpp"
#include "plant_sim/plant/time_step.hpp"
#include "plant_sim/rotor/plane_shape.hpp"
#include "tests/loop/effects/effect_rig.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant::test {
namespace {

using effect::Id;
using Complex = std::complex<double>;
const Complex kJ(0.0, 1.0);

/// A state of motion: modal coordinates as complex numbers x + jy, angle and speed of the rotor.
struct Motion {
  std::vector<double> position, velocity;  ///< x plane, then y plane
  double angle_rad{};
  double speed_rad_per_s{};

  [[nodiscard]] Complex Q(std::size_t i) const { return {position[i], position[i + 8]}; }
  [[nodiscard]] Complex Rate(std::size_t i) const { return {velocity[i], velocity[i + 8]}; }
};

Motion RandomMotion(Random& draw) {
  Motion motion;
  for (int i = 0; i < 16; ++i) {
    motion.position.push_back(1e-5 * draw.Normal());
    motion.velocity.push_back(1e-3 * draw.Normal());
  }
  motion.angle_rad = 6.0 * draw.Uniform();
  motion.speed_rad_per_s = 400.0 * draw.Uniform();
  return motion;
}

/// Modal forces with coils without current.
std::vector<Complex> ForcesOf(const PlantModel& model, const Motion& motion) {
  std::vector<double> acceleration(16);
  ForceReport report;
  const Rotation rotation{motion.speed_rad_per_s, motion.angle_rad, 0.0};
  ModalForces(model, {}, MakeSpin(rotation, MakeHeading(rotation)), motion.position.data(),
              motion.velocity.data(), acceleration.data(), report);
  std::vector<Complex> forces;
  for (std::size_t i = 0; i < 8; ++i) forces.emplace_back(acceleration[i], acceleration[i + 8]);
  return forces;
}

using Law = std::function<Complex(std::size_t mode, const Motion& motion)>;

/// The entry adds to every mode what the law says, and that alone.
void ExpectAdds(const effect::EffectConfig& entry, const Law& law) {
  const auto with = QuietWith(entry);
  Random draw(20261121);
  for (int trial = 0; trial < 50; ++trial) {
    const Motion motion = RandomMotion(draw);
    const auto changed = ForcesOf(*with, motion);
    const auto nominal = ForcesOf(*Quiet(), motion);
    for (std::size_t i = 0; i < 8; ++i) {
      const Complex expected = law(i, motion);
      // Differences of sums of numbers up to a few hundred.
      EXPECT_LT(std::abs(changed[i] - nominal[i] - expected),
                1e-11 * (1.0 + std::abs(nominal[i])) + 1e-12 * std::abs(expected))
          << effect::At(entry.id).name << " mode " << i;
    }
  }
}

double Shape(std::size_t mode, double z_m) {
  return rotor::DeflectionAt(Quiet()->parameters().modes, z_m)[mode];
}

/// Sum over modes of shape times coordinate; `first` 2 leaves the rigid ones out.
Complex At(const Motion& motion, double z_m, std::size_t first, bool rate) {
  const auto shape = rotor::DeflectionAt(Quiet()->parameters().modes, z_m);
  Complex sum = 0.0;
  for (std::size_t i = first; i < 8; ++i) sum += shape[i] * (rate ? motion.Rate(i) : motion.Q(i));
  return sum;
}

double Frequency(std::size_t mode) { return Quiet()->frequency()[mode]; }

constexpr double kZ_m = 0.23;  // between nodes: shapes are interpolated

TEST(Unbalance, PushesForwardAtOneTimesRotationWithTheSquareOfSpeed) {
  ExpectAdds(Entry(Id::kUnbalance, {kZ_m, 20e-6, 0.7}), [](std::size_t i, const Motion& m) {
    return Shape(i, kZ_m) * 20e-6 * m.speed_rad_per_s * m.speed_rad_per_s *
           std::polar(1.0, m.angle_rad + 0.7);
  });
}

TEST(ShaftBow, PullsOneModeForwardAtOneTimesRotationAtAnySpeed) {
  auto entry = Entry(Id::kShaftBow, {20e-6, -0.4});
  entry.mode = 2;
  const double largest = Quiet()->parameters().modes.shapes.col(3).cwiseAbs().maxCoeff();
  ExpectAdds(entry, [&](std::size_t i, const Motion& m) {
    if (i != 3) return Complex(0.0);
    return Frequency(3) * Frequency(3) * 20e-6 / largest * std::polar(1.0, m.angle_rad - 0.4);
  });
}

TEST(ShaftBow, DeflectsTheSlowlyTurningShaftByItsAmplitude) {
  auto entry = Entry(Id::kShaftBow, {20e-6, 0.0});
  Plant plant(QuietWith(entry), 1);
  plant.RestInTouchdown();
  PlantCommand off;
  off.amplifiers_enabled = false;
  // Free and undriven: the mode rings about its bent rest, w^2 q = w^2 b. Its mean over whole
  // oscillations is b; 0.003 of damping leaves 1/(w T) of one oscillation: 0.2 %.
  double mean = 0.0;
  constexpr int kPeriods = 10'000;
  for (int i = 0; i < kPeriods; ++i) {
    plant.Advance(off);
    mean += plant.state()[2] / kPeriods;
  }
  const double largest = Quiet()->parameters().modes.shapes.col(2).cwiseAbs().maxCoeff();
  EXPECT_NEAR(mean * largest, 20e-6, 20e-6 * 0.01);
}

TEST(ShaftAnisotropy, TurnsBackTheConjugateOfEveryBendingModeAtTwiceRotation) {
  ExpectAdds(Entry(Id::kShaftAnisotropy, {0.05, 0.3}), [](std::size_t i, const Motion& m) {
    const double w = Frequency(i);  // zero for rigid modes
    return -0.05 * w * w * std::conj(m.Q(i)) * std::polar(1.0, 2.0 * (m.angle_rad + 0.3));
  });
}

TEST(GyroscopicInertia, ScalesTheGyroscopicForceAndIsNothingAtRest) {
  ExpectAdds(Entry(Id::kGyroscopicInertia, {1.5}), [](std::size_t i, const Motion& m) {
    Complex sum = 0.0;
    const auto& g = Quiet()->parameters().modes.gyroscopic;
    for (std::size_t k = 0; k < 8; ++k) {
      sum += g(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) * m.Rate(k);
    }
    return 0.5 * kJ * m.speed_rad_per_s * sum;
  });
}

TEST(InternalDamping, ActsOnBendingAloneAndDrivesForwardWhirlAboveItsSpeed) {
  ExpectAdds(Entry(Id::kInternalDamping, {kZ_m, 20.0}), [](std::size_t i, const Motion& m) {
    if (i < 2) return Complex(0.0);
    const Complex bent = At(m, kZ_m, 2, false);
    const Complex rate = At(m, kZ_m, 2, true);
    return -20.0 * Shape(i, kZ_m) * (rate - kJ * m.speed_rad_per_s * bent);
  });
}

TEST(Misalignment, TurnsAtItsOrderWithConstantForceForwardOrBackward) {
  for (const int order : {2, 3, -3}) {
    ExpectAdds(Entry(Id::kMisalignment, {0.0, static_cast<double>(order), 1.5, 0.2}),
               [order](std::size_t i, const Motion& m) {
                 return Shape(i, 0.0) * 1.5 * std::polar(1.0, order * m.angle_rad + 0.2);
               });
  }
}

TEST(CouplingStiffness, IsASymmetricSpring) {
  ExpectAdds(Entry(Id::kCouplingStiffness, {0.0, 2e4, 5e3}), [](std::size_t i, const Motion& m) {
    const Complex r = At(m, 0.0, 0, false);
    // x: -(kd x + kc y), y: -(kd y + kc x): the cross part turns the conjugate.
    return -Shape(i, 0.0) * (2e4 * r + 5e3 * kJ * std::conj(r));
  });
}

TEST(CouplingStiffness, PushesAcrossTheDeflectionByItsWhirl) {
  ExpectAdds(Entry(Id::kCouplingStiffness, {0.0, 2e4, 0.0, 3e3}),
             [](std::size_t i, const Motion& m) {
               const Complex r = At(m, 0.0, 0, false);
               return -Shape(i, 0.0) * (2e4 - 3e3 * kJ) * r;  // 3e3 [-y, x] = 3e3 j r
             });
}

TEST(CrossCoupledStiffness, PushesAcrossTheDeflection) {
  ExpectAdds(Entry(Id::kCrossCoupledStiffness, {kZ_m, 5e3}), [](std::size_t i, const Motion& m) {
    const Complex r = At(m, kZ_m, 0, false);
    return Shape(i, kZ_m) * 5e3 * Complex(-r.imag(), r.real());  // kq [-y, x]
  });
}

TEST(StaticLoad, IsConstantInDirectionAndSize) {
  ExpectAdds(Entry(Id::kStaticLoad, {kZ_m, 5.0, -2.0}),
             [](std::size_t i, const Motion&) { return Shape(i, kZ_m) * Complex(5.0, -2.0); });
}

TEST(BreathingCrack, SoftensTheBendingAcrossItByHowFarItIsOpen) {
  constexpr double kDepth = 0.3;
  const auto& config = Quiet()->config();
  const double d = 9.525e-3;
  const double ei = 193e9 * std::numbers::pi / 64.0 * std::pow(d, 4);
  // Chondros, Dimarogonas & Yao (1998): c = 6 pi (1 - nu^2) d P(depth)/(E I), P at 0.3:
  // 0.6272 a^2 - 1.04533 a^3 + 4.5948 a^4 - 9.9736 a^5 + 20.2948 a^6 - 33.0351 a^7 + ...
  double polynomial = 0.0;
  const std::vector<double> c{0.6272,   -1.04533, 4.5948,   -9.9736, 20.2948,
                              -33.0351, 47.1063,  -40.7556, 19.6};
  for (std::size_t k = 0; k < c.size(); ++k)
    polynomial += c[k] * std::pow(kDepth, 2.0 + static_cast<double>(k));
  const double softening = 6.0 * std::numbers::pi * (1.0 - 0.29 * 0.29) * polynomial * d * ei;
  const auto curvature = rotor::CurvatureAt(Quiet()->parameters().modes, kZ_m);
  double residual = 0.0;  // what the modes yield of themselves; rigid ones do not bend
  for (std::size_t k = 2; k < 8; ++k) residual += std::pow(curvature[k] / Frequency(k), 2);
  ExpectAdds(Entry(Id::kBreathingCrack, {kZ_m, kDepth, 0.5}), [&](std::size_t i, const Motion& m) {
    Complex bend = 0.0;
    for (std::size_t k = 0; k < 8; ++k) bend += curvature[k] * m.Q(k);
    const Complex across = std::polar(1.0, m.angle_rad + 0.5);
    const double open = 0.5 * (1.0 + std::cos(m.angle_rad + 0.5 - config.gravity_direction_rad));
    const double opened = softening * open / (1.0 + softening * open * residual);
    return opened * (bend * std::conj(across)).real() * across * curvature[i];
  });
}

TEST(ModalFrequency, MovesOneModeAndKeepsDampingRatioAndShapes) {
  auto entry = Entry(Id::kModalFrequency, {95.0});
  const auto model = QuietWith(entry);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(model->frequency()[i], i == 2 ? 2.0 * std::numbers::pi * 95.0 : Frequency(i),
                1e-12);
    EXPECT_EQ(model->damping_ratio()[i], Quiet()->damping_ratio()[i]);
  }
  EXPECT_EQ(model->bearings()[0].actuator_shape, Quiet()->bearings()[0].actuator_shape);
}

TEST(ModalDamping, ChangesOneModeAndKeepsItsFrequency) {
  auto entry = Entry(Id::kModalDamping, {0.02});
  entry.mode = 3;
  const auto model = QuietWith(entry);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(model->damping_ratio()[i], i == 4 ? 0.02 : Quiet()->damping_ratio()[i]);
    EXPECT_EQ(model->frequency()[i], Frequency(i));
  }
}

TEST(RotorMass, LowersTheRigidBodyLineAndRaisesTheWeight) {
  auto rig = levitas::test::QuietFlexibleRotor();
  rig.gravity_m_per_s2 = 9.81;
  const PlantModel nominal(rig);
  PlantParameters parameters = nominal.parameters();
  parameters.config.effects.push_back(Entry(Id::kRotorMass, {1.2}));
  const PlantModel heavy(parameters);
  // Acceleration of a free rotor per newton: sum of shape products over the rigid modes.
  const auto line = [](const PlantModel& model) {
    const auto& shape = model.bearings()[0].actuator_shape;
    return shape[0] * shape[0] + shape[1] * shape[1];
  };
  EXPECT_NEAR(line(nominal) / line(heavy), 1.2, 1e-14);
  for (std::size_t i = 2; i < 8; ++i) {
    EXPECT_EQ(heavy.bearings()[1].sensor_shape[i], nominal.bearings()[1].sensor_shape[i]);
  }
  // All bodies fall alike: physical acceleration, shape times modal force, is g.
  const auto fall = [](const PlantModel& model) {
    const auto& shape = model.bearings()[0].sensor_shape;
    return std::hypot(shape[0] * model.gravity()[0] + shape[1] * model.gravity()[1],
                      shape[0] * model.gravity()[8] + shape[1] * model.gravity()[9]);
  };
  EXPECT_NEAR(fall(heavy), 9.81, 1e-10);
  EXPECT_NEAR(fall(nominal), 9.81, 1e-10);
}

}  // namespace
}  // namespace levitas::plant::test
