#include "analysis/sampled_loop.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "analysis/loop_response.hpp"
#include "controller/law/axis_law.hpp"
#include "numerics/dense/factorisations.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

TEST(AxisModel, RespondsToAnImpulseAsTheLawThatRuns) {
  const law::LawConfig config = test::FlexibleRotorLaw();
  const law::LawCoefficients coefficients(config);
  law::LawState state(coefficients);
  const AxisModel model = ModelOf(law::DiscreteSections(config.axes[0], config.period_s));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(model.a.rows());
  for (int n = 0; n < 200; ++n) {
    const double error_m = n == 0 ? 1e-6 : 0.0;
    AxisArray errors{};
    errors[0] = error_m;
    const double running = law::Step(coefficients, state, errors, {}, 1e9).control_current_a[0];
    const double modelled = model.c.dot(x) + model.d * error_m;
    x = (model.a * x + model.b * error_m).eval();
    // Same filters in another order of operations: rounding against the largest value, 0.1 A.
    EXPECT_NEAR(modelled, running, 1e-13) << "sample " << n;
  }
}

TEST(AxisModel, HasNoSpuriousPoleForFirstOrderAndEmptySections) {
  EXPECT_EQ(ModelOf({{2.0, 0.0, 0.0, 0.0, 0.0}}).a.rows(), 0);
  EXPECT_EQ(ModelOf({{1.0, 0.5, 0.0, -0.2, 0.0}}).a.rows(), 1);
  EXPECT_EQ(ModelOf({{1.0, 0.5, 0.1, -0.2, 0.3}, {1.0, 0.5, 0.0, -0.2, 0.0}}).a.rows(), 3);
  EXPECT_DOUBLE_EQ(ModelOf({{2.0}, {3.0}}).d, 6.0);
}

TEST(AxisModel, HasTheSameFrequencyResponseAsACascadeAndAsStates) {
  const law::LawConfig config = test::FlexibleRotorLaw();
  const AxisModel model = ModelOf(law::DiscreteSections(config.axes[2], config.period_s));
  for (const double f : {1.0, 50.0, 449.0, 2000.0}) {
    const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f * config.period_s);
    const Eigen::MatrixXcd shifted =
        z * Eigen::MatrixXcd::Identity(model.a.rows(), model.a.rows()) - model.a;
    const std::complex<double> states =
        model.d +
        (model.c * shifted.partialPivLu().solve(model.b.cast<std::complex<double>>())).value();
    EXPECT_NEAR(std::abs(model.At(z) - states), 0.0, 1e-8 * std::abs(states)) << f;
    const auto law = law::FrequencyResponse(law::Discretise(config.axes[2], config.period_s), f,
                                            config.period_s);
    EXPECT_NEAR(std::abs(model.At(z) - law), 0.0, 1e-9 * std::abs(law)) << f;
  }
}

TEST(LoopResponse, OfThePlantIsThatOfItsFullMatrices) {
  const SampledLoop loop = CloseLoop(test::QuietFlexibleRotor(), test::FlexibleRotorLaw(), 300.0);
  const LoopResponse response(loop);
  const auto& [a, b, c] = loop.plant;
  const double largest = response.Plant(0.5).norm();
  for (const double f : {0.5, 90.0, 333.0, 5000.0}) {
    const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f * loop.period_s);
    const Eigen::MatrixXcd shifted = z * Eigen::MatrixXcd::Identity(a.rows(), a.cols()) - a;
    const Eigen::MatrixXcd expected =
        c * shifted.partialPivLu().solve(b.cast<std::complex<double>>());
    // Two eliminations of a badly scaled matrix: half the digits; what is left of the rounding in
    // its large entries shows where the response is decades below its largest.
    EXPECT_LT((response.Plant(f) - expected).norm(), 1e-6 * expected.norm() + 1e-10 * largest) << f;
  }
}

