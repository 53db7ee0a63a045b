// One plane of probes for each geared shaft, beside the gear: what the shaft's own model says of
// the gear from there, how much worse it says it, and where it cannot.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "identification/geared/elastic_shaft.hpp"
#include "identification/geared/geared_forces.hpp"
#include "identification/geared/probe_planes.hpp"
#include "identification/geared/record_lines.hpp"
#include "tests/loop/identification/beam_lines.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using test::BeamLines;
using test::BeamRig;
using test::Planes;
using testing::HasSubstr;

const std::vector<double> kSpeedsHz{15.0, 20.0, 25.0, 29.0};

struct Errors {
  double mesh_stiffness{}, mesh_damping{}, ki{}, ks{}, run_out{}, error{};
};

double Relative(Complex found, Complex truth) { return std::abs(found - truth) / std::abs(truth); }

/// The largest of each; of the transmission error the median.
Errors ErrorsOf(const configuration::RigFile& rig, const GearedParameters& p) {
  const gear::GearPair& pair = rig.plant.gears.front();
  Errors e;
  e.mesh_stiffness = Relative(p.mesh_stiffness_n_per_m, pair.stiffness_n_per_m);
  e.mesh_damping = Relative(p.mesh_damping_n_s_per_m, pair.damping_n_s_per_m);
  // Of the rig file's magnets: 80 N/A, i0/s0 = 1/0.8 A/mm.
  e.ki = std::max(Relative(p.pinion.ki_n_per_a, 80.0), Relative(p.gear.ki_n_per_a, 80.0));
  e.ks = std::max(Relative(p.pinion.ks_n_per_m, 1e5), Relative(p.gear.ks_n_per_m, 1e5));
  const auto run_out = [](const gear::Wheel& w) {
    return std::polar(w.runout_m, w.runout_phase_rad);
  };
  e.run_out = std::max(Relative(p.pinion.run_out_m, run_out(pair.driving)),
                       Relative(p.gear.run_out_m, run_out(pair.driven)));
  std::vector<double> each;
  for (const TransmissionError& found : p.error) {
    for (const gear::Harmonic& h : pair.transmission_error) {
      if (h.order != found.harmonic) continue;
      each.push_back(Relative(found.amplitude_m, std::polar(h.amplitude_m, h.phase_rad)));
    }
  }
  std::ranges::sort(each);
  e.error = each[each.size() / 2];
  return e;
}

/// Gear, magnet and probe at places of their own, 20 mm from each other and from the ends.
Planes Drawn(Random& random) {
  for (;;) {
    const auto place = [&random] { return 0.02 + 0.46 * random.Uniform(); };
    const Planes p{place(), place(), place()};
    const double nearest =
        std::min({std::abs(p.gear_z_m - p.magnet_z_m), std::abs(p.gear_z_m - p.probe_z_m),
                  std::abs(p.magnet_z_m - p.probe_z_m)});
    if (nearest > 0.02) return p;
  }
}

TEST(ProbePlanes, DrawnBesideTheGearGiveEveryParameterOfExactLines) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Random random(seed);
    const configuration::RigFile rig = BeamRig(Drawn(random), Drawn(random));
    const GearedParameters p = IdentifyGeared(BeamLines(rig, kSpeedsHz), KnownOfRig(rig));
    const Errors e = ErrorsOf(rig, p);
    // Modes and nodes are the same model; only rounding is left, magnified by the condition and by
    // the amplification: 1e-16 of stiffnesses some 1e6 times the shaft's, times some thousand.
    EXPECT_LT(std::max({e.mesh_stiffness, e.mesh_damping, e.ki, e.ks, e.run_out, e.error}), 1e-5)
        << seed << " condition " << p.condition;
    ASSERT_TRUE(p.pinion.plane && p.gear.plane);
    EXPECT_LE(p.pinion.plane->amplification, 1.1 * kMostAmplification);
    EXPECT_GE(p.error.size(), 9U) << seed;  // of eleven; nodes cost single lines
  }
}

TEST(ProbePlanes, TakenAsIfAtTheGearGiveWrongRunOuts) {
  // The pair to the test before: what the shaft's own model is for.
  const configuration::RigFile rig = BeamRig({}, {});
  const configuration::RigFile as_if = BeamRig({0.26, 0.28, 0.26}, {0.26, 0.28, 0.26});
  GearedKnown known = KnownOfRig(rig);
  const auto lines = BeamLines(rig, kSpeedsHz);
  EXPECT_LT(ErrorsOf(rig, IdentifyGeared(lines, known)).run_out, 1e-5);
  known.pinion.elastic = KnownOfRig(as_if).pinion.elastic;
  known.gear.elastic = KnownOfRig(as_if).gear.elastic;
  double off = 1.0;
  try {
    off = ErrorsOf(rig, IdentifyGeared(lines, known)).run_out;
  } catch (const BadInput&) {
  }
  EXPECT_GT(off, 0.05);
}

