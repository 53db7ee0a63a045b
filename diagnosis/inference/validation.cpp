#include "diagnosis/inference/validation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "diagnosis/inference/validation_doubt.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Runs on the validation data, compared block by block.
class Judge {
 public:
  Judge(const RecordLandscape& landscape, const std::vector<Record>& validation)
      : landscape_(landscape),
        validation_(validation),
        gains_(landscape.search().DesignGains(validation, kSpeeds[landscape.speed()])),
        rows_(BlockRows(landscape.rig())) {}

  struct Forecast {
    Runs runs;
    double penalty{};  ///< of what was adapted, squared
  };
  /// Of a set that was fitted to the point; `movable`: of its numbers those that may adapt.
  [[nodiscard]] Forecast Of(const std::vector<Hypothesis>& causes, const Point& fit,
                            const std::vector<std::size_t>& movable) const {
    const Whitener& whitener = landscape_.view().whitener;
    const Evidence fitted = landscape_.EvidenceGiven(causes);
    Evidence::Adapted adapted = fitted.Unchanged();
    Point at = fit;
    Forecast best{RunAt(at), 0.0};
    double least = Squared(best);
    for (int step = 0; step < kSteps; ++step) {
      const View there = landscape_.search().Linearise(best.runs, at, whitener, movable);
      if (SensitivitiesDiverge(there.sum)) break;
      const auto next = fitted.Adapt(there.sum, adapted);
      Point moved = fit;
      for (const std::size_t i : movable) {
        moved.theta[i] += next.change[static_cast<Eigen::Index>(i)] * landscape_.terms()[i].scale();
      }
      Forecast tried{RunAt(moved), next.penalty};
      const double squared = Squared(tried);
      if (!(squared < least)) break;
      const bool converged = squared > least - kConverged;
      best = std::move(tried);
      least = squared;
      adapted = next;
      at = std::move(moved);
      if (converged) break;
    }
    return best;
  }
  [[nodiscard]] FitGain Gain(const Forecast& first, const Forecast& second) const {
    FitGain gain = GainedFit(*first.runs, *second.runs, landscape_.view().whitener, rows_);
    gain.value += first.penalty - second.penalty;
    return gain;
  }

 private:
  [[nodiscard]] Runs RunAt(const Point& point) const {
    return std::make_shared<const std::vector<Trajectory>>(
        landscape_.search().Run(validation_, gains_, point));
  }

  /// Whitened innovations and what was paid for them.
  [[nodiscard]] double Squared(const Forecast& forecast) const {
    return SquaredSum(*forecast.runs, landscape_.rig().axes, landscape_.view().whitener) +
           forecast.penalty;
  }

  static constexpr int kSteps = 4;
  static constexpr double kConverged = 3.0;

  const RecordLandscape& landscape_;
  const std::vector<Record>& validation_;
  Gains gains_;
  std::size_t rows_;
};

/// The calibrated model without the causes, which stay away.
Judge::Forecast WithoutCauses(const RecordLandscape& landscape, const CauseSelection& found,
                              const Judge& judge) {
  Point point = found.WithoutCauses();
  std::vector<std::size_t> movable;
  for (std::size_t i = 0; i < point.theta.size(); ++i) {
    const bool cause = Moves(found.causes, i);
    if (cause) point.theta[i] = landscape.terms()[i].healthy_mean;
    if (!cause && landscape.terms()[i].nuisance()) movable.push_back(i);
  }
  return judge.Of({}, point, movable);
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
  found.doubt = DoubtOf(worth.value, worth.deviation, deviations);
  if (found.doubt == Doubt::kValidationHarm) {
    found.probability = ChanceOfGain(worth.value, worth.deviation);
  } else if (found.doubt == Doubt::kUnconfirmed) {
    const double fitted_nat = found.candidates.empty() ? 0.0 : found.candidates.front().score;
    found.probability = ChanceOfOpen(fitted_nat, 0.5 * worth.value, found.candidates.size());
  }
}

}  // namespace levitas::diagnosis
