// One period of the derivatives in closed form: free and forced modes, a relaxing coil, the
// sensors' filters, the observer's correction; lanes that know nothing of each other.

#include "diagnosis/model/tangent_batch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/dense/exponential.hpp"
#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kBending = 2;  // the first mode behind the two rigid ones

class TangentTest : public testing::Test {
 protected:
  TangentTest()
      : gain_(analysis::DesignObserver(TheRig().model->config(), {})),
        model_(TheRig(), gain_, {}) {}

  [[nodiscard]] static double Period() { return TheRig().period_s; }
  /// What the magnet of an axis does to a mode, per newton.
  [[nodiscard]] static double Shape(std::size_t axis, std::size_t mode) {
    return TheRig().magnet(axis).actuator_shape[mode];
  }
  [[nodiscard]] static double At(const Lane& lane, std::size_t l = 0) {
    return static_cast<double>(lane.value[l]);
  }
  void Periods(int count, const SamplePoint& moment) {
    for (int n = 0; n < count; ++n) Advance(model_, moment, state_);
  }
  [[nodiscard]] std::array<Lane, kMaxAxes> Readings() const {
    std::array<Lane, kMaxAxes> reading{};
    Reading(model_, Rest(), state_, reading);
    return reading;
  }
  static LaneState Random8(std::uint64_t seed) {
    Random random(seed);
    LaneState s;
    const auto fill = [&random](auto& lanes, double size) {
      for (Lane& lane : lanes) {
        for (std::size_t l = 0; l < kLanes; ++l) {
          lane.value[l] = static_cast<float>(size * random.Normal());
        }
      }
    };
    fill(s.q, 1e-5);
    fill(s.v, 1e-3);
    fill(s.coil, 0.1);
    fill(s.sensor, 1e-5);
    fill(s.force, 1.0);
    fill(s.add_modal, 1.0);
    fill(s.add_force, 1.0);
    fill(s.add_coil_end, 0.01);
    fill(s.add_coil_mean, 0.01);
    return s;
  }

  analysis::ObserverGain gain_;
  TangentBatch model_;
  LaneState state_;
};

TEST_F(TangentTest, AFreeModeRingsAtItsFrequencyAndDecaysWithItsDamping) {
  const double w = TheRig().omega_rad_per_s[kBending];
  const double z = TheRig().damping_ratio[kBending];
  const double damped = w * std::sqrt(1.0 - z * z);
  state_.q[kBending].value[0] = 1.0F;
  for (int n = 1; n <= 300; ++n) {
    Periods(1, Rest());
    const double t = n * Period();
    const double decay = std::exp(-z * w * t);
    const double q = decay * (std::cos(damped * t) + z * w / damped * std::sin(damped * t));
    // Single precision: 300 steps of 6e-8, in the phase as well.
    EXPECT_NEAR(At(state_.q[kBending]), q, 1e-4) << n;
  }
  // The other plane and the other modes stay at rest.
  EXPECT_EQ(At(state_.q[TheRig().modes + kBending]), 0.0);
  EXPECT_EQ(At(state_.q[kBending + 1]), 0.0);
}

TEST_F(TangentTest, AChangedModeRingsAsTheChangeSays) {
  LinearChange change;
  change.mode[kBending].frequency = 1.05;
  change.mode[kBending].damping = 2.0;
  model_ = TangentBatch(TheRig(), gain_, change);
  const double w = 1.05 * TheRig().omega_rad_per_s[kBending];
  // The ratio of 2 z w is 2: the decay rate z w doubles.
  const double rate = 2.0 * TheRig().damping_ratio[kBending] * TheRig().omega_rad_per_s[kBending];
  const double damped = std::sqrt(w * w - rate * rate);
  state_.q[kBending].value[0] = 1.0F;
  Periods(200, Rest());
  const double t = 200 * Period();
  const double q =
      std::exp(-rate * t) * (std::cos(damped * t) + rate / damped * std::sin(damped * t));
  EXPECT_NEAR(At(state_.q[kBending]), q, 1e-4);  // single precision, as above
}

