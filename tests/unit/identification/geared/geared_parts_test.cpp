// Parts of the full-spectrum method: its least squares, the shafts' impedances, the wheels'
// rotation; what must not depend on scale, frame or order of the lines; files that are refused.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <numbers>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "identification/geared/full_spectrum.hpp"
#include "identification/geared/geared_forces.hpp"
#include "identification/geared/joint_unknowns.hpp"
#include "identification/geared/line_equations.hpp"
#include "identification/geared/shaft_equations.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/identification/geared/reference_lines.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

const Complex kJ(0.0, 1.0);

/// Two real unknowns and a complex one on lines with random coefficients; `noise` on the right.
LineEquations Equations(std::size_t lines, const Eigen::Vector4d& truth, double noise,
                        std::uint64_t seed, double unit = 1.0, double sigma = 1.0) {
  Random random(seed);
  const auto draw = [&random] { return Complex(random.Normal(), random.Normal()); };
  LineEquations equations(lines, 4);
  for (std::size_t k = 0; k < lines; ++k) {
    const Complex a = draw(), b = draw(), c = draw();
    equations.Real(0, unit * a);
    equations.Real(1, b);
    equations.ComplexAt(2, c);
    const Complex right = unit * a * truth[0] + b * truth[1] + c * Complex(truth[2], truth[3]);
    equations.Close(right + noise * draw(), sigma);
  }
  return equations;
}

const Eigen::Vector4d kTruth(3.0, -2.0, 0.5, 4.0);

TEST(LineEquations, SolveExactLinesForRealAndComplexUnknowns) {
  const Solution s = Equations(5, kTruth, 0.0, 2).Solve("the test");
  EXPECT_LT((s.value - kTruth).norm(), 1e-12);  // rounding
  EXPECT_LT(s.unexplained, 1e-12);
}

TEST(LineEquations, UnitsOfAnUnknownChangeNeitherConditionNorRelativeErrors) {
  const Eigen::Vector4d scaled(3.0e-9, -2.0, 0.5, 4.0);
  const Solution plain = Equations(20, kTruth, 0.1, 3).Solve("the test");
  const Solution other = Equations(20, scaled, 0.1, 3, 1e9).Solve("the test");
  EXPECT_NEAR(other.condition, plain.condition, 1e-9 * plain.condition);
  EXPECT_NEAR(other.value[0] * 1e9, plain.value[0], 1e-9);
  EXPECT_NEAR(other.sigma[0] * 1e9, plain.sigma[0], 1e-9);
}

TEST(LineEquations, DeviationsAreThoseOfTheErrorsWithAndWithoutStatedNoise) {
  for (const double stated : {1.0, 0.2}) {  // 1: nothing stated, the residual says it
    double square = 0.0;
    constexpr int kDraws = 200;
    for (int n = 0; n < kDraws; ++n) {
      const auto seed = static_cast<std::uint64_t>(100 + n);
      const Solution s = Equations(30, kTruth, 0.2, seed, 1.0, stated).Solve("the test");
      square += (s.value - kTruth).cwiseQuotient(s.sigma).squaredNorm() / (4.0 * kDraws);
    }
    // 800 normal errors: 5 % of one sigma, four of them; with stated noise a residual below it is
    // not believed, which widens by a further few per cent.
    EXPECT_NEAR(square, 1.0, 0.25) << stated;
  }
}

