#include "design/synthesis/hinf_synthesis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <string>

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/spectra/spectra.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

constexpr double kSearch = 5e-3;  // tolerance of the search, the relaxation and the norm's bracket

/// Largest singular value on a grid, and the poles: neither uses the library's norm.
void ExpectGainBelow(const GeneralisedPlant& plant, const HinfController& made) {
  const StateSpace loop = LowerFeedback(plant.system, made.controller);
  EXPECT_LT(loop.A.eigenvalues().real().maxCoeff(), 0.0);
  for (int i = 0; i <= 2000; ++i) {
    const double w = i == 0 ? 0.0 : std::pow(10.0, -4.0 + 10.0 * i / 2000.0);
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(Response(loop, w));
    ASSERT_LE(svd.singularValues()(0), made.gamma * (1.0 + 1e-6)) << "at " << w << " rad/s";
  }
}

TEST(HinfSynthesis, OfAScalarPlantReachesItsClosedForm) {
  for (const double a : {-1.0, -0.3, 0.0, 1.0, 4.0}) {
    const GeneralisedPlant plant = ScalarPlant(a);
    const HinfController made = Synthesise(plant);
    const double gamma = a + std::sqrt(a * a + 2.0);
    EXPECT_GE(made.gamma, gamma * (1.0 - 1e-6)) << a;
    EXPECT_LE(made.gamma, gamma * (1.0 + kSearch)) << a;
    ExpectGainBelow(plant, made);
  }
}

TEST(HinfSynthesis, OfASensitivityReachesTheWeightAtTheRightHalfPlaneZero) {
  // Interpolation: S(zero) = 1, S(pole) = 0; the smallest norm of W S is |W(zero)|, and with an
  // unstable pole |W(zero) (zero + pole)/(zero - pole)| (Zhou, Doyle & Glover 1996, section 6.3).
  const StateSpace weight = FirstOrder(20.0, 3.0, 0.1);
  const double zero = 2.0;
  const double at_zero = 20.0 * (zero / 3.0 + 1.0) / (zero / 0.1 + 1.0);
  const GeneralisedPlant stable = SensitivityPlant(FirstOrder(1.0, -zero, 5.0), weight);
  HinfController made = Synthesise(stable);
  EXPECT_NEAR(made.gamma, at_zero, kSearch * at_zero);
  EXPECT_GE(made.gamma, at_zero * (1.0 - 1e-6));
  ExpectGainBelow(stable, made);

  const double pole = 0.5;
  const double limit = at_zero * (zero + pole) / (zero - pole);
  const GeneralisedPlant unstable = SensitivityPlant(FirstOrder(1.0, -zero, -pole), weight);
  made = Synthesise(unstable);
  EXPECT_NEAR(made.gamma, limit, kSearch * limit);
  EXPECT_GE(made.gamma, limit * (1.0 - 1e-6));
  ExpectGainBelow(unstable, made);
}

TEST(HinfSynthesis, OfAGainWithoutStatesIsParrottsTheorem) {
  Random random(3);
  StateSpace system = Gain(DrawMatrix(random, 4, 4));
  system.D.topRightCorner(3, 1) = Eigen::Vector3d(0.0, 0.0, 2.0);
  system.D.bottomLeftCorner(1, 3) = Eigen::RowVector3d(0.0, 0.0, -3.0);
  // The control reaches the last error only, the measurement shows the last disturbance only.
  const Eigen::MatrixXd rows = system.D.topLeftCorner(2, 3);
  const Eigen::MatrixXd columns = system.D.topLeftCorner(3, 2);
  const double limit = std::max(Eigen::JacobiSVD<Eigen::MatrixXd>(rows).singularValues()(0),
                                Eigen::JacobiSVD<Eigen::MatrixXd>(columns).singularValues()(0));
  const HinfController made = Synthesise({system, 1, 1});
  EXPECT_NEAR(made.gamma, limit, kSearch * limit);
  EXPECT_GE(made.gamma, limit * (1.0 - 1e-6));
}

TEST(HinfSynthesis, OfDrawnPlantsWithEveryDirectGainKeepsItsPromise) {
  Random random(20261127);
  for (int trial = 0; trial < 25; ++trial) {
    const GeneralisedPlant plant = DrawPlant(random, 2 + trial % 7);
    const HinfController made = Synthesise(plant);
    EXPECT_LE(made.gamma, made.limit * (1.0 + kSearch)) << "trial " << trial;
    ExpectGainBelow(plant, made);
  }
}

TEST(HinfSynthesis, NoControllerOfDrawnOnesIsBelowTheLimit) {
  Random random(20261128);
  const GeneralisedPlant plant = DrawPlant(random, 3);
  const HinfController made = Synthesise(plant);
  EXPECT_FALSE(CentralController(plant, 0.98 * made.limit));
  // Around the best controller: no drawn change of it falls below what is said to be impossible.
  for (int trial = 0; trial < 300; ++trial) {
    HinfController other = made;
    const double size = std::pow(10.0, -3.0 * random.Uniform());
    other.controller.C += size * DrawMatrix(random, 2, 3);
    other.controller.D += size * DrawMatrix(random, 2, 2);
    const StateSpace loop = LowerFeedback(plant.system, other.controller);
    if (!IsStable(loop)) continue;
    double largest = 0.0;
    for (int i = 0; i <= 400; ++i) {
      const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(
          Response(loop, std::pow(10.0, -3.0 + 6.0 * i / 400.0)));
      largest = std::max(largest, svd.singularValues()(0));
    }
    EXPECT_GE(largest, made.limit * (1.0 - 0.005));  // tolerance of the search, step of the grid
  }
}

TEST(HinfSynthesis, HoldsAnAxisWithDelayAndLightlyDampedModes) {
  const GeneralisedPlant plant = FlexibleAxis();
  const HinfController made = Synthesise(plant);
  ExpectGainBelow(plant, made);
  EXPECT_LT(made.gamma, 1.05 * made.limit);  // the check did not have to give much away
  EXPECT_EQ(made.controller.states(), plant.system.states());
}

TEST(HinfSynthesis, NamesTheConditionThatFails) {
  GeneralisedPlant plant = ScalarPlant(1.0);
  plant.system.B(0, 2) = 0.0;
  EXPECT_THAT(RefusalOf(plant), ::testing::HasSubstr("not stabilisable"));
  plant = ScalarPlant(1.0);
  plant.system.C(2, 0) = 0.0;
  EXPECT_THAT(RefusalOf(plant), ::testing::HasSubstr("not detectable"));
  plant = ScalarPlant(1.0);
  plant.system.D(1, 2) = 0.0;
  EXPECT_THAT(RefusalOf(plant), ::testing::HasSubstr("a control current is not weighted"));
  plant = ScalarPlant(1.0);
  plant.system.D(2, 1) = 0.0;
  EXPECT_THAT(RefusalOf(plant), ::testing::HasSubstr("carries no noise"));
  plant = ScalarPlant(0.0);
  plant.system.C(0, 0) = 0.0;  // an integrator that no error shows
  EXPECT_THAT(RefusalOf(plant), ::testing::HasSubstr("zero on the imaginary axis at 0 Hz"));
}

TEST(HinfSynthesis, SaysWhichConditionLimitsGamma) {
  std::string reason;
  EXPECT_FALSE(CentralController(ScalarPlant(1.0), 2.0, &reason));  // smallest is 1 + sqrt(3)
  EXPECT_THAT(reason, ::testing::HasSubstr("control and estimation together"));
}

}  // namespace
}  // namespace levitas::synthesis