// Discs that a speed of 12 000 rpm splits far: without magnets the rotor is linear and its motion
// known, [q; v]' = [v; -w^2 q - 2 z w v -+ W G v] (docs/derivations.md (10)). Velocities held at
// what they are before the gyroscopic moments turn them would grow by (W g)^2 T/2 per second, here
// by many times within the tenth of a second.
TEST_F(TangentTest, AFastRotorsModesDecayAsFastAsTheyDo) {
  plant::PlantConfig fast = FlexibleRotor().plant;
  for (rotor::Disc& disc : fast.rotor.discs) disc.polar_inertia_kg_m2 *= 2.0;
  const RigView rig(FlexibleRotor().numbers, fast);
  model_ = TangentBatch(rig, gain_, {});
  constexpr double kSpeed = 12'000.0 / 60.0 * 2.0 * std::numbers::pi;
  const auto modes = static_cast<Eigen::Index>(rig.modes);
  const Eigen::Map<const Eigen::MatrixXd> g(rig.model->gyroscopic().data(), modes, modes);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4 * modes, 4 * modes);
  a.topRightCorner(2 * modes, 2 * modes).setIdentity();
  for (Eigen::Index i = 0; i < 2 * modes; ++i) {
    const auto mode = static_cast<std::size_t>(i % modes);
    const double w = rig.omega_rad_per_s[mode];
    a(2 * modes + i, i) = -w * w;
    a(2 * modes + i, 2 * modes + i) = -2.0 * rig.damping_ratio[mode] * w;
  }
  a.block(2 * modes, 3 * modes, modes, modes) -= kSpeed * g;
  a.block(3 * modes, 2 * modes, modes, modes) += kSpeed * g;
  const Eigen::MatrixXd period = (a * Period()).exp();
  Eigen::VectorXd exact = Eigen::VectorXd::Zero(4 * modes);
  exact[2 * modes + static_cast<Eigen::Index>(kBending)] = 1.0;
  state_.v[kBending].value[0] = 1.0F;
  SamplePoint moment;
  moment.Turn(0.0, kSpeed, Period());
  Advance(model_, moment, state_);
  exact = period * exact;
  double apart = 0.0;
  double size = 0.0;
  for (int n = 1; n < 1000; ++n) {
    Advance(model_, moment, state_);
    exact = period * exact;
    for (Eigen::Index i = 0; i < 2 * modes; ++i) {
      const double v = At(state_.v[static_cast<std::size_t>(i)]);
      apart += std::pow(v - exact[2 * modes + i], 2);
      size += std::pow(exact[2 * modes + i], 2);
    }
  }
  EXPECT_LT(std::sqrt(apart / size), 0.1) << apart << " of " << size;
}

TEST_F(TangentTest, AConstantForceAcceleratesARigidModeByItsShape) {
  constexpr std::size_t kAxis = 1;  // of the y plane
  state_.force[kAxis].value[3] = 2.0F;
  Periods(100, Rest());
  const double t = 100 * Period();
  for (std::size_t rigid = 0; rigid < 2; ++rigid) {
    const double acceleration = 2.0 * Shape(kAxis, rigid);
    const std::size_t at = TheRig().modes + rigid;
    EXPECT_NEAR(At(state_.q[at], 3), 0.5 * acceleration * t * t,
                1e-5 * std::abs(acceleration) * t * t);  // single precision over 100 steps
    EXPECT_NEAR(At(state_.v[at], 3), acceleration * t, 1e-5 * std::abs(acceleration) * t);
    EXPECT_EQ(At(state_.q[at], 2), 0.0);     // another lane
    EXPECT_EQ(At(state_.q[rigid], 3), 0.0);  // the other plane
  }
  EXPECT_EQ(At(state_.force[kAxis], 3), 2.0);  // the unknown force stays
}

