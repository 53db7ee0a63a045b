#include "diagnosis/inference/selection.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnosis/inference/mode_probe.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/refine_shape.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Least gain of a further cause, given the evidence explained already.
double Enough(const Judging& judging, double explained_nat) {
  return judging.decisive_nat + judging.form_share * std::max(0.0, explained_nat);
}

/// `fit` of all causes becomes that with the best member of the last one's family.
void SharpenLast(SearchState& state, Refined& fit) {
  Hypothesis& last = state.causes.back();
  if (!HasFamily(last, state.terms)) return;
  state.ReportProgress(0.5, "sharpening " + last.effect);
  fit = RefineShape(state.refiner, last, state.causes, state.view, state.effort.passes,
                    std::move(fit), state.terms);
  state.theta = fit.theta;
  state.TakePlace(last);
}

void DropSuperfluous(SearchState& state, const LinearProblem& problem) {
  for (std::size_t i = 0; i + 1 < state.causes.size();) {
    const std::vector<Hypothesis> rest = Without(state.causes, i);
    if (Evidence(problem, state.terms, rest).Gain(state.causes[i]) <
        state.settings.judging.decisive_nat) {
      state.causes = rest;
      state.theta = state.search.Solve(problem, state.causes);
    } else {
      ++i;
    }
  }
}

/// The best few of the screen on the nonlinear model; the best of those.
CauseSet BestOfScreen(SearchState& state, const std::vector<Candidate>& screened, double null,
                      double enough, double share) {
  // Of the strongest causes the screen errs by a share of their gain rather than by an amount.
  constexpr double kScreenErrs = 0.3;
  const double from = std::min(screened.front().score - state.settings.judging.near_nat,
                               kScreenErrs * screened.front().score);
  CauseSet best;
  state.refitted.clear();
  for (std::size_t i = 0; i < std::min(screened.size(), state.effort.shortlist); ++i) {
    if (i > 0 && screened[i].score < std::max(from, enough)) break;
    state.ReportProgress(share + 0.02 * static_cast<double>(i), "refitting " + screened[i].effect);
    std::vector<Hypothesis> causes = state.causes;
    causes.push_back(state.search.hypotheses()[screened[i].hypothesis]);
    Refined fit = state.Refit(causes, best.fit.ok ? best.fit.evidence : null + enough);
    Candidate& tried = state.refitted.emplace_back(screened[i]);
    tried.refitted = true;
    if (fit.ok) tried.score = std::min(tried.score, fit.evidence - null);
    best.Take(causes, std::move(fit));
  }
  return best;
}

/// Modes that may lie where the screen does not look.
void TryProbes(SearchState& state, const std::vector<ModeProbe>& probes, double null,
               CauseSet& best) {
  for (const ModeProbe& probe : probes) {
    state.ReportProgress(0.3, "looking for a mode elsewhere");
    const Hypothesis& mode = state.search.hypotheses()[probe.hypothesis];
    std::vector<Hypothesis> causes = state.causes;
    causes.push_back(mode);
    std::vector<double> start = state.theta;
    start[probe.term] = probe.theta;
    Refined fit = state.refiner.Fit(causes, std::move(start), state.view, state.effort.passes);
    if (!fit.ok) continue;
    state.refitted.push_back(
        {mode.effect, mode.place, fit.evidence - null, probe.hypothesis, true});
    best.Take(causes, std::move(fit));
  }
}

bool AddCause(SearchState& state, double share) {
  const Evidence base(state.view.problem, state.terms, state.causes);
  const std::vector<Candidate> screened = Screen(base, state.search.hypotheses());
  if (screened.empty()) return false;
  const std::vector<ModeProbe> probes =
      state.effort.first_cause_only
          ? std::vector<ModeProbe>{}
          : ProbeModes(state.rig, state.terms, state.search.hypotheses(), *state.view.runs);
  if (!(screened.front().score > state.settings.judging.decisive_nat) && probes.empty())
    return false;
  const Refined before = state.refiner.Fit(state.causes, state.theta, state.view, 2);
  const double null = before.ok
                          ? before.evidence
                          : Refiner::EvidenceOfSet(state.view.problem, state.terms, state.causes);
  const double enough = Enough(state.settings.judging,
                               null - Refiner::EvidenceOfSet(state.view.problem, state.terms, {}));
  if (!(screened.front().score > enough) && probes.empty()) return false;
  CauseSet best = BestOfScreen(state, screened, null, enough, share);
  TryProbes(state, probes, null, best);
  // The nonlinear model must confirm the gain of the linear screen. A large step may need more
  // passes than were spent on it: what is far beyond doubt is taken and linearised anew.
  if (!best.fit.ok || !(best.fit.evidence - null > enough)) {
    if (!(screened.front().score > state.settings.judging.far_beyond * enough)) return false;
    state.causes.push_back(state.search.hypotheses()[screened.front().hypothesis]);
    state.theta = state.search.Solve(state.view.problem, state.causes);
    if (state.effort.first_cause_only || !HasFamily(state.causes.back(), state.terms)) return true;
    Refined fit = state.refiner.Fit(state.causes, state.theta, state.view, state.effort.passes);
    if (fit.ok) SharpenLast(state, fit);
    return true;
  }
  state.theta = best.fit.theta;
  state.causes = std::move(best.causes);
  if (!state.effort.first_cause_only) SharpenLast(state, best.fit);
  DropSuperfluous(state, best.fit.problem);
  return true;
}

