#include "diagnosis/inference/validation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/validation_doubt.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Runs on the validation data, compared block by block.
class Judge {
 public:
  Judge(const RecordLandscape& landscape, const std::vector<Record>& validation)
      : landscape_(landscape),
        all_(DataOf(validation)),
        part_(DataOf(Spans(validation, kFarRows, landscape.rig().period_s))),
        rows_(BlockRows(landscape.rig())) {}

  struct Forecast {
    Runs runs;
    double penalty{};  ///< of what was adapted, squared
  };
  /// Of a set that was fitted to the point; `movable`: of its numbers those that may adapt.
  [[nodiscard]] Forecast Of(const std::vector<Hypothesis>& causes, const Point& fit,
                            const std::vector<std::size_t>& movable) const {
    const Evidence fitted = landscape_.EvidenceGiven(causes);
    // Far from the optimum the innovations are mostly what is not adapted yet. The filter of the
    // fit would take them for a hundred deviations of noise, so the first steps have filters of
    // these innovations themselves.
    State far = At(part_, fit, movable, fitted.Unchanged());
    for (int step = 0; step < kFarSteps; ++step) {
      const Whitener own = landscape_.search().WhitenerOf(*far.forecast.runs, kWhiteningOrder);
      if (!Downhill(part_, fitted, fit, movable, own, far)) break;
    }
    const Whitener& whitener = landscape_.view().whitener;
    State now = At(all_, fit, movable, fitted.Unchanged());
    State near = At(all_, fit, movable, far.adapted);
    if (Squared(near.forecast, whitener) < Squared(now.forecast, whitener)) now = std::move(near);
    for (int step = 0; step < kNearSteps; ++step) {
      if (!Downhill(all_, fitted, fit, movable, whitener, now)) break;
    }
    return now.forecast;
  }
  /// As fitted: nothing adapts.
  [[nodiscard]] Forecast Plain(const Point& fit) const { return {RunAt(all_, fit), 0.0}; }
  [[nodiscard]] FitGain Gain(const Forecast& first, const Forecast& second) const {
    FitGain gain = GainedFit(*first.runs, *second.runs, landscape_.view().whitener, rows_);
    gain.value += first.penalty - second.penalty;
    return gain;
  }

 private:
  struct Data {
    std::vector<Record> records;
    Gains gains;
  };
  [[nodiscard]] Data DataOf(std::vector<Record> records) const {
    Gains gains = landscape_.search().DesignGains(records, kSpeeds[landscape_.speed()]);
    return {std::move(records), std::move(gains)};
  }

  struct State {
    Forecast forecast;
    Evidence::Adapted adapted;
    Point point;
  };
  /// `movable` of the fit's numbers moved as they adapted.
  [[nodiscard]] State At(const Data& data, const Point& fit,
                         const std::vector<std::size_t>& movable,
                         const Evidence::Adapted& adapted) const {
    State state{{nullptr, adapted.penalty}, adapted, fit};
    for (const std::size_t i : movable) {
      const Term& term = landscape_.terms()[i];
      const double moved = adapted.change[static_cast<Eigen::Index>(i)] * term.scale();
      state.point.theta[i] = std::max(fit.theta[i] + moved, LeastPossible(term));
    }
    state.forecast.runs = RunAt(data, state.point);
    return state;
  }

  [[nodiscard]] Runs RunAt(const Data& data, const Point& point) const {
    return std::make_shared<const std::vector<Trajectory>>(
        landscape_.search().Run(data.records, data.gains, point));
  }

  /// Whether a step lowered the cost. A critical speed that moves bends more than a straight line:
  /// a step that overshoots is damped, or a set that needs to adapt would seem to foretell nothing.
  [[nodiscard]] bool Downhill(const Data& data, const Evidence& fitted, const Point& fit,
                              const std::vector<std::size_t>& movable, const Whitener& whitener,
                              State& now) const {
    const View there =
        landscape_.search().Linearise(now.forecast.runs, now.point, whitener, movable);
    if (SensitivitiesDiverge(there.sum)) return false;
    const double before = Squared(now.forecast, whitener);
    for (double damping = 0.0; damping < kMostDamping;
         damping = std::max(kLeastDamping, 10.0 * damping)) {
      State tried = At(data, fit, movable, fitted.Adapt(there.sum, now.adapted, damping));
      const double after = Squared(tried.forecast, whitener);
      if (!(after < before)) continue;
      now = std::move(tried);
      return after < before - kConverged;
    }
    return false;
  }

  /// Whitened innovations and what was paid for them.
  [[nodiscard]] double Squared(const Forecast& forecast, const Whitener& whitener) const {
    return SquaredSum(*forecast.runs, landscape_.rig().axes, whitener) + forecast.penalty;
  }