TEST(LoopResponse, OfTheSensitivityUndoesOnePlusTheLoop) {
  const SampledLoop loop = CloseLoop(test::QuietFlexibleRotor(), test::FlexibleRotorLaw(), 300.0);
  const LoopResponse response(loop);
  for (const double f : {0.5, 90.0, 333.0}) {
    const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f * loop.period_s);
    Eigen::MatrixXcd open = response.Plant(f);
    for (Eigen::Index i = 0; i < 4; ++i) {
      open.col(i) *= loop.law[static_cast<std::size_t>(i)].At(z);
    }
    const Eigen::MatrixXcd one = Eigen::MatrixXcd::Identity(4, 4);
    EXPECT_LT(((one + open) * response.Sensitivity(f) - one).norm(), 1e-10);
  }
}

TEST(LoopAtBias, OfTheRigsBiasIsTheLoop) {
  const plant::PlantConfig rig = test::QuietFlexibleRotor();
  const SampledLoop loop = CloseLoop(rig, test::FlexibleRotorLaw(), 300.0);
  const SampledLoop same = CloseLoopAtBias(rig, test::FlexibleRotorLaw(), 300.0,
                                           rig.bearings.front().magnet.bias_current_a);
  EXPECT_LT((ClosedLoopMatrix(same) - ClosedLoopMatrix(loop)).norm(),
            1e-12 * ClosedLoopMatrix(loop).norm());
}

// Slow motion, which delay and amplifier follow, cannot tell the bias where the sensors are at the
// magnets: the stiffness of law and magnets together is that of the rig's.
TEST(LoopAtBias, HasTheSameStiffnessBelowTheAmplifiers) {
  plant::PlantConfig rig = test::QuietFlexibleRotor();
  for (auto& bearing : rig.bearings) bearing.sensor_z_m = bearing.actuator_z_m;
  const auto answer = [](const SampledLoop& loop, double f) {
    const LoopResponse response(loop);
    const auto z = std::polar(1.0, 2.0 * std::numbers::pi * f * loop.period_s);
    Eigen::MatrixXcd law = Eigen::MatrixXcd::Zero(4, 4);
    for (Eigen::Index i = 0; i < 4; ++i) law(i, i) = loop.law[static_cast<std::size_t>(i)].At(z);
    // What the rotor answers to a force that passes the magnets' ki: P (1 + C P)^-1 over ki.
    const Eigen::MatrixXcd plant = response.Plant(f);
    return Eigen::MatrixXcd(plant * (Eigen::MatrixXcd::Identity(4, 4) + law * plant).inverse());
  };
  const double whole_a = rig.bearings.front().magnet.bias_current_a;
  const double bias_a = 0.4 * whole_a;
  const SampledLoop loop = CloseLoop(rig, test::FlexibleRotorLaw(), 0.0);
  const SampledLoop low = CloseLoopAtBias(rig, test::FlexibleRotorLaw(), 0.0, bias_a);
  const Eigen::MatrixXcd before = answer(loop, 1.0);
  EXPECT_LT((answer(low, 1.0) * (whole_a / bias_a) - before).norm(), 0.01 * before.norm());
}

TEST(LoopAtBias, RefusesAMagnetOfAnotherLaw) {
  plant::PlantConfig rig = test::QuietFlexibleRotor();
  rig.bearings.front().magnet.exponential = plant::ExponentialForce{};
  EXPECT_THROW((void)CloseLoopAtBias(rig, test::FlexibleRotorLaw(), 0.0, 0.4),
               std::invalid_argument);
}

TEST(LargestSingularValue, IsTheGainOfTheWorstDirection) {
  Eigen::MatrixXcd matrix(2, 2);
  matrix << 3.0, 0.0, 4.0, 0.0;  // maps (1, 0) to (3, 4)
  EXPECT_NEAR(LargestSingularValue(matrix), 5.0, 1e-12);
}

}  // namespace
}  // namespace levitas::analysis
