#include "diagnosis/inference/validation.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Runs on the validation data, compared block by block.
class Judge {
 public:
  explicit Judge(const SearchState& state)
      : state_(state),
        gains_(state.search.DesignGains(state.validation, kSpeeds[state.speed])),
        rows_(BlockRows(state.rig)) {}

  struct Forecast {
    Runs runs;
    double penalty{};  ///< of what was adapted, squared
  };
  /// Of a set that was fitted to theta; `movable`: of its numbers those that may adapt.
  [[nodiscard]] Forecast Of(const std::vector<Hypothesis>& causes, const std::vector<double>& theta,
                            const std::vector<std::size_t>& movable) const {
    const Whitener& whitener = state_.view.whitener;
    const Evidence fitted(state_.view.problem, state_.terms, causes);
    Evidence::Adapted adapted = fitted.Unchanged();
    std::vector<double> at = theta;
    Forecast best{RunAt(at), 0.0};
    double least = Squared(best);
    for (int step = 0; step < kSteps; ++step) {
      const View there = state_.search.Linearise(best.runs, at, whitener, movable);
      if (SensitivitiesDiverge(there.sum)) break;
      const auto next = fitted.Adapt(there.sum, adapted);
      std::vector<double> moved = theta;
      for (const std::size_t i : movable) {
        moved[i] += next.change[static_cast<Eigen::Index>(i)] * state_.terms[i].scale();
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
    FitGain gain = GainedFit(*first.runs, *second.runs, state_.view.whitener, rows_);
    gain.value += first.penalty - second.penalty;
    return gain;
  }

 private:
  [[nodiscard]] Runs RunAt(const std::vector<double>& theta) const {
    return std::make_shared<const std::vector<Trajectory>>(
        state_.search.Run(state_.validation, gains_, theta));
  }

  /// Whitened innovations and what was paid for them.
  [[nodiscard]] double Squared(const Forecast& forecast) const {
    return SquaredSum(*forecast.runs, state_.rig.axes, state_.view.whitener) + forecast.penalty;
  }

  static constexpr int kSteps = 4;
  static constexpr double kConverged = 3.0;

  const SearchState& state_;
  Gains gains_;
  std::size_t rows_;
};

/// The calibrated model without the causes, which stay away.
Judge::Forecast WithoutCauses(const SearchState& state, const Judge& judge) {
  std::vector<double> theta = state.calibrated;
  std::vector<std::size_t> movable;
  for (std::size_t i = 0; i < theta.size(); ++i) {
    const bool cause = Moves(state.causes, i);
    if (cause) theta[i] = state.terms[i].healthy_mean;
    if (!cause && state.terms[i].nuisance()) movable.push_back(i);
  }
  return judge.Of({}, theta, movable);
}

Judge::Forecast With(const SearchState& state, const Judge& judge,
                     const std::vector<Hypothesis>& causes, const std::vector<double>& theta) {
  return judge.Of(causes, theta, state.search.NuisancesAnd(causes));
}

/// The candidate of the chosen contender leads, whatever the fitted records say.
void Lead(SearchState& state, const std::string& effect) {
  auto& all = state.candidates;
  const auto own =
      std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.effect == effect; });
  if (own != all.end()) std::rotate(all.begin(), own, own + 1);
}

void Note(SearchState& state, const std::string& effect, const FitGain& gain) {
  for (Candidate& c : state.candidates) {
    if (c.effect == effect) c.validation_nat = 0.5 * gain.value;
  }
}

}  // namespace

std::optional<std::size_t> Choose(const std::vector<FitGain>& over_leader, double deviations) {
  std::optional<std::size_t> best;
  double most = 0.0;
  for (std::size_t i = 0; i < over_leader.size(); ++i) {
    const FitGain& gain = over_leader[i];
    if (!std::isfinite(gain.value) || !(gain.value > deviations * gain.deviation)) continue;
    if (gain.value <= most) continue;
    most = gain.value;
    best = i;
  }
  return best;
}

void JudgeOnValidation(SearchState& state) {
  if (state.validation.empty() || state.causes.empty()) return;
  state.ReportProgress(0.89, "judging on validation data");
  const Judge judge(state);
  const double deviations = state.settings.judging.gain_deviations;
  const Judge::Forecast base = WithoutCauses(state, judge);
  const Judge::Forecast leader = With(state, judge, state.causes, state.theta);
  FitGain worth = judge.Gain(base, leader);
  Note(state, state.causes.front().effect, worth);
  std::vector<FitGain> over_leader;
  for (const CauseSet& other : state.contenders) {
    const Judge::Forecast forecast = With(state, judge, other.causes, other.fit.theta);
    over_leader.push_back(judge.Gain(leader, forecast));
    Note(state, other.causes.front().effect, judge.Gain(base, forecast));
  }
  if (const auto chosen = Choose(over_leader, deviations)) {
    state.causes = state.contenders[*chosen].causes;
    state.theta = state.contenders[*chosen].fit.theta;
    Lead(state, state.causes.front().effect);
    state.LineariseAll();
    worth = judge.Gain(WithoutCauses(state, judge), With(state, judge, state.causes, state.theta));
  }
  if (worth.value >= -deviations * worth.deviation) return;
  state.doubt = Doubt::kHeldOutHarm;
  // A model that diverges on the validation data is refuted, too.
  state.probability = std::isfinite(worth.value)
                          ? 0.5 * std::erfc(-worth.value / (std::sqrt(2.0) * worth.deviation))
                          : 0.0;
}

}  // namespace levitas::diagnosis