TEST(LineEquations, RowsThatDoNotDetermineTheUnknownsAreRefusedWithTheStep) {
  const auto refusal = [](const LineEquations& equations) -> std::string {
    try {
      (void)equations.Solve("mesh stiffness");
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal(Equations(1, kTruth, 0.0, 4)),
              HasSubstr("do not determine mesh stiffness (2 equations, 4 unknowns); record more "
                        "speeds or more lines"));
  LineEquations alike(3, 2);
  for (int k = 1; k <= 3; ++k) {
    alike.Real(0, Complex(k, 1.0));
    alike.Real(1, 2.0 * Complex(k, 1.0));  // the same column twice
    alike.Close(Complex(k, 1.0));
  }
  EXPECT_THAT(refusal(alike), HasSubstr("do not determine mesh stiffness"));
}

GearedLine At(double w_rad_per_s, double speed_rad_per_s) {
  GearedLine line;
  line.frequency_rad_per_s = w_rad_per_s;
  line.speed_rad_per_s = speed_rad_per_s;
  return line;
}

TEST(Impedance, OfATiltingDiscIsTheForcePerDisplacementOfItsFourByFourEquation) {
  const ShaftKnown shaft{2.0, 60.0, 2.0e5, 3.0e3, 4.0e2, 0.01, 0.018, -0.6};
  for (const double w : {-900.0, -40.0, 10.0, 350.0}) {
    const GearedLine line = At(w, 120.0);
    // Displacement r and tilt p, both x + jy:
    // [k + jWc - mW^2, k_la; k_la, k_aa - I_d W^2 + I_p w W]
    Eigen::Matrix2cd dynamic;
    dynamic << Complex(2.0e5 - 2.0 * w * w, 60.0 * w), 3.0e3, 3.0e3,
        4.0e2 - 0.01 * w * w + 0.018 * -0.6 * 120.0 * w;
    const Eigen::Vector2cd answer = dynamic.inverse().col(0);  // to a unit force
    EXPECT_LT(std::abs(Impedance(shaft, line) - 1.0 / answer[0]), 1e-9 * std::abs(1.0 / answer[0]))
        << w;
  }
}

TEST(TwistPerForce, OfOneModeIsItsReceptanceAndOfARealSignalConjugateOnTheMirror) {
  TorsionKnown torsion;
  torsion.normal = std::polar(1.0, 1.2);
  torsion.frequency_rad_per_s = Eigen::VectorXd::Constant(1, 300.0);
  torsion.damping_ratio = Eigen::VectorXd::Constant(1, 0.02);
  torsion.twist_m = Eigen::VectorXd::Constant(1, 0.7);
  torsion.damping_1_per_s = Eigen::MatrixXd::Constant(1, 1, 5.0);
  for (const double w : {50.0, 299.0, 1000.0}) {
    const Complex expected =
        0.49 / (Complex(300.0 * 300.0 - w * w, 2.0 * 0.02 * 300.0 * w) + kJ * w * 5.0);
    EXPECT_LT(std::abs(TwistPerForce(torsion, w) - expected), 1e-12 * std::abs(expected));
    EXPECT_LT(std::abs(TwistPerForce(torsion, -w) - std::conj(expected)),
              1e-12 * std::abs(expected));
  }
  // Lines +-W of one speed: what turns the wheels is real, so that n* w(W) and n* w(-W) are
  // conjugate; a line without its mirror has half of the force along n.
  const std::vector<GearedLine> lines{At(80.0, 10.0), At(-80.0, 10.0), At(80.0, 20.0)};
  const std::vector<Complex> force{Complex(2.0, 1.0), Complex(-0.5, 3.0), Complex(2.0, 1.0)};
  const auto per_force = TwistPerForceOn(lines, torsion);
  const auto twist = TwistOnLines(lines, force, per_force, torsion.normal);
  const Complex along = std::conj(torsion.normal) * twist[0];
  EXPECT_LT(std::abs(along - std::conj(std::conj(torsion.normal) * twist[1])), 1e-18);
  const Complex alone =
      -0.5 * torsion.normal * TwistPerForce(torsion, 80.0) * std::conj(torsion.normal) * force[2];
  EXPECT_LT(std::abs(twist[2] - alone), 1e-18);
  const auto none = TwistPerForceOn(lines, std::nullopt);
  EXPECT_EQ(std::abs(TwistOnLines(lines, force, none, torsion.normal)[0]), 0.0);
}

TEST(MeshForces, OfBothShaftsAgreeAndAreTheTeethsStiffnessAndDampingOnEveryLine) {
  const GearedParameters p = IdentifyGeared(Reference(), kKnown);
  for (const GearedLine& line : Reference()) {
    const MeshForces both = MeshForcesOf(line, kKnown, p);
    Complex teeth = line.pinion_m - line.gear_m;
    if (line.kind == GearedLine::Kind::kPinion) teeth += p.pinion.run_out_m;
    if (line.kind == GearedLine::Kind::kGear) teeth -= p.gear.run_out_m;
    if (line.kind == GearedLine::Kind::kTransmissionError) {
      for (const TransmissionError& e : p.error) {
        if (e.harmonic == line.harmonic) teeth -= e.amplitude_m;
      }
    }
    const Complex expected =
        Complex(p.mesh_stiffness_n_per_m, line.frequency_rad_per_s * p.mesh_damping_n_s_per_m) *
        teeth;
    // Ten digits in the file, of which differences of stiff terms cost four.
    EXPECT_LT(std::abs(both.from_pinion - both.from_gear), 1e-4 * std::abs(expected));
    EXPECT_LT(std::abs(both.from_pinion - expected), 1e-4 * std::abs(expected));
  }
}

struct Shaped {
  const char* name;
  Complex factor;  ///< of all amplitudes
};

class Invariance : public testing::TestWithParam<Shaped> {};

TEST_P(Invariance, RunOutsAndErrorsFollowTheLinesAndStiffnessesDoNot) {
  const GearedParameters plain = IdentifyGeared(Reference(), kKnown);
  std::vector<GearedLine> lines = Reference();
  for (GearedLine& line : lines) {
    for (Complex* value : {&line.pinion_m, &line.gear_m, &line.pinion_a, &line.gear_a}) {
      *value *= GetParam().factor;
    }
  }
  std::reverse(lines.begin(), lines.end());  // nor does the order of the lines
  const GearedParameters moved = IdentifyGeared(lines, kKnown);
  const auto same = [](Complex found, Complex expected) {
    // Rounding times a condition of some thousand.
    EXPECT_LT(std::abs(found - expected), 1e-7 * std::abs(expected));
  };
  same(moved.mesh_stiffness_n_per_m, plain.mesh_stiffness_n_per_m);
  same(moved.mesh_damping_n_s_per_m, plain.mesh_damping_n_s_per_m);
  same(moved.pinion.ki_n_per_a, plain.pinion.ki_n_per_a);
  same(moved.gear.ks_n_per_m, plain.gear.ks_n_per_m);
  same(moved.pinion.run_out_m, GetParam().factor * plain.pinion.run_out_m);
  same(moved.gear.run_out_m, GetParam().factor * plain.gear.run_out_m);
  ASSERT_EQ(moved.error.size(), plain.error.size());
  for (std::size_t k = 0; k < plain.error.size(); ++k) {
    EXPECT_EQ(moved.error[k].harmonic, plain.error[k].harmonic);
    same(moved.error[k].amplitude_m, GetParam().factor * plain.error[k].amplitude_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Factors, Invariance,
                         testing::Values(Shaped{"Scaled", 10.0},
                                         Shaped{"FrameTurned", std::polar(1.0, 0.8)}),
                         [](const auto& p) { return p.param.name; });

TEST(JointUnknowns, BeginAtTheLinearStepsAndTryTheTiltsEitherWay) {
  GearedParameters start;
  start.pinion = {1.0e5, 0.0, 80.0, 0.0, Complex(2e-5, 1e-5), 0.0};
  start.gear = {1.2e5, 0.0, 90.0, 0.0, Complex(-1e-5, 3e-5), 0.0};
  start.mesh_stiffness_n_per_m = 1e6;
  start.mesh_damping_n_s_per_m = 300.0;
  start.error = {{-1, Complex(3e-6, 1e-6), 0.0}, {2, Complex(0.0, 5e-6), 0.0}};
  GearedKnown known = kKnown;
  known.pinion.ks_n_per_m = 1.0e5;
  known.pinion.ki_n_per_a = 80.0;
  known.gear.ks_n_per_m = 1.2e5;
  known.gear.ki_n_per_a = 90.0;
  EXPECT_EQ(JointUnknowns(known, start).starts().size(), 1U);
  known.uncertainty = 0.05;
  known.pinion.tilt_stiffness_n_m = known.gear.tilt_stiffness_n_m = 400.0;
  known.pinion.diametral_kg_m2 = 0.01;
  const JointUnknowns unknowns(known, start);
  const auto starts = unknowns.starts();
  ASSERT_EQ(starts.size(), 9U);  // each tilt as it is, lower and higher
  const GearedParameters at = unknowns.At(starts[0]);
  EXPECT_NEAR(at.gear.ki_n_per_a, 90.0, 1e-12);
  EXPECT_NEAR(std::abs(at.error[1].amplitude_m - start.error[1].amplitude_m), 0.0, 1e-18);
  EXPECT_NEAR(std::abs(at.pinion.run_out_m - start.pinion.run_out_m), 0.0, 1e-18);
  EXPECT_EQ(at.corrected.pinion.mass_kg, known.pinion.mass_kg);
  // ks/ki is what the drawing says and nothing is corrected: nothing departs from what is known.
  EXPECT_LT(unknowns.Held(starts[0]).norm(), 1e-9);
  for (std::size_t n = 1; n < starts.size(); ++n) {
    const auto off = unknowns.At(starts[n]).corrected;
    // One and a half deviations each way, of one tilt or of both.
    const double ratio = off.pinion.diametral_kg_m2 / known.pinion.diametral_kg_m2 - 1.0;
    EXPECT_TRUE(ratio == 0.0 || std::abs(std::abs(ratio) - 0.075) < 1e-12) << ratio;
    EXPECT_GT(unknowns.Held(starts[n]).norm(), 1.49);
  }
}

constexpr const char* kHeader =
    "pinion_speed_hz,line,frequency_hz,pinion_re_m,pinion_im_m,gear_re_m,gear_im_m,"
    "pinion_current_re_a,pinion_current_im_a,gear_current_re_a,gear_current_im_a\n";

struct File {
  const char* name;
  std::string text;
  const char* says;
};

class BadLines : public testing::TestWithParam<File> {};

TEST_P(BadLines, AreRefusedWithFileAndLine) {
  const test::ScratchFolder folder;
  const std::string path = folder / "lines.csv";
  std::ofstream(path) << GetParam().text;
  try {
    (void)ReadGearedLines(path);
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr(path));
    EXPECT_THAT(problem.what(), HasSubstr(GetParam().says));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadLines,
    testing::Values(
        File{"Empty", "", "line 1: found ''"},
        File{"OtherColumns", "speed,line\n", "line 1: found 'speed,line', needed the columns"},
        File{"CellMissing", std::string(kHeader) + "20,mean,0,1,2,3,4,5,6,7\n",
             "line 2: 10 cells, needed 11"},
        File{"NoNumber",
             std::string(kHeader) + "20,mean,0,1,2,3,4,5,6,7,8\n20,mean,0,x,2,3,4,5,6,7,8\n",
             "line 3: 'x' is no finite number"},
        File{"NotANumber", std::string(kHeader) + "20,mean,0,nan,2,3,4,5,6,7,8\n",
             "line 2: 'nan' is no finite number"},
        File{"HalfHarmonic", std::string(kHeader) + "20,mesh_+1.5,0,1,2,3,4,5,6,7,8\n",
             "line 2: line 'mesh_+1.5', allowed: pinion_1x"},
        File{"UnknownLine", std::string(kHeader) + "20,shaft_2x,0,1,2,3,4,5,6,7,8\n",
             "line 2: line 'shaft_2x', allowed: pinion_1x"}),
    [](const auto& p) { return p.param.name; });

}  // namespace
}  // namespace levitas::identification
