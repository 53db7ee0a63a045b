// The half spectrum of torque and twist of a geared rotor of 12 degrees of freedom: exact lines,
// and readings made from them by the equations of two inertias and a spring, of which nothing is
// shared with the method.
#include "identification/geared/half_spectrum.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "benchmark/accuracy/identification/geared_trial.hpp"
#include "common/problem.hpp"
#include "common/random.hpp"
#include "common/two_pi.hpp"
#include "identification/geared/record_lines.hpp"
#include "identification/geared/steady_stretches.hpp"
#include "plant_sim/gear/mesh.hpp"

namespace levitas::identification {
namespace {

constexpr double kTorqueNoise = 0.005;  // [N m] and [rad] rms, as the rig file has its gauges
constexpr double kTwistNoise = 2e-6;

const configuration::RigFile& TwelveDof() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("geared_rotor_12dof", "rigs"));
  return rig;
}

configuration::RigFile WithStifferTeeth() {
  configuration::RigFile rig = TwelveDof();
  rig.plant.gears.front().stiffness_n_per_m *= 1.5;
  return rig;
}

/// Rotations [rad] of a shaft's two inertias per torque [N m] on either. Damping of the same ratio
/// in all modes is 2 zeta J sqrt(A), A = J^-1 K, and the root of a 2 x 2 matrix is
/// (A + d)/sqrt(tr A + 2 d) with d = sqrt(det A).
Eigen::Matrix2cd RotationPerTorque(const rotor::Torsion& torsion, double w) {
  const auto& near = torsion.inertias[0];
  Eigen::Matrix2d inertia = Eigen::Matrix2d::Zero();
  inertia.diagonal() << near.inertia_kg_m2, torsion.inertias[1].inertia_kg_m2;
  const double k = near.stiffness_n_m_per_rad;
  Eigen::Matrix2d stiffness;
  stiffness << k + near.ground_stiffness_n_m_per_rad, -k, -k, k;
  const Eigen::Matrix2d a = inertia.inverse() * stiffness;
  const double d = std::sqrt(std::max(a.determinant(), 0.0));
  Eigen::Matrix2d damping = 2.0 * torsion.damping_ratio / std::sqrt(a.trace() + 2.0 * d) * inertia *
                            (a + d * Eigen::Matrix2d::Identity());
  damping(0, 0) += near.ground_damping_n_m_s_per_rad;
  const std::complex<double> jw(0.0, w);
  return (stiffness - w * w * inertia + jw * damping).inverse();
}

/// What the teeth are apart on a line but for the wheels' rotation: positions, run-out and error.
std::complex<double> Apart(const configuration::RigFile& rig, const GearedLine& line) {
  using Kind = GearedLine::Kind;
  const gear::GearPair& pair = rig.plant.gears.front();
  std::complex<double> apart = line.pinion_m - line.gear_m;
  if (line.kind == Kind::kPinion) apart += accuracy::RunOut(pair.driving);
  if (line.kind == Kind::kGear) apart -= accuracy::RunOut(pair.driven);
  if (line.kind == Kind::kTransmissionError) apart -= accuracy::ErrorOf(pair, line.harmonic);
  return apart;
}

