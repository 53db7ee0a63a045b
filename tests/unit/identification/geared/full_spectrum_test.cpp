#include "identification/geared/full_spectrum.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <numbers>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/identification/geared/reference_lines.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

// Numbers of the rig behind the reference file, see tests/data/reference/README.md.
constexpr double kMeshStiffness = 1.0e6, kMeshDamping = 300.0, kKs = 1.0e5, kKi = 80.0;
const Complex kPinionRunOut = std::polar(20e-6, 0.6);
// The gear turns backwards, eps e^{-j(w t + phi)} with phi = -0.9 rad.
const Complex kGearRunOut = std::polar(30e-6, 0.9);
const std::map<int, Complex>& Errors() {
  static const std::map<int, Complex> errors{
      {0, std::polar(10e-6, 0.3)}, {1, std::polar(5e-6, 0.8)},  {-1, std::polar(3e-6, -1.1)},
      {2, std::polar(6e-6, 1.9)},  {-2, std::polar(4e-6, 0.2)}, {3, std::polar(6e-6, -0.7)},
      {-3, std::polar(4e-6, 2.4)}, {4, std::polar(8e-6, 1.2)},  {-4, std::polar(5e-6, -2.0)},
      {5, std::polar(8e-6, 0.1)},  {-5, std::polar(5e-6, -0.4)}};
  return errors;
}

double Relative(Complex found, Complex truth) { return std::abs(found - truth) / std::abs(truth); }

/// Largest relative error of the mesh, the magnets and the run-outs.
double WorstOfShafts(const GearedParameters& p) {
  return std::max({Relative(p.mesh_stiffness_n_per_m, kMeshStiffness),
                   Relative(p.mesh_damping_n_s_per_m, kMeshDamping),
                   Relative(p.pinion.ks_n_per_m, kKs), Relative(p.gear.ks_n_per_m, kKs),
                   Relative(p.pinion.ki_n_per_a, kKi), Relative(p.gear.ki_n_per_a, kKi),
                   Relative(p.pinion.run_out_m, kPinionRunOut),
                   Relative(p.gear.run_out_m, kGearRunOut)});
}

TEST(FullSpectrum, FindsEveryParameterOfTheExactLines) {
  const GearedParameters p = IdentifyGeared(Reference(), kKnown);
  // The file has ten digits and mesh lines of some nm; 1e-6 is what the reference promises.
  EXPECT_LT(WorstOfShafts(p), 1e-6);
  ASSERT_EQ(p.error.size(), Errors().size());
  for (const TransmissionError& e : p.error) {
    EXPECT_LT(Relative(e.amplitude_m, Errors().at(e.harmonic)), 1e-6) << e.harmonic;
  }
}

TEST(FullSpectrum, IntervalsHoldTheTruthUnderNoise) {
  // 0.1 % of a line's own size, Gaussian, seed 5: the standard deviations must say what that does.
  std::vector<GearedLine> lines = Reference();
  Random random(5);
  for (GearedLine& line : lines) {
    for (Complex* value : {&line.pinion_m, &line.gear_m, &line.pinion_a, &line.gear_a}) {
      *value *= 1.0 + 1e-3 * Complex(random.Normal(), random.Normal()) / std::numbers::sqrt2;
    }
  }
  const GearedParameters p = IdentifyGeared(lines, kKnown);
  // Five standard deviations: noise here is not alike on all lines, as the header assumes.
  EXPECT_LT(std::abs(p.mesh_stiffness_n_per_m - kMeshStiffness), 5.0 * p.mesh_stiffness_sigma);
  EXPECT_LT(std::abs(p.pinion.ki_n_per_a - kKi), 5.0 * p.pinion.ki_sigma);
  EXPECT_LT(std::abs(p.gear.ki_n_per_a - kKi), 5.0 * p.gear.ki_sigma);
  EXPECT_GT(p.condition, 1.0);
}

TEST(FullSpectrum, RefusesOneSpeed) {
  std::vector<GearedLine> lines = Reference();
  lines.resize(13);
  try {
    (void)IdentifyGeared(lines, kKnown);
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("one speed only"));
  }
}

TEST(FullSpectrum, RefusesLinesWithoutTheGearsRotation) {
  std::vector<GearedLine> lines;
  for (const GearedLine& line : Reference()) {
    if (line.kind != GearedLine::Kind::kGear) lines.push_back(line);
  }
  try {
    (void)IdentifyGeared(lines, kKnown);
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("gear_1x"));
  }
}

TEST(FullSpectrum, SaysWhichFileCannotBeRead) {
  try {
    (void)ReadGearedLines("/no/such/lines.csv");
    FAIL() << "read";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("/no/such/lines.csv"));
  }
}

}  // namespace
}  // namespace levitas::identification