/// Which hypotheses of the search the causes are.
std::set<std::size_t> Indices(const SearchState& state, const std::vector<Hypothesis>& causes) {
  std::set<std::size_t> indices;
  const auto& all = state.search.hypotheses();
  for (const Hypothesis& cause : causes) {
    const auto same = std::find_if(all.begin(), all.end(), [&cause](const Hypothesis& h) {
      return h.effect == cause.effect && h.place == cause.place && h.terms == cause.terms;
    });
    indices.insert(static_cast<std::size_t>(same - all.begin()));
  }
  return indices;
}

/// The best effect that, together with `others`, explains as much as all causes.
void TryBeside(SearchState& state, const std::vector<Hypothesis>& others, double worth,
               std::set<std::set<std::size_t>>& tried, CauseSet& best) {
  const auto screened =
      Screen(Evidence(state.view.problem, state.terms, others), state.search.hypotheses());
  const std::set<std::size_t> rest = Indices(state, others);
  for (std::size_t n = 0; n < std::min(screened.size(), state.effort.shortlist); ++n) {
    std::set<std::size_t> set = rest;
    set.insert(screened[n].hypothesis);
    if (!tried.insert(set).second) continue;
    state.ReportProgress(0.7, "refitting " + screened[n].effect);
    std::vector<Hypothesis> causes{state.search.hypotheses()[screened[n].hypothesis]};
    causes.insert(causes.end(), others.begin(), others.end());
    best.Take(causes, state.Refit(causes, worth));
  }
}

bool MergeOnce(SearchState& state) {
  const Refined whole = state.refiner.Fit(state.causes, state.theta, state.view, 2);
  if (!whole.ok) return false;
  const double explained =
      whole.evidence - Refiner::EvidenceOfSet(state.view.problem, state.terms, {});
  const double worth = whole.evidence - Enough(state.settings.judging, explained);
  CauseSet best;
  std::set<std::set<std::size_t>> tried;
  // One for all first, then one for any two.
  if (state.causes.size() > 2) TryBeside(state, {}, worth, tried, best);
  for (std::size_t i = 0; i < state.causes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (best.causes.size() == 1 && best.fit.evidence >= worth) break;
      TryBeside(state, Without(Without(state.causes, i), k), worth, tried, best);
    }
  }
  if (!best.fit.ok || best.fit.evidence < worth) return false;
  state.theta = best.fit.theta;
  state.causes = std::move(best.causes);
  state.LineariseAll();
  return true;
}

/// Back to slower observers, which see more, as far as the model with the causes found so far does
/// not lose the rotor under them.
void SlowDown(SearchState& state) {
  while (state.speed > state.slowest) {
    const std::size_t fast = state.speed;
    state.Observe(fast - 1);
    Refined fit;
    if (!ModelDiverges(state.rig, state.search.Run(state.records, state.gains, state.theta))) {
      state.LineariseAll();
      if (!SensitivitiesDiverge(state.view.sum))
        fit = state.refiner.Fit(state.causes, state.theta, state.view, state.effort.passes);
    }
    if (!fit.ok) {
      state.Observe(fast);
      return;
    }
    state.theta = fit.theta;
    if (!state.effort.first_cause_only) SharpenLast(state, fit);
    state.calibrated_runs = std::make_shared<const std::vector<Trajectory>>(
        state.search.Run(state.records, state.gains, state.calibrated));
  }
}

/// Once more without any cause and with a faster observer, which holds the model where a wrong
/// cause leads it astray.
void StartAgain(SearchState& state) {
  state.causes.clear();
  state.theta = state.calibrated;
  state.slowest = state.speed + 1;
  state.Observe(state.slowest);
  state.LineariseAll();
}

}  // namespace

void FindCauses(SearchState& state) {
  for (std::size_t stage = 0;; ++stage) {
    const double share = 0.2 + 0.2 * static_cast<double>(stage);
    if (stage > 0) SlowDown(state);
    state.ReportProgress(share, "screening all causes");
    state.LineariseAll();
    while (SensitivitiesDiverge(state.view.sum) && state.speed + 1 < kSpeeds.size())
      StartAgain(state);
    if (state.causes.empty()) state.calibrated_runs = state.view.runs;
    if (state.causes.size() >= state.settings.most_causes || !AddCause(state, share)) return;
    if (state.effort.first_cause_only) return;
  }
}

void MergeCauses(SearchState& state) {
  for (std::size_t tried = 0; state.causes.size() > 1 && tried < state.settings.most_causes;
       ++tried) {
    if (!MergeOnce(state)) return;
  }
}

void DropUnproven(SearchState& state) {
  while (!state.causes.empty()) {
    std::size_t weakest = 0;
    double least = state.GainOf(0);
    for (std::size_t i = 1; i < state.causes.size(); ++i) {
      const double gain = state.GainOf(i);
      if (gain >= least) continue;
      least = gain;
      weakest = i;
    }
    if (least >= state.settings.judging.decisive_nat) return;
    state.causes = Without(state.causes, weakest);
    state.theta = state.causes.empty() ? state.calibrated
                                       : state.search.Solve(state.view.problem, state.causes);
  }
}

}  // namespace levitas::diagnosis