/// 5 % noise on every sample of 20 s at 10 kHz, every known number off by 5 %.
GearedParameters Spoiled(const configuration::RigFile& rig, std::uint64_t seed) {
  Random random(seed);
  std::vector<GearedLine> lines = BeamLines(rig, kSpeedsHz);
  double position = 0.0;
  double current = 0.0;
  for (const GearedLine& l : lines) {
    position += std::norm(l.pinion_m) + std::norm(l.gear_m);
    current += std::norm(l.pinion_a) + std::norm(l.gear_a);
  }
  const double samples = 20.0 / 1e-4 * static_cast<double>(2 * kSpeedsHz.size());
  const auto draw = [&random] {
    return Complex(random.Normal(), random.Normal()) / std::numbers::sqrt2;
  };
  for (GearedLine& l : lines) {
    l.sigma_m = 0.05 * std::sqrt(position / samples);
    l.sigma_a = 0.05 * std::sqrt(current / samples);
    l.pinion_m += l.sigma_m * draw();
    l.gear_m += l.sigma_m * draw();
    l.pinion_a += l.sigma_a * draw();
    l.gear_a += l.sigma_a * draw();
  }
  GearedKnown known = KnownOfRig(rig);
  known.uncertainty = 0.05;
  for (ShaftKnown* shaft : {&known.pinion, &known.gear}) {
    const auto off = [&random] { return random.Uniform() < 0.5 ? 0.95 : 1.05; };
    const double mass = off();
    shaft->mass_kg *= mass;
    shaft->mass_ratio *= mass;
    shaft->damping_ratio *= off();
    shaft->stiffness_ratio *= off();
    shaft->gyroscopic_ratio *= off();
    shaft->ks_n_per_m *= off();
  }
  return IdentifyGeared(lines, known);
}

TEST(ProbePlanes, NoiseAndWrongNumbersOfFivePercentLeaveTheMediansWithinTen) {
  const configuration::RigFile rig = BeamRig({}, {});
  std::vector<Errors> all;
  for (const std::uint64_t seed : {1U, 2U, 3U}) all.push_back(ErrorsOf(rig, Spoiled(rig, seed)));
  // As asked of probes at the gear (geared_test.cpp).
  for (const auto member : {&Errors::mesh_stiffness, &Errors::mesh_damping, &Errors::ki,
                            &Errors::run_out, &Errors::error}) {
    std::vector<double> values;
    for (const Errors& e : all) values.push_back(e.*member);
    std::ranges::sort(values);
    EXPECT_LT(values[1], 0.10);
  }
}

std::string Refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "accepted";
}

TEST(ProbePlanes, AtANodeAreRefusedByName) {
  // On a support a thousand times as stiff as the shaft nothing moves.
  configuration::RigFile rig = BeamRig({}, {0.2, 0.28, 0.5});
  rig.plant.shafts[1].supports[1].stiffness_x_n_per_m = 1e9;
  rig.plant.shafts[1].supports[1].stiffness_y_n_per_m = 1e9;
  const auto identify = [&rig] {
    (void)IdentifyGeared(BeamLines(rig, kSpeedsHz), KnownOfRig(rig));
  };
  EXPECT_THAT(Refusal(identify), HasSubstr("the probes of the gear at z = 500 mm stand at a node"));
  rig.plant.bearings[1].sensor_z_m = 0.26;
  EXPECT_EQ(Refusal(identify), "accepted");
}

TEST(ProbePlanes, WhatOnePlaneDoesNotTellIsRefusedByName) {
  const auto refusal = [](const std::function<void(plant::PlantConfig&)>& change) {
    configuration::RigFile rig = BeamRig({}, {});
    change(rig.plant);
    return Refusal([&rig] { (void)KnownOfRig(rig); });
  };
  EXPECT_EQ(refusal([](plant::PlantConfig&) {}), "accepted");
  EXPECT_THAT(refusal([](plant::PlantConfig& c) {
                c.unbalance = {{0.4, 1e-5, 0.0, 1}};
              }),
              HasSubstr("shaft gear: unbalance at z = 400 mm: a second force"));
  EXPECT_THAT(
      refusal([](plant::PlantConfig& c) { c.shafts[0].supports[1].stiffness_y_n_per_m *= 2.0; }),
      HasSubstr("shaft pinion: the support at z = 500 mm is not alike in x and y"));
  EXPECT_THAT(refusal([](plant::PlantConfig& c) { c.shafts[0].supports.clear(); }),
              HasSubstr("shaft pinion: no supports"));
  EXPECT_THAT(refusal([](plant::PlantConfig& c) { c.gears[0].driven.eccentric_mass_kg = 0.0; }),
              HasSubstr("eccentric_mass_kg"));
}

