// Models of the levitated pump from a record of its closed loop, magnets saturating and sensors
// curved, under the excitation of H.-L. Chiu (2022), Appl. Sci. 12, 8556: how well they run free,
// nothing measured in them, the known controllers closing their loop. No setting was chosen on the
// seeds used here.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "benchmark/accuracy/identification/pump_trial.hpp"

namespace levitas::test {
namespace {

constexpr Eigen::Index kAxes = 4;

class PumpModels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    trial_ = std::make_unique<accuracy::PumpTrial>(accuracy::PumpPlan{.knee_a = 3.0,
                                                                      .a2_1_per_m = 1000.0,
                                                                      .a3_1_per_m2 = 1e7,
                                                                      .noise_seed = 20270401,
                                                                      .excitation_seed = 401});
    ceiling_ = trial_->Ceiling();
  }
  static void TearDownTestSuite() { trial_.reset(); }

  /// The fits, per axis; written into the test's record.
  static void Keep(const std::string& name, const Eigen::VectorXd& fit) {
    for (Eigen::Index i = 0; i < fit.size(); ++i) {
      RecordProperty(name + "_" + std::to_string(i), std::to_string(fit[i]));
    }
  }

  static std::unique_ptr<accuracy::PumpTrial> trial_;
  static Eigen::VectorXd ceiling_;
};
std::unique_ptr<accuracy::PumpTrial> PumpModels::trial_;
Eigen::VectorXd PumpModels::ceiling_;

// The noise of the readings moves the rotor too: by how much, a second record tells without any
// model. What both records share is the simulator's answer, each has noise of its own: squares add.
TEST_F(PumpModels, CeilingIsThatOfTwoRecordsWithNoiseOfTheirOwn) {
  const Eigen::VectorXd repeated = trial_->Repeated(20270402);
  const Eigen::VectorXd readings = trial_->CeilingOfReadings();
  for (Eigen::Index i = 0; i < kAxes; ++i) {
    const double noise = 100.0 - ceiling_[i];
    // White noise of the readings, most of it, is known to 1 % from 4000 rows; the share that the
    // loop shapes, a tenth, from its slowest mode's few periods to some ten times that.
    EXPECT_NEAR((100.0 - repeated[i]) / std::sqrt(2.0), noise, 0.1 * noise) << i;
    EXPECT_LT(ceiling_[i], readings[i]) << i;
  }
  Keep("ceiling_readings", readings);
  Keep("ceiling", ceiling_);
}

TEST_F(PumpModels, ASuspendedRotorRunsFreeWithinTwoTenthsOfAPointOfTheCeiling) {
  const auto score = trial_->SuspendedRotor();
  Keep("suspended_rotor_free", score.free_run);
  for (Eigen::Index i = 0; i < kAxes; ++i) {
    EXPECT_GT(score.free_run[i], ceiling_[i] - 0.2) << i;
    // By chance a model may share a little of what the noise did in 0.2 s, no more.
    EXPECT_LT(score.free_run[i], ceiling_[i] + 0.2) << i;
  }
}

// What the curve of the iron is for: without it the same model stays further below.
TEST_F(PumpModels, WithStraightIronItStaysFurtherBelow) {
  const auto score = trial_->SuspendedRotor(0);
  Keep("straight_iron_free", score.free_run);
  EXPECT_LT(score.free_run.mean(), ceiling_.mean() - 0.2);
}

// The recursion, the same online: with the products of current and position it comes as near, with
// curves of the currents alone it does not.
TEST_F(PumpModels, HammersteinWienerWithProductsRunsFreeWithinTwoTenthsOfAPointOfTheCeiling) {
  const auto with = trial_->HammersteinWiener(true);
  const auto without = trial_->HammersteinWiener(false);
  Keep("products_one_step", with.one_step);
  Keep("products_free", with.free_run);
  Keep("hammerstein_wiener_one_step", without.one_step);
  Keep("hammerstein_wiener_free", without.free_run);
  for (Eigen::Index i = 0; i < kAxes; ++i) {
    EXPECT_GT(with.free_run[i], ceiling_[i] - 0.2) << i;
    EXPECT_LT(with.free_run[i], ceiling_[i] + 0.2) << i;
  }
  EXPECT_LT(without.free_run.mean(), with.free_run.mean() - 0.1);
  // The paper's own figure, on its own rig, is 93.25 %: a goal, not a bound of this one.
  EXPECT_GT(without.free_run.mean(), 93.25);
}

// Lags of 50 us of noisy readings: one step ahead they say nearly all, by themselves nearly
// nothing.
TEST_F(PumpModels, OfLagsPredictOneStepAndDoNotRunFree) {
  for (const auto& score : {trial_->Narx(), trial_->Narmax()}) {
    Keep(score.model + "_one_step", score.one_step);
    Keep(score.model + "_free", score.free_run);
    EXPECT_GT(score.one_step.minCoeff(), 90.0) << score.model;
    EXPECT_TRUE(score.diverged || score.free_run.maxCoeff() < 50.0) << score.model;
  }
}

}  // namespace
}  // namespace levitas::test
