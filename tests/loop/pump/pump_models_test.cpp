// Models of the levitated pump from records of its closed loop, under the excitation of H.-L. Chiu
// (2022), Appl. Sci. 12, 8556: how well they run free, nothing measured in them, the known
// controllers closing their loop.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "controller/law/axis_law.hpp"
#include "identification/nonlinear/hammerstein_wiener.hpp"
#include "identification/nonlinear/narx.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::test {
namespace {

using identification::Series;

constexpr Eigen::Index kAxes = 4;
constexpr Eigen::Index kTrain = 40'000;     // 2 s
constexpr Eigen::Index kWarm = 1000;        // free running already, not judged
constexpr Eigen::Index kValidation = 4000;  // 0.2 s, as in the paper

struct Campaign {
  Series series;               ///< currents that were commanded in, readings out
  Eigen::MatrixXd excitation;  ///< [m] added to what the law reads
};

Campaign Record(ShippedLoop& loop) {
  Campaign campaign;
  campaign.series.period_s = loop.rig.numbers.period_s();
  campaign.series.input.resize(80'000, kAxes);
  campaign.series.output.resize(80'000, kAxes);
  campaign.excitation.resize(80'000, kAxes);
  Eigen::Index row = 0;
  EXPECT_EQ(loop.Play(20261121, 10.0,
                      [&](const cycle::CycleRecord& record) {
                        if (record.in.op.excitation_m[0] == 0.0 || row == 80'000) return;
                        for (Eigen::Index i = 0; i < kAxes; ++i) {
                          const auto at = static_cast<std::size_t>(i);
                          campaign.series.input(row, i) = record.out.current.control_current_a[at];
                          campaign.series.output(row, i) = record.in.frame.position_m[at];
                          campaign.excitation(row, i) = record.in.op.excitation_m[at];
                        }
                        ++row;
                      }),
            "");
  EXPECT_EQ(row, 80'000);
  return campaign;
}

/// The known controllers, from readings to currents, as they were when the free run begins.
class KnownControllers {
 public:
  KnownControllers(const ShippedLoop& loop, const Campaign& campaign, Eigen::Index begin)
      : campaign_(campaign), coefficients_(AtPeriod(loop)), state_(coefficients_), begin_(begin) {
    Eigen::VectorXd current_a(kAxes);
    for (Eigen::Index row = -2000; row < 0; ++row) {
      (*this)(row, campaign.series.output.row(begin + row).transpose(), current_a);
    }
  }

  void operator()(Eigen::Index row, const Eigen::VectorXd& y_m, Eigen::VectorXd& current_a) {
    AxisArray error_m{};
    for (Eigen::Index i = 0; i < kAxes; ++i) {
      error_m[static_cast<std::size_t>(i)] = -(y_m[i] + campaign_.excitation(begin_ + row, i));
    }
    constexpr double kLimit_a = 1.5;  // the bias
    const law::LawOutput out = law::Step(coefficients_, state_, error_m, {}, kLimit_a);
    for (Eigen::Index i = 0; i < kAxes; ++i) {
      current_a[i] = out.control_current_a[static_cast<std::size_t>(i)];
    }
  }

 private:
  static law::LawConfig AtPeriod(const ShippedLoop& loop) {
    law::LawConfig law = loop.controller.law;
    law.period_s = loop.rig.numbers.period_s();
    return law;
  }

  const Campaign& campaign_;
  law::LawCoefficients coefficients_;
  law::LawState state_;
  Eigen::Index begin_;
};

/// Free run of a model of lags: outputs are its own, inputs those of the controllers.
Eigen::MatrixXd RunFree(const identification::LaggedModel& model, const Series& series,
                        KnownControllers& controllers) {
  Eigen::MatrixXd input = series.input.array().rowwise() / model.input_scale.transpose().array();
  Eigen::MatrixXd output = series.output.array().rowwise() / model.output_scale.transpose().array();
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(series.rows(), kAxes);
  Eigen::VectorXd window(model.layout.size());
  Eigen::VectorXd current_a(kAxes);
  for (Eigen::Index k = 0; k < series.rows(); ++k) {
    if (k >= model.layout.Memory()) {
      FillWindow(model, input, output, none, k, window);
      for (Eigen::Index i = 0; i < kAxes; ++i) {
        const auto& features = model.features[static_cast<std::size_t>(i)];
        double sum = 0.0;
        for (std::size_t f = 0; f < features.size(); ++f) {
          sum += model.theta[static_cast<std::size_t>(i)][static_cast<Eigen::Index>(f)] *
                 features[f].Value(window);
        }
        output(k, i) = std::clamp(sum, -1000.0, 1000.0);
      }
    }
    controllers(k, (output.row(k).transpose().array() * model.output_scale.array()).matrix(),
                current_a);
    input.row(k) = (current_a.array() / model.input_scale.array()).matrix().transpose();
  }
  return output.array().rowwise() * model.output_scale.transpose().array();
}

class PumpModels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    loop_ = std::make_unique<ShippedLoop>("turbomolecular_pump", "turbomolecular_pump_identify");
    campaign_ = std::make_unique<Campaign>(Record(*loop_));
  }
  static void TearDownTestSuite() {
    campaign_.reset();
    loop_.reset();
  }

  static Series Train() { return identification::Slice(campaign_->series, {0, kTrain}); }
  static Series Judge() {
    return identification::Slice(campaign_->series, {kTrain, kTrain + kWarm + kValidation});
  }
  static KnownControllers Controllers() { return {*loop_, *campaign_, kTrain}; }

  /// Fit of the rows that judge, per axis; written into the test's record.
  static Eigen::VectorXd Fit(const std::string& name, const Eigen::MatrixXd& predicted) {
    Eigen::VectorXd fit = identification::FitPercent(Judge().output, predicted, kWarm);
    for (Eigen::Index i = 0; i < kAxes; ++i) {
      RecordProperty(name + "_" + std::to_string(i), std::to_string(fit[i]));
    }
    return fit;
  }

  /// What noise alone leaves of a fit: 0.2 um on every reading.
  static Eigen::VectorXd Ceiling() {
    const Eigen::MatrixXd judged = Judge().output.bottomRows(kValidation);
    Eigen::VectorXd ceiling(kAxes);
    for (Eigen::Index i = 0; i < kAxes; ++i) {
      const double mean = judged.col(i).mean();
      const double spread = std::sqrt((judged.col(i).array() - mean).square().mean());
      ceiling[i] = 100.0 * (1.0 - 0.2e-6 / spread);
      RecordProperty("ceiling_" + std::to_string(i), std::to_string(ceiling[i]));
    }
    return ceiling;
  }

  static std::unique_ptr<ShippedLoop> loop_;
  static std::unique_ptr<Campaign> campaign_;
};
std::unique_ptr<ShippedLoop> PumpModels::loop_;
std::unique_ptr<Campaign> PumpModels::campaign_;

TEST_F(PumpModels, HammersteinWienerRunsFreeInTheLoopOfTheKnownControllersNearTheNoise) {
  identification::HammersteinWienerOptions options;
  options.bandwidth_hz = 600.0;  // of the memory: about the bending mode
  const auto fit = identification::FitHammersteinWiener(Train(), options);
  KnownControllers controllers = Controllers();
  const auto free = SimulateFreeRun(
      fit.model, Judge(), [&](Eigen::Index row, const Eigen::VectorXd& y, Eigen::VectorXd& u) {
        controllers(row, y, u);
      });
  EXPECT_FALSE(free.diverged_at.has_value());
  const Eigen::VectorXd freely = Fit("hammerstein_wiener_free", free.output);
  const Eigen::VectorXd ceiling = Ceiling();
  // The paper's own figure, on its own rig, is 93.25 %: a goal, not a bound of this one.
  EXPECT_GT(freely.mean(), 93.25);
  for (Eigen::Index i = 0; i < kAxes; ++i) {
    EXPECT_GT(freely[i], 90.0) << i;
    EXPECT_LT(freely[i], ceiling[i]) << i;  // better than the noise would be looking ahead
  }
}

// Lags of 50 us of noisy readings: one step ahead they say nearly all, by themselves nearly
// nothing.
TEST_F(PumpModels, OfLagsPredictOneStepAndDoNotRunFree) {
  for (const bool noise_model : {false, true}) {
    identification::NarxOptions options;
    options.layout = {kAxes, kAxes, 4, 4, 1, noise_model ? 3 : 0};
    options.degree = 2;
    options.most_terms = noise_model ? 14 : 200;
    options.network_units = noise_model ? 0 : 10;
    const auto fit = identification::FitNarx(Train(), options);
    KnownControllers controllers = Controllers();
    const std::string name = noise_model ? "narmax" : "narx";
    const auto ahead = Fit(name + "_one_step", PredictOneStep(fit.model, Judge()).output);
    const auto freely = Fit(name + "_free", RunFree(fit.model, Judge(), controllers));
    EXPECT_GT(ahead.minCoeff(), 90.0) << name;
    EXPECT_LT(freely.maxCoeff(), 50.0) << name;
  }
}

}  // namespace
}  // namespace levitas::test
