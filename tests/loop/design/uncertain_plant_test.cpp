#include "design/uncertainty/uncertain_plant.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "analysis/loop_response.hpp"
#include "analysis/sensitivity.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::uncertainty {
namespace {

struct Shipped {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  configuration::ControllerFile controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
};

const Shipped& Files() {
  static const Shipped files;
  return files;
}

TEST(UncertainPlant, IsTheSampledPlantWhereImagesAreSmall) {
  // The sampled model is exact; this one leaves out images above 5 kHz, where the plant is 1e-4 of
  // what it is below 300 Hz.
  configuration::RigFile unloaded = Files().rig;
  unloaded.plant.gravity_m_per_s2 = 0.0;
  const double speed = RpmToRadPerS(6000.0);
  const UncertainPlant plant(unloaded, {}, speed);
  const analysis::LoopResponse sampled(
      analysis::CloseLoop(unloaded.plant, Files().controller.law, speed));
  for (const double hz : {1.0, 20.0, 85.0, 180.0, 300.0}) {
    const Eigen::MatrixXcd wanted = sampled.Plant(hz);
    EXPECT_LT((plant.At(hz).yu - wanted).norm(), 2e-3 * wanted.norm()) << hz;
  }
}

TEST(UncertainPlant, SeesTheSensitivityThatTheSampledLoopHas) {
  configuration::RigFile unloaded = Files().rig;
  unloaded.plant.gravity_m_per_s2 = 0.0;
  const UncertainPlant plant(unloaded, {}, 0.0);
  const LawResponse law(Files().controller.law);
  for (const double hz : {10.0, 40.0, 100.0, 200.0}) {
    const auto wanted =
        analysis::SensitivityAt(unloaded.plant, Files().controller.law, 0.0, {hz}).front();
    const Eigen::MatrixXcd s = SensitivityOf(plant.At(hz), law.At(hz));
    for (Eigen::Index i = 0; i < 4; ++i)
      EXPECT_NEAR(std::abs(s(i, i)), wanted[static_cast<std::size_t>(i)],
                  5e-3 * wanted[static_cast<std::size_t>(i)])
          << hz;
  }
}

// A perturbation put into M by hand moves the plant as the drawn rig's own model does.
TEST(UncertainPlant, PerturbationsMoveThePlantAsADrawnRigDoes) {
  configuration::RigFile rig = Files().rig;
  const auto parameters = Stated(rig, {.mode_hz = 0.01});  // small: the perturbation is linear in w
  Random draw(20261125);
  std::vector<double> place;
  for (std::size_t i = 0; i < parameters.size(); ++i) place.push_back(2.0 * draw.Uniform() - 1.0);
  const double speed = RpmToRadPerS(3000.0);
  const UncertainPlant nominal(rig, parameters, speed);
  const UncertainPlant drawn(At(rig, parameters, place), {}, speed);
  Eigen::VectorXcd delta(nominal.perturbations());
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const bool mode =
        parameters[i].kind == Kind::kModeFrequency || parameters[i].kind == Kind::kModeDamping;
    // More frequency and damping push against the motion.
    for (int plane = 0; plane < (mode ? 2 : 1); ++plane) delta(at++) = mode ? -place[i] : place[i];
  }
  ASSERT_EQ(at, delta.size());
  for (const double hz : {30.0, 88.0, 251.0, 505.0, 735.0}) {
    const PlantPoint p = nominal.At(hz);
    const Eigen::MatrixXcd loop = Eigen::MatrixXcd::Identity(at, at) - delta.asDiagonal() * p.zw;
    const Eigen::MatrixXcd moved = p.yu + p.yw * loop.inverse() * delta.asDiagonal() * p.zu;
    const Eigen::MatrixXcd wanted = drawn.At(hz).yu;
    EXPECT_GT((p.yu - wanted).norm(), 5e-3 * wanted.norm()) << hz;  // it does move
    EXPECT_LT((moved - wanted).norm(), 1e-3 * wanted.norm()) << hz;
  }
}

TEST(ComplexMu, IsBetweenTheSpectralRadiusAndTheLargestSingularValue) {
  Random draw(7);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::MatrixXcd m = Eigen::MatrixXcd::NullaryExpr(
        8, 8, [&] { return std::complex<double>(draw.Normal(), draw.Normal()); });
    const double mu = ComplexMu(m, 4);
    // 1e-9: rounding of the eigenvalue solver.
    EXPECT_GE(mu, (1.0 - 1e-9) * m.eigenvalues().cwiseAbs().maxCoeff());
    EXPECT_LE(mu, (1.0 + 1e-9) * Eigen::JacobiSVD<Eigen::MatrixXcd>(m).singularValues()(0));
    EXPECT_NEAR(QuickMu(m, 4), mu, 0.15 * mu);  // random matrices have gains side by side
  }
}

TEST(AnalysisWeights, FollowThePublishedLimits) {
  const AnalysisWeights weights;
  EXPECT_NEAR(AllowedPositionM(weights, 1e-4), 0.7e-6, 0.01e-6);
  EXPECT_NEAR(AllowedPositionM(weights, 100.0), 36e-6, 0.01e-6);
  EXPECT_NEAR(AllowedCurrentA(weights, 720.0), 1.0 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(DisturbanceA(weights, 0, 10.0), 1.05 * 0.2786, 1e-3);
  EXPECT_NEAR(DisturbanceA(weights, 1, 200.0), 0.01 * 1.05 * 0.2058, 2e-4);  // 40 dB down
}

}  // namespace
}  // namespace levitas::uncertainty