/// Twist of both couplings at w > 0. Along n the teeth are d + Rp th_p + Rg th_g apart and carry
/// K = k + jwc of that, f; each wheel takes -R f, so that f = K d/(1 + K sum R^2 H).
using Twists = std::array<std::complex<double>, 2>;
Twists TwistsAt(const configuration::RigFile& rig, const std::vector<GearedLine>& lines,
                double speed, double w) {
  const gear::GearPair& pair = rig.plant.gears.front();
  const gear::Vector along = gear::LineOfAction(pair.pressure_angle_rad);
  const std::complex<double> n(along.x, along.y);
  std::complex<double> d = 0.0;
  for (const GearedLine& line : lines) {
    if (line.speed_rad_per_s != speed) continue;
    const double at = line.frequency_rad_per_s;
    if (std::abs(at - w) < 1e-9 * w) d += std::conj(n) * Apart(rig, line);
    if (std::abs(at + w) < 1e-9 * w) d += n * std::conj(Apart(rig, line));
  }
  const std::array<double, 2> radius{pair.driving.base_radius_m, pair.driven.base_radius_m};
  std::complex<double> gives_way = 0.0;
  Twists per_force;
  for (std::size_t s = 0; s < 2; ++s) {
    const rotor::Torsion& torsion = rig.plant.shafts[s].torsion;
    const auto wheel = static_cast<Eigen::Index>(torsion.gear_at);
    const Eigen::Matrix2cd rotation = RotationPerTorque(torsion, w);
    gives_way += radius[s] * radius[s] * rotation(wheel, wheel);
    per_force[s] = -radius[s] * (rotation(1, wheel) - rotation(0, wheel));
  }
  const std::complex<double> mesh(pair.stiffness_n_per_m, w * pair.damping_n_s_per_m);
  const std::complex<double> force = mesh * d / (1.0 + mesh * gives_way);
  return {per_force[0] * force, per_force[1] * force};
}

double StiffnessOf(std::size_t coupling) {
  return TwelveDof().plant.shafts[coupling].torsion.inertias[0].stiffness_n_m_per_rad;
}

/// 1.5 s at 15 Hz, as long at 25 Hz. The method reads no positions of it.
session::Recording TwoSpeeds() {
  session::Recording record;
  record.name = "two speeds";
  record.period_ns = TwelveDof().numbers.period_ns;
  double angle = 0.0;
  for (const double hz : {15.0, 25.0}) {
    for (int n = 0; n < 15'000; ++n, angle += kTwoPi * hz * record.period_s()) {
      record.cycle.push_back(record.cycle.size());
      record.levitated.push_back(1);
      record.speed_rad_per_s.push_back(kTwoPi * hz);
      record.angle_rad.push_back(std::fmod(angle, kTwoPi));
    }
  }
  return record;
}

struct HalfTrial {
  session::Recording record;
  std::vector<double> angle;
  std::vector<SteadyStretch> stretches;
  std::vector<GearedLine> lines;
  GearedParameters found;
};

std::vector<GearedLine> LinesOf(const configuration::RigFile& rig, const HalfTrial& trial) {
  std::vector<GearedLine> lines;
  for (const SteadyStretch& stretch : trial.stretches) {
    const auto more = accuracy::LinesAt(rig, {}, stretch.speed_rad_per_s);
    lines.insert(lines.end(), more.begin(), more.end());
  }
  return lines;
}

const HalfTrial& ExactTrial() {
  static const HalfTrial trial = [] {
    HalfTrial made{TwoSpeeds(), {}, {}, {}, {}};
    made.angle = UnwrappedAngle(made.record);
    made.stretches = SteadyStretches(made.record, made.angle, TwelveDof().plant.gears.front());
    made.lines = LinesOf(TwelveDof(), made);
    made.found = IdentifyGeared(made.lines, KnownOfRig(TwelveDof()));
    return made;
  }();
  return trial;
}

/// Readings of the couplings of `rig`, noise left out.
session::TorsionRecording ReadingsOf(const configuration::RigFile& rig) {
  const HalfTrial& trial = ExactTrial();
  const std::vector<GearedLine> lines = LinesOf(rig, trial);
  const std::vector<double> orders{0.5, 1.0, 20.0, 40.0, 60.0, 80.0, 100.0};
  session::TorsionRecording torsion;
  torsion.couplings = {"motor to pinion", "gear to brake"};
  torsion.cycle = trial.record.cycle;
  torsion.rig_session.assign(torsion.cycle.size(), 1);
  torsion.torque_n_m.resize(2);
  torsion.twist_rad.resize(2);
  for (std::size_t half = 0; half < 2; ++half) {
    const double speed = trial.stretches.at(half).speed_rad_per_s;
    std::vector<Twists> twists;
    for (const double order : orders) {
      twists.push_back(TwistsAt(rig, lines, speed, order * speed));
    }
    for (std::size_t n = 15'000 * half; n < 15'000 * (half + 1); ++n) {
      std::array<double, 2> sum{};
      for (std::size_t k = 0; k < orders.size(); ++k) {
        const auto turn = std::polar(1.0, orders[k] * trial.angle[n]);
        for (std::size_t c = 0; c < 2; ++c) sum[c] += (twists[k][c] * turn).real();
      }
      for (std::size_t c = 0; c < 2; ++c) {
        torsion.twist_rad[c].push_back(sum[c]);
        torsion.torque_n_m[c].push_back(StiffnessOf(c) * sum[c]);
      }
    }
  }
  return torsion;
}

