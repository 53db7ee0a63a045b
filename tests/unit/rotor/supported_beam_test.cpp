// Supported beams against the closed forms of Euler, Rayleigh and Timoshenko.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "numerics/dense/factorisations.hpp"
#include "plant_sim/rotor/beam_element.hpp"
#include "tests/unit/rotor/support_conditions.hpp"

namespace levitas::rotor {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Material kBeamSteel{210e9, 0.3, 7850.0};

FiniteElementModel Beam(const Section& section, int elements,
                        const Material& material = kBeamSteel) {
  RotorConfig config;
  config.material = material;
  config.sections = {section};
  config.max_element_length_m = section.length_m / elements;
  return Assemble(config, {});
}

double SecondMomentM4(const Section& s) {
  return kPi / 64.0 * (std::pow(s.outer_diameter_m, 4) - std::pow(s.inner_diameter_m, 4));
}

double ShearStiffnessN(const Section& s) {
  const double kappa = 6.0 * 1.3 / (7.0 + 6.0 * 0.3);  // Cowper (1966), Poisson's ratio 0.3
  return kappa * 210e9 / 2.6 * CrossSectionM2(s);
}

// Rotating Timoshenko beam between two pins, deflection W sin(p z), slope P cos(p z), p = n pi/L:
// each n is a system of two unknowns of its own, so this is exact.
Supported ExactPinned(const Section& s, int n) {
  const double p = n * kPi / s.length_m;
  const double rotary = 7850.0 * SecondMomentM4(s);
  const double shear = ShearStiffnessN(s);
  Supported exact;
  exact.mass = Eigen::Vector2d(7850.0 * CrossSectionM2(s), rotary).asDiagonal();
  exact.gyroscopic = Eigen::Vector2d(0.0, 2.0 * rotary).asDiagonal();
  exact.stiffness.resize(2, 2);
  exact.stiffness << shear * p * p, -shear * p, -shear * p,
      210e9 * SecondMomentM4(s) * p * p + shear;
  return exact;
}

struct EulerCase {
  const char* name;
  bool clamped_at_start;
  bool clamped_at_end;
  bool free_at_end;
  double beta_l[3];  // Blevins (1979), table 8-1
};

constexpr EulerCase kEuler[] = {
    {"clamped-free", true, false, true, {1.87510407, 4.69409113, 7.85475744}},
    {"pinned-pinned", false, false, false, {kPi, 2.0 * kPi, 3.0 * kPi}},
    {"clamped-pinned", true, false, false, {3.92660231, 7.06858275, 10.21017612}},
    {"clamped-clamped", true, true, false, {4.73004074, 7.85320462, 10.9956079}},
};

TEST(SlenderBeam, HasEulersFrequenciesUnderEverySupport) {
  const Section slender{2.0, 0.004, 0.0};
  const auto model = Beam(slender, 40);
  const int last = static_cast<int>(model.mass.rows()) - 2;
  const double factor = 0.001 * std::sqrt(210e9 / 7850.0) / 4.0;  // radius of gyration d/4
  for (const auto& c : kEuler) {
    std::vector<int> held{0};
    if (c.clamped_at_start) held.push_back(1);
    if (!c.free_at_end) held.push_back(last);
    if (c.clamped_at_end) held.push_back(last + 1);
    const auto found = Forward(Hold(model, held));
    for (std::size_t i = 0; i < 3; ++i) {
      // Shear and rotary inertia take (b k)^2 (1 + E/(kappa G))/2 = 6e-5 of the highest of these,
      // and the mesh adds (b l)^4/1440 = 4e-6.
      EXPECT_NEAR(found[i] / (c.beta_l[i] * c.beta_l[i] * factor), 1.0, 1e-4) << c.name << i;
    }
  }
}

// With shear the element converges with its square only: it holds the shear strain constant, and a
// constant misses (p l)^2/12 of the energy of a wave. Two meshes take that term out (Richardson);
// what stays is of fourth order, (4 pi/40)^4/720 = 1e-5 of the fourth mode.
constexpr double kExtrapolated = 1e-5;

double Extrapolated(double coarse, double twice_as_fine) {
  return (4.0 * twice_as_fine - coarse) / 3.0;
}

TEST(StubbyBeam, HasTimoshenkosExactFrequenciesBetweenPins) {
  // Ten times as long as thick: Euler would be wrong by 1 % (first mode) to 16 % (fourth).
  for (const double inner_diameter_m : {0.0, 0.03}) {
    const Section s{0.5, 0.05, inner_diameter_m};
    const auto coarse = Forward(PinnedAtBothEnds(Beam(s, 40)));
    const auto fine = Forward(PinnedAtBothEnds(Beam(s, 80)));
    for (int n = 1; n <= 4; ++n) {
      const auto i = static_cast<std::size_t>(n - 1);
      const double exact = Forward(ExactPinned(s, n)).front();
      EXPECT_NEAR(Extrapolated(coarse[i], fine[i]) / exact, 1.0, kExtrapolated) << n;
    }
  }
}

TEST(StubbyBeam, SplitsItsWhirlAsTheRotatingTimoshenkoBeam) {
  const Section s{0.5, 0.08, 0.02};
  const auto coarse = PinnedAtBothEnds(Beam(s, 40));
  const auto fine = PinnedAtBothEnds(Beam(s, 80));
  for (const double speed_rad_per_s : {500.0, 5000.0, 20000.0}) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto exact = ExactPinned(s, static_cast<int>(i) + 1);
      const double forward =
          Extrapolated(Forward(coarse, speed_rad_per_s)[i], Forward(fine, speed_rad_per_s)[i]);
      const double backward =
          Extrapolated(Backward(coarse, speed_rad_per_s)[i], Backward(fine, speed_rad_per_s)[i]);
      const double exact_forward = Forward(exact, speed_rad_per_s)[0];
      const double exact_backward = Backward(exact, speed_rad_per_s)[0];
      EXPECT_NEAR(forward / exact_forward, 1.0, kExtrapolated) << i;
      EXPECT_NEAR(backward / exact_backward, 1.0, kExtrapolated) << i;
      // The split itself, a small part of the frequencies at the lowest speed.
      EXPECT_NEAR((forward - backward) / (exact_forward - exact_backward), 1.0, 1e-3) << i;
    }
  }
}

