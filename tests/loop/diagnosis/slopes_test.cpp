// Kept derivatives: their sums are those of the propagated derivatives, and a fit along them claims
// no more than the model keeps.

#include "diagnosis/model/slopes.hpp"
#include "analysis/reading_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/terms/terms.hpp"

namespace levitas::diagnosis {
namespace {

class SlopesTest : public ::testing::Test {
 protected:
  void Prepare(std::vector<effect::Id> hidden) {
    accuracy::TrialPlan plan;
    plan.seed = 22;
    plan.hidden = std::move(hidden);
    plan.bits_per_axis = 500;
    plan.runup_s = 1.0;
    trial_ = accuracy::MakeTrial(bench_, plan);
    records_ = {trial_.records[0], trial_.records[1]};
    records_[1].number = 1;
    gains_ = search_.DesignGains(records_, kFast);
  }

  [[nodiscard]] std::size_t Find(const std::string& effect) const {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].effect_name() == effect) return i;
    }
    ADD_FAILURE() << effect;
    return 0;
  }

  accuracy::TestRig bench_ = accuracy::LoadTestRig("flexible_rotor", {"flexible_rotor"});
  RigView view_{bench_.rig.numbers, bench_.rig.plant};
  std::vector<Term> terms_ = AllTerms(view_, Tolerances{}, 50e-6);
  Search search_{view_, terms_};
  accuracy::Trial trial_;
  std::vector<Record> records_;
  Gains gains_;
};

TEST_F(SlopesTest, SumUpToWhatThePropagatedDerivativesGive) {
  Prepare({});
  const std::size_t at = Find("sensor_gain");
  const Point healthy = search_.HealthyPoint();
  const std::vector<double>& theta = healthy.theta;
  const View view = search_.Linearise(records_, gains_, healthy, 2, {at});
  double jtj = 0.0;
  double jte = 0.0;
  double ete = 0.0;
  for (const Trajectory& run : *view.runs) {
    SensitivityBlock block(view_, LaneModels(view_, run.gains, ChangeOf(terms_, theta)), terms_,
                           theta, {at});
    const std::size_t samples = run.moments.size();
    std::vector<std::array<float, kMaxAxes * kLanes>> d(samples);
    for (std::size_t n = 0; n < samples; ++n) block.Step(run.moments[n], d[n].data());
    for (std::size_t n = 2; n < samples; ++n) {
      if (!run.moments[n].counts) continue;
      for (std::size_t a = 0; a < view_.axes; ++a) {
        double slope = 0.0;
        double e = 0.0;
        for (std::size_t k = 0; k <= 2; ++k) {
          slope += view.whitener.filter[a][k] * static_cast<double>(d[n - k][a * kLanes]);
          e += view.whitener.filter[a][k] * static_cast<double>(run.moments[n - k].innovation_m[a]);
        }
        jtj += slope * slope;
        jte += slope * e;
        ete += e * e;
      }
    }
  }
  const auto row = static_cast<Eigen::Index>(at);
  // Both in double from the same single-precision derivatives.
  EXPECT_NEAR(view.sum.jtj(row, row), jtj, 1e-9 * jtj);
  EXPECT_NEAR(view.sum.jte[row], jte, 1e-9 * std::sqrt(jtj * ete));
  EXPECT_NEAR(view.sum.ete, ete, 1e-9 * ete);
}

TEST_F(SlopesTest, RenewedWithTheSameRunStayWhatTheyWere) {
  Prepare({});
  const View view =
      search_.Linearise(records_, gains_, search_.HealthyPoint(), 4, search_.Everything());
  NormalEquations sum = view.sum;
  view.slopes->Renew(*view.runs, view.whitener, sum);
  EXPECT_NEAR(sum.ete, view.sum.ete, 1e-9 * sum.ete);
  for (Eigen::Index i = 0; i < sum.jte.size(); ++i) {
    // Products in single precision: a millionth of the two vectors' lengths.
    EXPECT_NEAR(sum.jte[i], view.sum.jte[i], 1e-6 * std::sqrt(sum.jtj(i, i) * sum.ete))
        << terms_[static_cast<std::size_t>(i)].effect_name();
  }
}

// Slopes from the usual rig lead nowhere from a gain that is far off; renewed on the way, they lead
// to the same place as from near by.
TEST_F(SlopesTest, AFitFromFarComesToWhereOneFromNearComes) {
  Prepare({});
  const Refiner refiner(search_, terms_, records_, gains_, view_.axes);
  const View view =
      search_.Linearise(records_, gains_, search_.HealthyPoint(), 4, search_.Everything());
  Point far = search_.HealthyPoint();
  far.theta[Find("current_gain")] = 0.3;
  const Refined from_far = refiner.Fit({}, far, view, 4);
  const Refined from_near = refiner.Fit({}, search_.HealthyPoint(), view, 4);
  ASSERT_TRUE(from_far.ok);
  ASSERT_TRUE(from_near.ok);
  // A descent stops where a pass gains less than 0.3 nat, or promises less than 1.
  EXPECT_NEAR(from_far.cost, from_near.cost, 2.0);
  EXPECT_NEAR(from_far.evidence, from_near.evidence, 2.0);
}

// What the straight line promises beyond what the model did is not counted.
TEST_F(SlopesTest, AFitIsWorthWhatTheModelDoesAndNoMore) {
  Prepare({});
  const Refiner refiner(search_, terms_, records_, gains_, view_.axes);
  const View view =
      search_.Linearise(records_, gains_, search_.HealthyPoint(), 4, search_.Everything());
  const Refined fit = refiner.Fit({}, search_.HealthyPoint(), view, 4);
  ASSERT_TRUE(fit.ok);
  const auto line = Evidence(fit.problem, terms_, {}).Solve();
  const double promised = 0.5 * (line.squared_sum + line.penalty);
  EXPECT_NEAR(fit.evidence, Refiner::EvidenceOfSet(fit.problem, terms_, {}) - (fit.cost - promised),
              1e-6 * fit.cost);
}

// Far from its file, slopes taken there lead nowhere after a step or two; they must be renewed, and
// a whitening of its own must not make the file's orbit look like colour.
TEST_F(SlopesTest, OfACalibrationAreRenewedUntilALargeUnbalanceIsFollowedToTheNoise) {
  Prepare({effect::Id::kUnbalance});
  const Gains slow = search_.DesignGains(records_, kSlow);
  const Refined fit =
      CalibrateNuisances(view_, search_, terms_, records_, records_, slow, kSlow, 8);
  ASSERT_TRUE(fit.ok);
  const auto runs = search_.Run(records_, slow, fit.point);
  const auto nominal = search_.Run(records_, slow, search_.HealthyPoint());
  const auto rms = [](const Trajectory& run, std::size_t axis) {
    double sum = 0.0;
    double count = 0.0;
    for (const SamplePoint& m : run.moments) {
      if (!m.counts) continue;
      sum += std::pow(static_cast<double>(m.innovation_m[axis]), 2);
      count += 1.0;
    }
    return std::sqrt(sum / count);
  };
  double before = 0.0;
  double after = 0.0;
  for (std::size_t a = 0; a < view_.axes; ++a) {
    const double noise_m = analysis::ReadingNoise(view_.bearing(a).sensor);
    before = std::max(before, rms(nominal[1], a) / noise_m);
    after = std::max(after, rms(runs[1], a) / noise_m);
  }
  // What shapes of modes leave is a few per cent of the noise.
  EXPECT_GT(before, 1.3) << "the trial is no challenge";
  EXPECT_LT(after, 1.1);
}

}  // namespace
}  // namespace levitas::diagnosis
