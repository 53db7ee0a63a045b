// Options of the pump's trial: what the test-signal inputs leave out, and what a horizon means.

#include "benchmark/accuracy/identification/pump_trial.hpp"

#include <gtest/gtest.h>

#include "identification/nonlinear/known_loop.hpp"

namespace levitas::accuracy {
namespace {

using Index = Eigen::Index;

constexpr Index kFewRows = 1200;  ///< fitted; the trial adds those that judge

PumpPlan FewRows(PumpInputs inputs, std::uint64_t noise_seed = 1) {
  return {.fitted = kFewRows, .inputs = inputs, .noise_seed = noise_seed};
}

/// The pump's rig and the law that levitates it.
struct PumpLaw {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("turbomolecular_pump", "rigs"));
  configuration::ControllerFile controller = configuration::LoadController(
      configuration::FindConfig(rig.run.controller, "controllers"), rig.numbers);

  /// What the controllers make of readings and a test signal, from rest.
  [[nodiscard]] Eigen::MatrixXd Currents(const Eigen::MatrixXd& reading,
                                         const Eigen::MatrixXd& excitation) const {
    const identification::KnownLoop loop(controller.law, rig.numbers, {excitation, {}});
    const identification::Feedback step = loop.AtRest();
    Eigen::MatrixXd currents(reading.rows(), reading.cols());
    Eigen::VectorXd row(reading.cols());
    for (Index k = 0; k < reading.rows(); ++k) {
      step(k, reading.row(k).transpose(), row);
      currents.row(k) = row.transpose();
    }
    return currents;
  }
};

/// Simulated once for all tests: every record plays the pump's lift.
const PumpTrial& Commanded() {
  static const PumpTrial trial([] {
    PumpPlan plan = FewRows(PumpInputs::kCommanded);
    plan.horizons = {1, 5};
    return plan;
  }());
  return trial;
}
const PumpTrial& TestSignals() {
  static const PumpTrial trial(FewRows(PumpInputs::kTestSignals));
  return trial;
}

// Readings that differ by their noise, the same test signal: the models' inputs must be the same to
// the last bit, or motion of the rotor has entered them.
TEST(PumpTrial, TestSignalInputsKnowNothingOfTheRotor) {
  const PumpTrial& one = TestSignals();
  const PumpTrial other(FewRows(PumpInputs::kTestSignals, 2));
  ASSERT_EQ(one.excitation_m(), other.excitation_m());
  EXPECT_NE(one.series().output, other.series().output);
  EXPECT_EQ(one.series().input, other.series().input);
  EXPECT_GT(one.series().input.cwiseAbs().maxCoeff(), 0.0);
}

// The law is linear while no current is at its limit, so that what the controllers make of the
// readings alone is all that is between both inputs. The law had states of its own when the
// excitation began; they are gone where the comparison starts.
TEST(PumpTrial, TestSignalInputsAreTheCommandedOnesWithoutTheFeedback) {
  const identification::Series& commanded = Commanded().series();
  ASSERT_EQ(commanded.output, TestSignals().series().output);
  const Eigen::MatrixXd feedback = PumpLaw().Currents(commanded.output, {});
  const Eigen::MatrixXd between = commanded.input - TestSignals().series().input;
  constexpr Index kCompared = 4000;
  EXPECT_GT(feedback.bottomRows(kCompared).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((between - feedback).bottomRows(kCompared).cwiseAbs().maxCoeff(), 1e-12);
}

// More rows ahead know less of the noise that moves the rotor.
TEST(PumpTrial, AHorizonOfOneRowIsOneStep) {
  const PumpScore lags = Commanded().Narmax();
  const PumpScore banks = Commanded().HammersteinWiener(false);
  for (const PumpScore* score : {&lags, &banks}) {
    ASSERT_EQ(score->ahead.size(), 2U) << score->model;
    EXPECT_LT((score->ahead[0] - score->one_step).cwiseAbs().maxCoeff(), 1e-6) << score->model;
  }
  EXPECT_LT(lags.ahead[1].maxCoeff(), lags.one_step.minCoeff());
}

}  // namespace
}  // namespace levitas::accuracy