double MeshError(const Section& s, int elements) {
  const double exact = Forward(ExactPinned(s, 1)).front();
  return Forward(PinnedAtBothEnds(Beam(s, elements))).front() / exact - 1.0;
}

TEST(BeamMesh, OfASlenderBeamConvergesWithTheFourthPowerOfTheElement) {
  const Section s{0.5, 0.0005, 0.0};
  // Ritz: a conforming element can only be too stiff.
  EXPECT_GT(MeshError(s, 16), 0.0);
  // Halving divides by 16; the next order is a tenth of (p l)^2 = 0.6 and 0.15, and the shear term
  // takes (p k)^2 E/(kappa G) x 60/(p l)^2 = 5 % at the finest.
  EXPECT_NEAR(MeshError(s, 4) / MeshError(s, 8), 16.0, 1.0);
  EXPECT_NEAR(MeshError(s, 8) / MeshError(s, 16), 16.0, 0.8);
}

TEST(BeamMesh, OfAStubbyBeamConvergesWithItsSquareAndStaysBelowTheShearTerm) {
  const Section s{0.5, 0.05, 0.0};
  const double wave_per_m = kPi / 0.5;
  const double gyration_m = 0.0125;
  for (const int elements : {16, 32, 64}) {
    // (p l)^2/24 of the share that shear has in the energy, at most (p k)^2 E/(kappa G).
    const double bound = std::pow(wave_per_m * 0.5 / elements, 2) / 24.0 *
                         std::pow(wave_per_m * gyration_m, 2) * 2.6 / (7.8 / 8.8);
    EXPECT_GT(MeshError(s, elements), 0.5 * bound) << elements;
    EXPECT_LT(MeshError(s, elements), 1.1 * bound) << elements;
  }
  EXPECT_NEAR(MeshError(s, 32) / MeshError(s, 64), 4.0, 0.1);  // the fourth order: 1 % here
}