const session::TorsionRecording& ExactReadings() {
  static const session::TorsionRecording torsion = ReadingsOf(TwelveDof());
  return torsion;
}

/// Torque `times` as large, and white noise on both readings.
session::TorsionRecording Noisy(std::uint64_t seed, double times = 1.0,
                                double twist_noise = kTwistNoise) {
  session::TorsionRecording torsion = ExactReadings();
  Random random(seed);
  for (std::size_t c = 0; c < 2; ++c) {
    for (double& value : torsion.torque_n_m[c]) {
      value = times * value + kTorqueNoise * random.Normal();
    }
    for (double& value : torsion.twist_rad[c]) value += twist_noise * random.Normal();
  }
  return torsion;
}

HalfSpectrum HalfOf(const session::TorsionRecording& torsion) {
  const HalfTrial& trial = ExactTrial();
  return HalfSpectrumOf(trial.record, torsion, TwelveDof(), trial.lines, trial.found);
}

TEST(HalfSpectrum, MeasuredAndModelAreWhatTwoInertiasAndASpringSay) {
  const HalfSpectrum half = HalfOf(ExactReadings());
  ASSERT_EQ(half.lines.size(), 28U);  // 2 couplings, 2 speeds, 2 rotations and 5 harmonics
  for (const TorsionLine& line : half.lines) {
    const auto twist = TwistsAt(TwelveDof(), ExactTrial().lines, line.speed_rad_per_s,
                                line.frequency_rad_per_s)[line.coupling];
    const auto torque = StiffnessOf(line.coupling) * twist;
    EXPECT_LT(std::abs(line.torque_n_m - torque), 1e-6 * std::abs(torque)) << line.name;
    EXPECT_LT(std::abs(line.twist_rad - twist), 1e-6 * std::abs(twist)) << line.name;
    // Rounding, magnified by the condition of what was identified (geared_test.cpp).
    ASSERT_TRUE(line.model_n_m) << line.name;
    EXPECT_LT(std::abs(*line.model_n_m - torque), 1e-5 * std::abs(torque)) << line.name;
  }
  for (const CouplingFound& coupling : half.couplings) {
    EXPECT_LT(coupling.unexplained_share.value(), 1e-9) << coupling.name;
    EXPECT_NEAR(coupling.stiffness_n_m_per_rad / coupling.known_n_m_per_rad, 1.0, 1e-6);
  }
}

TEST(HalfSpectrum, StiffnessScattersByItsDeviationUnderWhiteNoise) {
  double square = 0.0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const HalfSpectrum half = HalfOf(Noisy(seed));
    for (std::size_t c = 0; c < 2; ++c) {
      const CouplingFound& found = half.couplings.at(c);
      EXPECT_GT(found.lines_used, 0U);
      square += std::pow((found.stiffness_n_m_per_rad - StiffnessOf(c)) / found.stiffness_sigma, 2);
      EXPECT_LT(found.unexplained_share.value(), 1e-3);
    }
    for (const TorsionLine& line : half.lines) {
      // Of an amplitude's parts from N samples: sigma sqrt(2/N), known to 0.7 %.
      const SteadyStretch& of = ExactTrial().stretches[line.speed_rad_per_s > kTwoPi * 20.0];
      const double share = std::sqrt(2.0 / static_cast<double>(of.end - of.begin));
      EXPECT_NEAR(line.torque_sigma_n_m / (kTorqueNoise * share), 1.0, 0.04);
      EXPECT_NEAR(line.twist_sigma_rad / (kTwistNoise * share), 1.0, 0.04);
    }
  }
  // Chi-square of 32: beyond either limit once in a thousand. A deviation stated half or twice as
  // large as it is would make it about 128 or 8.
  EXPECT_GT(square, 12.8);
  EXPECT_LT(square, 62.5);
}

