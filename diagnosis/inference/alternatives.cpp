#include "diagnosis/inference/alternatives.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {

namespace {

/// Of all sets that were fitted those near the best one, itself left out.
void KeepContenders(SearchState& state, CauseSet leader, double best, double lead) {
  const Judging& judging = state.settings.judging;
  const double near = std::max(judging.decisive_nat, judging.form_share * lead);
  state.contenders.push_back(std::move(leader));
  std::erase_if(state.contenders, [&](const CauseSet& set) {
    return !(set.fit.evidence > best - near) || set.fit.evidence == best;
  });
}

}  // namespace

void RankCandidates(SearchState& state) {
  state.ReportProgress(0.75, "ranking");
  double strongest = -1.0;
  for (std::size_t i = 0; i < state.causes.size(); ++i) {
    const double gain = state.GainOf(i);
    if (gain <= strongest) continue;
    strongest = gain;
    std::swap(state.causes[0], state.causes[i]);
  }
  const Evidence others(state.view.problem, state.terms, Without(state.causes, 0));
  state.candidates = Screen(others, state.search.hypotheses());
  if (state.causes.empty() || state.effort.first_cause_only) {
    // Evidence predicted by the screen that the nonlinear model did not confirm.
    for (Candidate& c : state.candidates) {
      for (const Candidate& known : state.refitted) {
        if (known.effect == c.effect) c = known;
      }
    }
    SortByScore(state.candidates);
    return;
  }
  // The leader is the hypothesis that was chosen, at the place that was chosen.
  const Hypothesis& first = state.causes[0];
  for (Candidate& c : state.candidates) {
    if (c.effect != first.effect) continue;
    for (std::size_t i = 0; i < state.search.hypotheses().size(); ++i) {
      const Hypothesis& h = state.search.hypotheses()[i];
      if (h.effect == c.effect && h.place == first.place) c.hypothesis = i;
    }
    c.place = first.place;
    c.score = others.Gain(first);
  }
  SortByScore(state.candidates);
}

void RefitAlternatives(SearchState& state) {
  if (state.causes.empty()) return;
  const Refined leader = state.refiner.Fit(state.causes, state.theta, state.view, 1);
  state.leader_evidence = leader.ok ? leader.evidence : std::numeric_limits<double>::infinity();
  if (!leader.ok) return;
  state.theta = leader.theta;
  const auto own =
      std::find_if(state.candidates.begin(), state.candidates.end(),
                   [&state](const auto& c) { return c.effect == state.causes[0].effect; });
  if (own == state.candidates.end()) return;
  const double lead = own->score;
  own->refitted = true;
  const double near =
      std::max(2.0 * state.settings.judging.near_nat, state.settings.judging.form_share * lead);
  state.contenders.clear();
  CauseSet best{state.causes, leader};
  std::size_t tried = 0;
  for (Candidate& candidate : state.candidates) {
    if (tried == state.effort.alternatives ||
        candidate.score < std::max(state.settings.judging.decisive_nat, lead - near))
      break;
    if (candidate.refitted) continue;
    ++tried;
    state.ReportProgress(0.78 + 0.03 * static_cast<double>(tried), "refitting " + candidate.effect);
    std::vector<Hypothesis> causes = state.causes;
    causes[0] = state.search.hypotheses()[candidate.hypothesis];
    Refined fit = state.Refit(causes, best.fit.evidence - state.settings.judging.decisive_nat);
    if (!fit.ok) continue;
    candidate.score = lead + fit.evidence - leader.evidence;
    candidate.refitted = true;
    state.contenders.push_back({causes, fit});
    best.Take(causes, std::move(fit));
  }
  KeepContenders(state, {state.causes, leader}, best.fit.evidence, lead);
  state.causes = std::move(best.causes);
  state.theta = best.fit.theta;
  state.leader_evidence = best.fit.evidence;
  SortByScore(state.candidates);
}

bool LeaderFails(SearchState& state) {
  if (state.causes.empty()) return false;
  const std::vector<Hypothesis> rest = Without(state.causes, 0);
  const Refined fit = state.refiner.Fit(
      rest, rest.empty() ? state.calibrated : state.search.Solve(state.view.problem, rest),
      state.view, state.effort.passes, state.leader_evidence - state.settings.judging.decisive_nat);
  if (!fit.ok || state.leader_evidence - fit.evidence >= state.settings.judging.decisive_nat)
    return false;
  state.causes = rest;
  state.theta = fit.theta;
  state.LineariseAll();
  return true;
}

}  // namespace levitas::diagnosis