TEST(BeamMesh, OnlyLowersFrequenciesWhenANodeIsAdded) {
  // A finer mesh contains the coarser one's shapes (Timoshenko's are static solutions), so each
  // Ritz frequency can only fall.
  const Section s{0.6, 0.03, 0.01};
  auto coarse = Forward(ClampedAtTheDriveEnd(Beam(s, 3)));
  for (const int elements : {6, 12, 24}) {
    const auto fine = Forward(ClampedAtTheDriveEnd(Beam(s, elements)));
    for (std::size_t i = 0; i < coarse.size(); ++i) {
      EXPECT_LE(fine[i], coarse[i] * (1.0 + 1e-9)) << elements << " " << i;  // solver's rounding
    }
    coarse = fine;
  }
}

TEST(SteppedCantilever, DeflectsAsCastiglianoSaysWhateverTheMesh) {
  const Section thick{0.2, 0.04, 0.01};
  const Section thin{0.3, 0.02, 0.0};
  const double b1 = 210e9 * SecondMomentM4(thick);
  const double b2 = 210e9 * SecondMomentM4(thin);
  const double expected = (0.125 - 0.027) / (3.0 * b1) +
                          0.027 / (3.0 * b2) +  // bending of both pieces
                          0.2 / ShearStiffnessN(thick) + 0.3 / ShearStiffnessN(thin);
  for (const double length_m : {0.5, 0.07, 0.011}) {
    RotorConfig config;
    config.material = kBeamSteel;
    config.sections = {thick, thin};
    config.max_element_length_m = length_m;
    const auto shaft = ClampedAtTheDriveEnd(Assemble(config, {}));
    const Eigen::Index tip = shaft.stiffness.rows() - 2;
    const Eigen::VectorXd load = Eigen::VectorXd::Unit(shaft.stiffness.rows(), tip);
    const Eigen::VectorXd deflection = shaft.stiffness.partialPivLu().solve(load);
    // Exact at nodes; the condition number of 46 elements, about 1e8, leaves eight digits.
    EXPECT_NEAR(deflection[tip] / expected, 1.0, 1e-7) << length_m;
  }
}

// Disc at the end of a massless clamped shaft, from flexibilities: deflection L^3/(3 E I) +
// L/(kappa G A), slope L^2/(2 E I), L/(E I).
Supported ExactOverhung(const Section& s, const Disc& disc) {
  const double bending = 210e9 * SecondMomentM4(s);
  const double l = s.length_m;
  Eigen::Matrix2d flexibility;
  flexibility << l * l * l / (3.0 * bending) + l / ShearStiffnessN(s), l * l / (2.0 * bending),
      l * l / (2.0 * bending), l / bending;
  Supported exact;
  exact.mass = Eigen::Vector2d(disc.mass_kg, disc.diametral_inertia_kg_m2).asDiagonal();
  exact.gyroscopic = Eigen::Vector2d(0.0, disc.polar_inertia_kg_m2).asDiagonal();
  exact.stiffness = flexibility.inverse();
  return exact;
}

TEST(OverhungDisc, WhirlsAsTheTwoDegreesOfFreedomOfTheDisc) {
  const Section s{0.4, 0.012, 0.0};
  const Disc disc{0.4, 3.0, 0.012, 0.022};
  RotorConfig config;
  config.material = {210e9, 0.3, 0.1};  // shaft of 5 mg: 33/140 of it is 1e-6 of the disc
  config.sections = {s};
  config.discs = {disc};
  config.max_element_length_m = 0.2;
  const auto shaft = ClampedAtTheDriveEnd(Assemble(config, {}));
  for (const double speed_rad_per_s : {0.0, 50.0, 300.0, 2000.0}) {
    const auto exact = ExactOverhung(s, disc);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(Forward(shaft, speed_rad_per_s)[i] / Forward(exact, speed_rad_per_s)[i], 1.0,
                  1e-5);
      EXPECT_NEAR(Backward(shaft, speed_rad_per_s)[i] / Backward(exact, speed_rad_per_s)[i], 1.0,
                  1e-5);
    }
  }
}

}  // namespace
}  // namespace levitas::rotor