TEST(ElasticShaft, WithAllPlanesAtTheGearIsTheDiscsOwnEquation) {
  ElasticShaft e;
  e.stiffness_1_per_s2 = Eigen::MatrixXd::Constant(1, 1, 2.0e5 / 2.0);
  e.damping_1_per_s = Eigen::MatrixXd::Constant(1, 1, 60.0 / 2.0);
  e.gyroscopic = Eigen::MatrixXd::Zero(1, 1);
  e.gear = e.magnet = e.probe = Eigen::VectorXd::Constant(1, 1.0 / std::sqrt(2.0));
  const ShaftKnown disc{2.0, 60.0, 2.0e5};
  ShaftKnown elastic;
  elastic.elastic = std::make_shared<const ElasticShaft>(e);
  for (const double w : {-900.0, 0.0, 40.0, 350.0}) {
    GearedLine line;
    line.frequency_rad_per_s = w;
    const ShaftGains gains = GainsOf(ReceptancesOf(elastic, line), 1e5, 80.0);
    const Complex expected = Impedance(disc, line) - 1e5;
    EXPECT_LT(std::abs(gains.force_per_m - expected), 1e-9 * std::abs(expected)) << w;
    EXPECT_LT(std::abs(gains.force_per_a - 80.0), 1e-9) << w;
    EXPECT_LT(std::abs(gains.gear_per_m - 1.0), 1e-12) << w;
    EXPECT_LT(std::abs(gains.gear_per_a), 1e-12) << w;
  }
}

TEST(OneDirection, GivesMeshMagnetsAndRunOutsButOfTheErrorsOnlyTheSumOfBothWhirls) {
  // x alone: X(W) = (R(W) + R(-W)*)/2. Without tilt or torsion its equations are those of R.
  const auto whirls =
      ReadGearedLines(test::DataFolder() + "/reference/geared_rotor_4dof_lines.csv");
  const std::array readings{&GearedLine::pinion_m, &GearedLine::gear_m, &GearedLine::pinion_a,
                            &GearedLine::gear_a};
  std::vector<GearedLine> half;
  for (const GearedLine& one : whirls) {
    const double w = one.frequency_rad_per_s;
    if (w < 0.0 && one.kind != GearedLine::Kind::kGear) continue;
    GearedLine line = one;
    line.frequency_rad_per_s = std::abs(w);
    for (const auto reading : readings) {
      const Complex own = w < 0.0 ? std::conj(one.*reading) : one.*reading;
      Complex other = 0.0;
      for (const GearedLine& mirror : whirls) {
        const bool is = mirror.speed_rad_per_s == one.speed_rad_per_s && w >= 0.0 &&
                        std::abs(mirror.frequency_rad_per_s + w) < 1e-6;
        if (is) other = std::conj(mirror.*reading);
      }
      line.*reading = 0.5 * (own + other);
    }
    half.push_back(line);
  }
  const GearedParameters p =
      IdentifyGeared(half, {{2.0, 60.0, 2.0e5}, {3.5, 80.0, 2.4e5}, {}, 0.0});
  const GearedParameters full =
      IdentifyGeared(whirls, {{2.0, 60.0, 2.0e5}, {3.5, 80.0, 2.4e5}, {}, 0.0});
  // Ten digits in the file.
  EXPECT_LT(Relative(p.mesh_stiffness_n_per_m, 1e6), 1e-5);
  EXPECT_LT(Relative(p.mesh_damping_n_s_per_m, 300.0), 1e-5);
  EXPECT_LT(Relative(p.pinion.ki_n_per_a, 80.0), 1e-5);
  EXPECT_LT(Relative(p.gear.ks_n_per_m, 1e5), 1e-5);
  EXPECT_LT(Relative(2.0 * p.pinion.run_out_m, std::polar(20e-6, 0.6)), 1e-5);
  EXPECT_LT(Relative(2.0 * std::conj(p.gear.run_out_m), std::polar(30e-6, 0.9)), 1e-5);
  const auto error = [](const GearedParameters& of, int order) {
    return std::ranges::find(of.error, order, &TransmissionError::harmonic)->amplitude_m;
  };
  ASSERT_EQ(p.error.size(), 6U);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_LT(Relative(2.0 * error(p, i), error(full, i) + std::conj(error(full, -i))), 1e-4) << i;
  }
}

}  // namespace
}  // namespace levitas::identification
