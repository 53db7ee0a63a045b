// The truths that identifications are judged by: lines of a geared rotor in closed form, errors and
// scores that count what they say.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "benchmark/accuracy/identification/geared_trial.hpp"
#include "benchmark/accuracy/identification/modal_trial.hpp"

namespace levitas::accuracy {
namespace {

using Complex = std::complex<double>;
using identification::GearedLine;
using Kind = GearedLine::Kind;

constexpr double kSpeed = 2.0 * std::numbers::pi * 20.0;

configuration::RigFile Geared(const std::string& name = "geared_rotor_4dof") {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

class GearedLinesTest : public testing::TestWithParam<const char*> {};

TEST_P(GearedLinesTest, CurrentsFollowThePdLawOnEveryLine) {
  const GearedPlan plan;
  for (const GearedLine& line : LinesAt(Geared(GetParam()), plan, kSpeed)) {
    const Complex law(plan.kp_a_per_m, line.frequency_rad_per_s * plan.kd_a_s_per_m);
    EXPECT_LT(std::abs(line.pinion_a - law * line.pinion_m),
              1e-12 + 1e-9 * std::abs(line.pinion_a));
    EXPECT_LT(std::abs(line.gear_a - law * line.gear_m), 1e-12 + 1e-9 * std::abs(line.gear_a));
  }
}

TEST_P(GearedLinesTest, AnAddedCurrentMovesItsLineInProportionAndNoLineOfAnotherFrequency) {
  const configuration::RigFile rig = Geared(GetParam());
  const auto plain = LinesAt(rig, {}, kSpeed);
  const auto once = LinesAt(rig, {}, kSpeed, {{kSpeed, 0, Complex(0.01, 0.02)}});
  const auto twice = LinesAt(rig, {}, kSpeed, {{kSpeed, 0, Complex(0.02, 0.04)}});
  ASSERT_EQ(once.size(), plain.size());
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const Complex moved = once[k].pinion_m - plain[k].pinion_m;
    // Linear: rounding of a solution with a condition of up to 1e6.
    EXPECT_LT(std::abs(twice[k].pinion_m - plain[k].pinion_m - 2.0 * moved),
              1e-9 * std::abs(plain[k].pinion_m) + 1e-15);
    if (plain[k].kind == Kind::kPinion) {
      EXPECT_GT(std::abs(moved), 1e-8);
    }
    if (std::abs(plain[k].frequency_rad_per_s) != kSpeed) {
      EXPECT_EQ(std::abs(moved), 0.0);
    }
  }
}

TEST_P(GearedLinesTest, ErrorsThreefoldMakeTheirLinesThreefold) {
  configuration::RigFile rig = Geared(GetParam());
  const auto plain = LinesAt(rig, {}, kSpeed);
  for (gear::Harmonic& h : rig.plant.gears.front().transmission_error) h.amplitude_m *= 3.0;
  const auto more = LinesAt(rig, {}, kSpeed);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    const double factor = plain[k].kind == Kind::kTransmissionError ? 3.0 : 1.0;
    EXPECT_LT(std::abs(more[k].gear_m - factor * plain[k].gear_m),
              1e-9 * std::abs(more[k].gear_m) + 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(Rigs, GearedLinesTest,
                         testing::Values("geared_rotor_4dof", "geared_rotor_8dof",
                                         "geared_rotor_12dof"),
                         [](const auto& p) { return std::string(p.param); });

TEST(GearedLines, WithoutTeethAreThoseOfTwoUnbalancedMassesOnTheirMagnets) {
  configuration::RigFile rig = Geared();
  gear::GearPair& pair = rig.plant.gears.front();
  pair.stiffness_n_per_m = pair.damping_n_s_per_m = 0.0;
  const GearedPlan plan;
  int seen = 0;
  for (const GearedLine& line : LinesAt(rig, plan, kSpeed)) {
    const double w = line.frequency_rad_per_s;
    const bool pinion = line.kind == Kind::kPinion;
    if (!pinion && line.kind != Kind::kGear) continue;
    ++seen;
    const std::size_t s = pinion ? 0 : 1;
    const gear::Wheel& wheel = pinion ? pair.driving : pair.driven;
    const rotor::LumpedShaft& shaft = rig.plant.shafts[s].lumped;
    const plant::BearingConfig& bearing = rig.plant.bearings[s];
    const Complex dynamic = Complex(shaft.kll_n_per_m - shaft.mass_kg * w * w - KsOf(bearing),
                                    w * shaft.damping_n_s_per_m) +
                            KiOf(bearing) * Complex(plan.kp_a_per_m, w * plan.kd_a_s_per_m);
    const Complex expected = wheel.eccentric_mass_kg * w * w * RunOut(wheel) / dynamic;
    const Complex found = pinion ? line.pinion_m : line.gear_m;
    EXPECT_LT(std::abs(found - expected), 1e-9 * std::abs(expected)) << w;  // one division each
  }
  EXPECT_EQ(seen, 2);
}

TEST(GearedTrial, NoiseHasTheStatedDeviationOnEveryAmplitude) {
  const configuration::RigFile rig = Geared();
  GearedPlan plan;
  plan.speeds_hz.assign(60, 20.0);
  const auto exact = MakeGearedTrial(rig, plan).lines;
  plan.noise = 0.05;
  const auto noisy = MakeGearedTrial(rig, plan).lines;
  ASSERT_EQ(noisy.size(), exact.size());
  double position = 0.0;
  double current = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    ASSERT_GT(noisy[k].sigma_m, 0.0);
    position += std::norm((noisy[k].pinion_m - exact[k].pinion_m) / noisy[k].sigma_m) +
                std::norm((noisy[k].gear_m - exact[k].gear_m) / noisy[k].sigma_m);
    current += std::norm((noisy[k].pinion_a - exact[k].pinion_a) / noisy[k].sigma_a);
  }
  const auto count = static_cast<double>(exact.size());
  // Some 780 lines: 1560 complex draws, 2.5 % of one sigma, and 780, 3.6 %; four of them.
  EXPECT_NEAR(position / (2.0 * count), 1.0, 0.10);
  EXPECT_NEAR(current / count, 1.0, 0.15);
}

TEST(GearedTrial, KnownNumbersAreOffByTheErrorAndAShaftsStiffnessesTogether) {
  const configuration::RigFile rig = Geared("geared_rotor_8dof");
  const auto exact = MakeGearedTrial(rig, {}).known;
  GearedPlan plan;
  plan.model_error = 0.05;
  const auto off = MakeGearedTrial(rig, plan).known;
  EXPECT_EQ(off.uncertainty, 0.05);
  EXPECT_EQ(exact.uncertainty, 0.0);
  EXPECT_NEAR(std::abs(off.pinion.mass_kg / exact.pinion.mass_kg - 1.0), 0.05, 1e-12);
  const double ratio = off.gear.stiffness_n_per_m / exact.gear.stiffness_n_per_m;
  EXPECT_NEAR(std::abs(ratio - 1.0), 0.05, 1e-12);
  EXPECT_NEAR(off.gear.tilt_stiffness_n_m / exact.gear.tilt_stiffness_n_m, ratio, 1e-12);
  EXPECT_EQ(off.gear.ki_n_per_a, exact.gear.ki_n_per_a);  // ks/ki carries the error
}

/// A rig of two modes and the truth that describes it.
identification::Physical Found() {
  identification::Physical rig;
  rig.mass_kg = 2.0;
  rig.frequency_rad_per_s = 2.0 * std::numbers::pi * Eigen::Vector4d(0.0, 0.0, 90.0, 250.0);
  rig.damping_ratio = Eigen::Vector4d(0.0, 0.0, 0.003, 0.004);
  rig.ki_n_per_a = Eigen::Vector4d(40.0, 41.0, 42.0, 43.0);
  rig.ks_n_per_m = Eigen::Vector4d(1.0e5, 1.1e5, 1.2e5, 1.3e5);
  rig.gain = Eigen::Vector4d(1.0, 1.01, 1.02, 1.03);
  return rig;
}

ModalTruth TruthOf(const identification::Physical& rig) {
  return {Eigen::Vector3d(90.0, 250.0, 510.0), Eigen::Vector3d(0.003, 0.004, 0.005),
          rig.ki_n_per_a.cwiseProduct(rig.gain) / rig.mass_kg, rig.ks_n_per_m / rig.mass_kg};
}

TEST(ModalErrors, CountOnlyProductsThatAResponseTellsAndModesThatTheFitHas) {
  const ModalTruth truth = TruthOf(Found());
  identification::Physical rig = Found();
  // Mass, ki and ks half as large again, gain the other way: no response shows it.
  rig.mass_kg *= 1.5;
  rig.ki_n_per_a *= 1.5 * 1.25;
  rig.gain /= 1.25;
  rig.ks_n_per_m *= 1.5;
  ModalErrors errors = Compare(truth, rig);
  EXPECT_EQ(errors.frequency.size(), 2);
  EXPECT_LT(errors.frequency.maxCoeff(), 1e-12);
  EXPECT_LT(errors.ki_product.maxCoeff(), 1e-12);
  EXPECT_LT(errors.ks_product.maxCoeff(), 1e-12);
  rig.ki_n_per_a[2] *= 1.1;
  rig.damping_ratio[3] *= 0.7;
  errors = Compare(truth, rig);
  EXPECT_NEAR(errors.ki_product[2], 0.1, 1e-12);
  EXPECT_NEAR(errors.deflection_per_ampere[2], 0.1, 1e-12);
  EXPECT_NEAR(errors.damping[1], 0.3, 1e-12);  // above and below count alike
  EXPECT_LT(errors.ks_product.maxCoeff(), 1e-12);
}

TEST(ModalScores, AreDeparturesInTheFitsOwnDeviationsWithTheirSign) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  identification::ModalResult found{
      {}, {}, identification::StartFromRig(rig.plant, 2), {}, {}, {}, {}, Found(), {}, {}, 0.0};
  const auto& at = found.start.frame.layout;
  found.uncertainty.deviation = Eigen::VectorXd::Constant(at.size, 0.02);
  found.uncertainty.products = Eigen::VectorXd::Constant(2 * at.axes(), 0.05);
  const ModalTruth truth = TruthOf(found.rig);
  found.rig.frequency_rad_per_s[2] *= std::exp(0.04);
  found.rig.damping_ratio[3] *= std::exp(-0.06);
  found.rig.ks_n_per_m[1] *= std::exp(0.05);
  const ModalScores scores = Score(truth, found);
  EXPECT_NEAR(scores.frequency[0], 2.0, 1e-9);
  EXPECT_NEAR(scores.frequency[1], 0.0, 1e-9);
  EXPECT_NEAR(scores.damping[1], -3.0, 1e-9);
  EXPECT_NEAR(scores.ks_product[1], 1.0, 1e-9);
  EXPECT_NEAR(scores.ki_product.cwiseAbs().maxCoeff(), 0.0, 1e-9);
}

}  // namespace
}  // namespace levitas::accuracy