TEST_F(TangentTest, ARelaxingCoilMovesARigidModeAsItsExponentialForce) {
  // f(t) = F exp(-t/tau): v = F tau (1 - e), q = F tau (t - tau (1 - e)). The first period's force
  // falls while it acts; `coil_lead` is what a held mean would miss of the displacement.
  SamplePoint moment;
  moment.force_per_a[0] = 40.0F;
  state_.coil[0].value[0] = 0.5F;
  Periods(1, moment);
  const double tau = 1.0 / (2.0 * std::numbers::pi * TheRig().bearing(0).amplifier.bandwidth_hz);
  const double force = 0.5 * 40.0 * Shape(0, 0);
  const double gone = 1.0 - std::exp(-Period() / tau);
  const double v = force * tau * gone;
  const double q = force * tau * (Period() - tau * gone);
  EXPECT_NEAR(At(state_.v[0]), v, 1e-5 * std::abs(v));
  EXPECT_NEAR(At(state_.q[0]), q, 1e-5 * std::abs(q));
  EXPECT_NEAR(At(state_.coil[0]), 0.5 * (1.0 - gone), 1e-6);
  // Held at its mean, the force would displace by half its impulse times the period.
  EXPECT_GT(std::abs(0.5 * v * Period() - q), 0.02 * std::abs(q));
}

TEST_F(TangentTest, AReadingSettlesAtTheSensorsGainTimesTheDisplacement) {
  state_.q[0].value[0] = 1e-5F;  // rigid, at rest
  Periods(200, Rest());
  const auto reading = Readings();
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    const double expected =
        a % 2 == 1 ? 0.0
                   : 1e-5 * TheRig().bearing(a).sensor.gain * TheRig().magnet(a).sensor_shape[0];
    EXPECT_NEAR(At(reading[a]), expected, 1e-5 * 1e-5) << a;  // single precision of 1e-5 m
  }
}

TEST_F(TangentTest, AddedReadingsFollowDisplacementAndVelocity) {
  LinearChange change;
  change.axis[2].sensor_q[kBending] = 0.3;
  change.axis[2].sensor_v[kBending] = 2e-5;
  model_ = TangentBatch(TheRig(), gain_, change);
  state_.q[kBending].value[5] = 1e-5F;
  state_.v[kBending].value[5] = 1e-2F;
  const auto reading = Readings();
  EXPECT_NEAR(At(reading[2], 5), 0.3e-5 + 2e-7, 1e-12);  // single precision
  EXPECT_EQ(At(reading[0], 5), 0.0);
  EXPECT_EQ(At(reading[2], 4), 0.0);
}

TEST_F(TangentTest, CorrectionAddsTheGainTimesTheInnovationToEveryState) {
  std::array<Lane, kMaxAxes> e{};
  e[0].value[1] = 2e-6F;
  e[3].value[1] = -1e-6F;
  Correct(model_, e, state_);
  const plant::StateLayout& at = TheRig().model->layout();
  Eigen::VectorXd innovation = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(TheRig().axes));
  innovation[0] = 2e-6;
  innovation[3] = -1e-6;
  const Eigen::VectorXd expected = gain_.state * innovation;
  const Eigen::VectorXd force = gain_.force_n_per_m * innovation;
  const double largest = expected.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < 2 * TheRig().modes; ++i) {
    // Single precision of the larger of two products.
    EXPECT_NEAR(At(state_.q[i], 1), expected[static_cast<Eigen::Index>(at.q_x + i)],
                1e-6 * largest);
    EXPECT_NEAR(At(state_.v[i], 1), expected[static_cast<Eigen::Index>(at.v_x + i)],
                1e-6 * largest);
  }
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    EXPECT_NEAR(At(state_.force[a], 1), force[row], 1e-6 * force.cwiseAbs().maxCoeff());
    EXPECT_NEAR(At(state_.coil[a], 1), expected[static_cast<Eigen::Index>(at.coil_current) + row],
                1e-6 * largest);
  }
}