  static constexpr std::size_t kFarRows = 20'000;
  static constexpr int kFarSteps = 8;
  static constexpr int kNearSteps = 4;
  static constexpr double kLeastDamping = 0.1;
  static constexpr double kMostDamping = 2e3;
  static constexpr double kConverged = 3.0;

  const RecordLandscape& landscape_;
  Data all_, part_;
  std::size_t rows_;
};

/// The calibrated model without the causes, which stay away.
Point PointWithoutCauses(const RecordLandscape& landscape, const CauseSelection& found) {
  Point point = found.WithoutCauses();
  for (std::size_t i = 0; i < point.theta.size(); ++i) {
    if (Moves(found.causes, i)) point.theta[i] = landscape.terms()[i].healthy_mean;
  }
  return point;
}

Judge::Forecast WithoutCauses(const RecordLandscape& landscape, const CauseSelection& found,
                              const Judge& judge) {
  std::vector<std::size_t> movable = landscape.search().Nuisances();
  std::erase_if(movable, [&found](std::size_t i) { return Moves(found.causes, i); });
  return judge.Of({}, PointWithoutCauses(landscape, found), movable);
}

Judge::Forecast With(const RecordLandscape& landscape, const Judge& judge,
                     const std::vector<Hypothesis>& causes, const Point& point) {
  return judge.Of(causes, point, landscape.search().NuisancesAnd(causes));
}

/// The candidate of the chosen contender leads, whatever the fitted records say.
void Lead(CauseSelection& found, effect::Id effect) {
  auto& all = found.candidates;
  const auto own =
      std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.effect == effect; });
  if (own != all.end()) std::rotate(all.begin(), own, own + 1);
}

void Note(CauseSelection& found, effect::Id effect, const FitGain& gain) {
  for (Candidate& c : found.candidates) {
    if (c.effect == effect) c.validation_nat = 0.5 * gain.value;
  }
}

}  // namespace

std::optional<std::size_t> Choose(const std::vector<FitGain>& over_leader, double deviations) {
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t i = 0; i < over_leader.size(); ++i) {
    const FitGain& gain = over_leader[i];
    if (!Confirms(gain.value, gain.deviation, deviations) || gain.value <= most) continue;
    most = gain.value;
    best = i;
  }
  return best;
}

void DoubtBy(const FitGain& worth, const FittedEvidence& fitted, const Judging& judging,
             CauseSelection& found) {
  if (found.causes.empty()) return;
  found.doubt = DoubtOf(worth.value, worth.deviation, judging.gain_deviations);
  if (found.doubt == Doubt::kValidationHarm) {
    found.probability = ChanceOfGain(worth.value, worth.deviation);
  } else if (found.doubt == Doubt::kUnconfirmed) {
    found.probability = ChanceOfOpen(fitted.nat, 0.5 * worth.value, fitted.effects);
  }
}

void JudgeOnValidation(RecordLandscape& landscape, const std::vector<Record>& validation,
                       const Judging& judging, CauseSelection& found) {
  if (validation.empty() || found.causes.empty()) return;
  landscape.ReportProgress(0.89, "judging on validation data");
  const Judge judge(landscape, validation);
  const double deviations = judging.gain_deviations;
  const Judge::Forecast base = WithoutCauses(landscape, found, judge);
  const Judge::Forecast leader = With(landscape, judge, found.causes, found.point);
  FitGain worth = judge.Gain(base, leader);
  Note(found, found.causes.front().effect, worth);
  std::vector<FitGain> over_leader;
  for (const CauseSet& other : found.contenders) {
    const Judge::Forecast forecast = With(landscape, judge, other.causes, other.fit.point);
    over_leader.push_back(judge.Gain(leader, forecast));
    Note(found, other.causes.front().effect, judge.Gain(base, forecast));
  }
  if (const auto chosen = Choose(over_leader, deviations)) {
    found.causes = found.contenders[*chosen].causes;
    found.point = found.contenders[*chosen].fit.point;
    Lead(found, found.causes.front().effect);
    landscape.LineariseAt(found.point);
    worth = judge.Gain(WithoutCauses(landscape, found, judge),
                       With(landscape, judge, found.causes, found.point));
  }
  DoubtBy(
      worth,
      {found.candidates.empty() ? 0.0 : found.candidates.front().score, found.candidates.size()},
      judging, found);
  if (found.doubt == Doubt::kUnconfirmed) {
    // A wrong calibration may adapt as far as it must; what was foretold without that counts, too.
    const FitGain plain =
        judge.Gain(judge.Plain(PointWithoutCauses(landscape, found)), judge.Plain(found.point));
    if (Confirms(plain.value, plain.deviation, deviations)) {
      found.doubt = Doubt::kNothing;
      found.probability = 0.0;
    }
  }
}

}  // namespace levitas::diagnosis