TEST(HalfSpectrum, StiffnessIsThatOfTheReadingsAndNotOfTheRigFile) {
  const HalfSpectrum half = HalfOf(Noisy(21, 1.1));
  for (std::size_t c = 0; c < 2; ++c) {
    const CouplingFound& found = half.couplings.at(c);
    EXPECT_EQ(found.known_n_m_per_rad, StiffnessOf(c));
    EXPECT_NEAR(found.stiffness_n_m_per_rad, 1.1 * StiffnessOf(c), 3.0 * found.stiffness_sigma);
    EXPECT_GT(found.stiffness_n_m_per_rad - StiffnessOf(c), 10.0 * found.stiffness_sigma);
    // The model is 1/1.1 of the torque: what it leaves has (1 - 1/1.1)^2 of its power.
    EXPECT_NEAR(found.unexplained_share.value(), 1.0 / 121.0, 1e-3);
  }
}

TEST(HalfSpectrum, ShareLeftUnexplainedIsWhatTeethOfAnotherStiffnessChange) {
  const configuration::RigFile other = WithStifferTeeth();
  const HalfSpectrum half = HalfOf(ReadingsOf(other));
  const std::vector<GearedLine> stiffer = LinesOf(other, ExactTrial());
  std::array<double, 2> power{};
  std::array<double, 2> change{};
  for (const TorsionLine& line : half.lines) {
    const double speed = line.speed_rad_per_s;
    const double w = line.frequency_rad_per_s;
    const auto measured = TwistsAt(other, stiffer, speed, w)[line.coupling];
    const auto model = TwistsAt(TwelveDof(), ExactTrial().lines, speed, w)[line.coupling];
    power[line.coupling] += std::norm(measured);
    change[line.coupling] += std::norm(measured - model);
  }
  for (std::size_t c = 0; c < 2; ++c) {
    const double share = half.couplings.at(c).unexplained_share.value();
    EXPECT_GT(share, 0.01);
    EXPECT_NEAR(share, change[c] / power[c], 1e-4 * share);
  }
}

TEST(HalfSpectrum, NothingIsFoundWhereNoLineStandsOutOfTheTwistsNoise) {
  session::TorsionRecording dead = Noisy(31);
  for (auto& twist : dead.twist_rad) std::ranges::fill(twist, 0.0);
  for (const auto& readings : {Noisy(31, 1.0, 1.0), dead}) {
    for (const CouplingFound& found : HalfOf(readings).couplings) {
      EXPECT_EQ(found.lines_used, 0U);
      EXPECT_EQ(found.stiffness_n_m_per_rad, 0.0);
    }
  }
}

TEST(HalfSpectrum, ALineWhoseMirrorIsNotSeenHasNoModel) {
  const HalfTrial& trial = ExactTrial();
  std::vector<GearedLine> lines = trial.lines;
  const auto third = std::ranges::find(lines, -3, &GearedLine::harmonic);  // at 15 Hz
  ASSERT_NE(third, lines.end());
  lines.erase(third);
  const HalfSpectrum half =
      HalfSpectrumOf(trial.record, ExactReadings(), TwelveDof(), lines, trial.found);
  for (const TorsionLine& line : half.lines) {
    const bool unseen = line.name == "mesh_3" && line.speed_rad_per_s < kTwoPi * 20.0;
    EXPECT_EQ(line.model_n_m.has_value(), !unseen) << line.name;
  }
  EXPECT_LT(half.couplings.at(0).unexplained_share.value(), 1e-9);  // of those that have one
}