TEST_F(TangentTest, LanesInAnotherOrderHaveTheSameBitsInAnotherOrder) {
  Random random(12);
  const SamplePoint moment = Drawn(random, 300.0);
  LaneState one = Random8(3);
  LaneState other = one;
  const auto turn = [](auto& lanes) {
    for (Lane& lane : lanes) {
      const Lane before = lane;
      for (std::size_t l = 0; l < kLanes; ++l) lane.value[l] = before.value[(l + 3) % kLanes];
    }
  };
  turn(other.q), turn(other.v), turn(other.coil), turn(other.sensor), turn(other.force);
  turn(other.add_modal), turn(other.add_force), turn(other.add_coil_end), turn(other.add_coil_mean);
  for (int n = 0; n < 5; ++n) {
    Advance(model_, moment, one);
    Advance(model_, moment, other);
  }
  for (std::size_t i = 0; i < 2 * TheRig().modes; ++i) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      EXPECT_EQ(At(other.q[i], l), At(one.q[i], (l + 3) % kLanes));
      EXPECT_EQ(At(other.v[i], l), At(one.v[i], (l + 3) % kLanes));
    }
  }
}

TEST_F(TangentTest, AdvanceIsLinearAndConsumesWhatWasAdded) {
  Random random(13);
  const SamplePoint moment = Drawn(random, 300.0);
  LaneState one = Random8(5);
  LaneState twice = one;
  const auto twofold = [](auto& lanes) {
    for (Lane& lane : lanes) lane.value = 2.0F * lane.value;
  };
  twofold(twice.q), twofold(twice.v), twofold(twice.coil), twofold(twice.sensor);
  twofold(twice.force), twofold(twice.add_modal), twofold(twice.add_force);
  twofold(twice.add_coil_end), twofold(twice.add_coil_mean);
  Advance(model_, moment, one);
  Advance(model_, moment, twice);
  for (std::size_t i = 0; i < 2 * TheRig().modes; ++i) {
    // A power of two scales every rounding alike: the same bits.
    EXPECT_EQ(At(twice.q[i], 6), 2.0 * At(one.q[i], 6));
    EXPECT_EQ(At(twice.v[i], 6), 2.0 * At(one.v[i], 6));
    EXPECT_EQ(At(one.add_modal[i], 6), 0.0);
  }
  for (std::size_t a = 0; a < TheRig().axes; ++a) {
    EXPECT_EQ(At(twice.sensor[a], 6), 2.0 * At(one.sensor[a], 6));
    EXPECT_EQ(At(one.add_force[a], 6) + At(one.add_coil_end[a], 6) + At(one.add_coil_mean[a], 6),
              0.0);
  }
}

TEST_F(TangentTest, GyroscopicForcesDoNoWork) {
  // Two rigid modes without magnets: speed alone turns velocities, which lends some to the bending
  // modes, and does not change the sum of their squares; what those turn into displacement within
  // half a period, (w T/2)^2 of the little that they were lent, is left out.
  for (std::size_t l = 0; l < 2; ++l) {
    state_.v[0].value[l] = 1e-3F;
    state_.v[1].value[l] = l == 0 ? 2e-3F : -1e-3F;
    state_.v[TheRig().modes].value[l] = 5e-4F;
  }
  const auto energy = [&](std::size_t l) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * TheRig().modes; ++i) sum += std::pow(At(state_.v[i], l), 2);
    return sum;
  };
  SamplePoint moment;
  moment.speed_rad_per_s = 600.0F;
  const double before = energy(0);
  const double turned_before = At(state_.v[TheRig().modes + 1]);
  Periods(1, moment);
  EXPECT_GT(std::abs(At(state_.v[TheRig().modes + 1]) - turned_before), 1e-7);
  // A moment of the wrong sign in one plane would change it by 600 g T, a thousandth.
  EXPECT_LT(std::abs(energy(0) - before), 1e-5 * before);
}

}  // namespace
}  // namespace levitas::diagnosis
