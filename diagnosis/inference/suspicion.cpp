#include "diagnosis/inference/suspicion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kLikely = 0.5;

/// Fits the candidate's hypothesis and gives it the score of the nonlinear model.
Refined Confirm(SearchState& state, Candidate& candidate) {
  const std::vector<Hypothesis> causes{state.search.hypotheses()[candidate.hypothesis]};
  state.ReportProgress(0.88, "refitting " + candidate.effect);
  const Refined before = state.refiner.Fit({}, state.calibrated, state.view, 1);
  Refined fit = state.Refit(causes);
  if (!before.ok || !fit.ok) return {};
  candidate.score = std::min(candidate.score, fit.evidence - before.evidence);
  candidate.refitted = true;
  return fit;
}

void Suspect(SearchState& state, std::size_t hypothesis, Refined fit, Doubt doubt,
             double probability) {
  state.causes = {state.search.hypotheses()[hypothesis]};
  state.theta = std::move(fit.theta);
  state.doubt = doubt;
  state.probability = probability;
}

bool SuspectLeader(SearchState& state) {
  const double tie_nat = state.settings.judging.decisive_nat;
  if (state.candidates.empty() || !(ProbabilityOfLeader(state.candidates, tie_nat) > kLikely))
    return false;
  const std::size_t hypothesis = state.candidates.front().hypothesis;
  Refined fit;
  if (!state.candidates.front().refitted) {
    fit = Confirm(state, state.candidates.front());
    SortByScore(state.candidates);
    if (!fit.ok || state.candidates.front().hypothesis != hypothesis) return false;
  } else {
    fit = state.Refit({state.search.hypotheses()[hypothesis]});
  }
  const double probability = ProbabilityOfLeader(state.candidates, tie_nat);
  if (!fit.ok || !(probability > kLikely)) return false;
  Suspect(state, hypothesis, std::move(fit), Doubt::kWeakEvidence, probability);
  return true;
}

/// The hypothesis of the term's effect that moves nothing else.
std::optional<std::size_t> AloneOf(const SearchState& state, std::size_t term) {
  const auto& all = state.search.hypotheses();
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].effect != state.terms[term].effect_name() || !Moves(all[i], term)) continue;
    if (!best || all[i].terms.size() < all[*best].terms.size()) best = i;
  }
  return best;
}

void SuspectNumber(SearchState& state) {
  const Fit posterior = Evidence(state.view.problem, state.terms, {}).Solve();
  const auto moved = FurthestNumber(state.terms, posterior, state.calibrated);
  if (!moved || !(moved->chance < state.settings.judging.number_chance)) return;
  const auto hypothesis = AloneOf(state, moved->term);
  if (!hypothesis) return;
  Refined fit = state.Refit({state.search.hypotheses()[*hypothesis]});
  if (!fit.ok) return;
  Suspect(state, *hypothesis, std::move(fit), Doubt::kMovedNumber, 1.0 - moved->chance);
  const auto& cause = state.causes.front();
  const auto own = std::find_if(state.candidates.begin(), state.candidates.end(),
                                [&cause](const Candidate& c) { return c.effect == cause.effect; });
  if (own == state.candidates.end()) return;
  own->place = cause.place;
  own->hypothesis = *hypothesis;
  std::rotate(state.candidates.begin(), own, own + 1);
}

}  // namespace

double ProbabilityOfLeader(const std::vector<Candidate>& candidates, double tie_nat) {
  if (candidates.empty() || !std::isfinite(candidates.front().score)) return 0.0;
  const double best = candidates.front().score;
  double leader = 0.0;
  double all = 0.0;
  for (const Candidate& c : candidates) {
    if (!std::isfinite(c.score)) continue;
    const double weight = std::exp(c.score - best);
    all += weight;
    if (c.score > best - tie_nat) leader += weight;
  }
  return leader / (all + static_cast<double>(candidates.size()) * std::exp(-best));
}

double ChanceOfOne(double deviations, std::size_t numbers) {
  const double one = std::erfc(deviations / std::sqrt(2.0));
  return -std::expm1(static_cast<double>(numbers) * std::log1p(-one));
}

std::optional<MovedNumber> FurthestNumber(const std::vector<Term>& terms, const Fit& fit,
                                          const std::vector<double>& theta) {
  constexpr double kDetermined = 0.5;
  std::size_t determined = 0;
  std::optional<MovedNumber> furthest;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Term& term = terms[i];
    if (!term.nuisance() || !term.effect) continue;
    const double deviation = fit.deviation[static_cast<Eigen::Index>(i)] * term.scale();
    if (!(deviation < kDetermined * term.tolerance)) continue;
    ++determined;
    const double away = std::abs(theta[i] - term.healthy_mean) / term.tolerance;
    if (!furthest || away > furthest->tolerances) furthest = MovedNumber{i, away, 1.0};
  }
  if (furthest) furthest->chance = ChanceOfOne(furthest->tolerances, determined);
  return furthest;
}

void SuspectCause(SearchState& state) {
  if (!state.causes.empty()) return;
  if (!SuspectLeader(state)) SuspectNumber(state);
}

}  // namespace levitas::diagnosis