/// Without the instants of the record's second half but for `kept` of ten.
session::TorsionRecording Lossy(std::uint64_t kept) {
  const session::TorsionRecording whole = Noisy(41);
  session::TorsionRecording torsion{whole.couplings, {}, {}, {{}, {}}, {{}, {}}};
  for (std::size_t n = 0; n < whole.rows(); ++n) {
    if (n >= 15'000 && n / 32 % 10 >= kept) continue;  // whole batches are lost
    torsion.rig_session.push_back(1);
    torsion.cycle.push_back(whole.cycle[n]);
    for (std::size_t c = 0; c < 2; ++c) {
      torsion.torque_n_m[c].push_back(whole.torque_n_m[c][n]);
      torsion.twist_rad[c].push_back(whole.twist_rad[c][n]);
    }
  }
  return torsion;
}

TEST(HalfSpectrum, TakesARecordWithLostBatchesAndRefusesOneThatLacksHalf) {
  const HalfSpectrum half = HalfOf(Lossy(6));
  for (std::size_t c = 0; c < 2; ++c) {
    const CouplingFound& found = half.couplings.at(c);
    EXPECT_NEAR(found.stiffness_n_m_per_rad, StiffnessOf(c), 3.0 * found.stiffness_sigma);
  }
  try {
    (void)HalfOf(Lossy(4));
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), testing::HasSubstr("two speeds: of the stretch at 25.00 Hz"));
  }
}

TEST(HalfSpectrum, IsEmptyWithoutReadingsAndWithoutTorsionOfTheModel) {
  session::TorsionRecording none;
  none.couplings = ExactReadings().couplings;
  EXPECT_TRUE(HalfOf(none).couplings.empty());
  EXPECT_TRUE(HalfOf(none).lines.empty());
  const HalfTrial& trial = ExactTrial();
  GearedParameters stiff = trial.found;
  stiff.corrected.torsion.reset();
  EXPECT_TRUE(HalfSpectrumOf(trial.record, ExactReadings(), TwelveDof(), trial.lines, stiff)
                  .couplings.empty());
}

/// Readings of the second coupling alone, as of a rig with one pair of gauges.
session::TorsionRecording SecondAlone() {
  session::TorsionRecording torsion = ExactReadings();
  torsion.couplings.erase(torsion.couplings.begin());
  torsion.torque_n_m.erase(torsion.torque_n_m.begin());
  torsion.twist_rad.erase(torsion.twist_rad.begin());
  return torsion;
}

TEST(HalfSpectrum, FewerCouplingsThanTheRigsAreTakenByTheirNames) {
  const HalfSpectrum both = HalfOf(ExactReadings());
  const HalfSpectrum one = HalfOf(SecondAlone());
  ASSERT_EQ(one.couplings.size(), 1U);
  EXPECT_EQ(one.couplings[0].name, both.couplings[1].name);
  EXPECT_EQ(one.couplings[0].known_n_m_per_rad, StiffnessOf(1));
  EXPECT_EQ(one.couplings[0].stiffness_n_m_per_rad, both.couplings[1].stiffness_n_m_per_rad);
}

std::string RefusalOf(const session::TorsionRecording& torsion) {
  try {
    (void)HalfOf(torsion);
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "not refused";
}

TEST(HalfSpectrum, RefusesACouplingThatTheRigDoesNotHaveWithThoseItHas) {
  session::TorsionRecording other = SecondAlone();
  other.couplings = {"turbine to pump"};
  EXPECT_THAT(RefusalOf(other), testing::HasSubstr("turbine to pump, the rig has "));
  EXPECT_THAT(RefusalOf(other), testing::HasSubstr(ExactReadings().couplings[0]));
}

TEST(HalfSpectrum, RefusesARigThatBeganAnewWithinTheRecord) {
  session::TorsionRecording twice = ExactReadings();
  twice.rig_session.back() += 1;
  EXPECT_THAT(RefusalOf(twice), testing::HasSubstr("record without a restart"));
}

TEST(HalfSpectrum, SaysThatItWasNotComparedWhereTheProbesSeeNoLine) {
  const HalfTrial& trial = ExactTrial();
  const HalfSpectrum half =
      HalfSpectrumOf(trial.record, ExactReadings(), TwelveDof(), {}, trial.found);
  for (const CouplingFound& coupling : half.couplings) {
    EXPECT_FALSE(coupling.unexplained_share) << coupling.name;
    EXPECT_GT(coupling.lines_used, 0U);  // torque over twist needs no model
  }
}

}  // namespace
}  // namespace levitas::identification
