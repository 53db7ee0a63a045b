#include "diagnosis/inference/selection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/inference/mode_probe.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/sharpen.hpp"
#include "diagnosis/model/stray.hpp"

namespace levitas::diagnosis {
namespace {

/// The screen promises so many times what is enough that the refit's passes may just not have
/// sufficed.
constexpr double kFarBeyond = 3.0;

/// Least gain of a further cause, given the evidence explained already.
double Enough(double explained_nat) { return kDecisive + kForm * std::max(0.0, explained_nat); }

/// `fit` of all causes becomes that with the best member of the last one's family.
void SharpenLast(Inquiry& q, Refined& fit) {
  Hypothesis& last = q.causes.back();
  if (!HasFamily(last, q.terms)) return;
  q.Tell(0.5, "sharpening " + last.effect);
  fit = Sharpen(q.refiner, last, q.causes, q.view, q.effort.passes, std::move(fit), q.terms);
  q.theta = fit.theta;
  q.TakePlace(last);
}

void DropSuperfluous(Inquiry& q, const LinearProblem& problem) {
  for (std::size_t i = 0; i + 1 < q.causes.size();) {
    const std::vector<Hypothesis> rest = Without(q.causes, i);
    if (Evidence(problem, q.terms, rest).Gain(q.causes[i]) < kDecisive) {
      q.causes = rest;
      q.theta = q.search.Solve(problem, q.causes);
    } else {
      ++i;
    }
  }
}

/// The best few of the screen on the nonlinear model; the best of those.
CauseSet BestOfScreen(Inquiry& q, const std::vector<Candidate>& screened, double null,
                      double enough, double share) {
  const double from = std::min(screened.front().score - kNear, 0.3 * screened.front().score);
  CauseSet best;
  q.refitted.clear();
  for (std::size_t i = 0; i < std::min(screened.size(), q.effort.shortlist); ++i) {
    if (i > 0 && screened[i].score < std::max(from, enough)) break;
    q.Tell(share + 0.02 * static_cast<double>(i), "refitting " + screened[i].effect);
    std::vector<Hypothesis> causes = q.causes;
    causes.push_back(q.search.hypotheses()[screened[i].hypothesis]);
    Refined fit = q.Refit(causes, best.fit.ok ? best.fit.evidence : null + enough);
    Candidate& tried = q.refitted.emplace_back(screened[i]);
    tried.refitted = true;
    if (fit.ok) tried.score = std::min(tried.score, fit.evidence - null);
    best.Take(causes, std::move(fit));
  }
  return best;
}

/// Modes that may lie where the screen does not look.
void TryProbes(Inquiry& q, const std::vector<ModeProbe>& probes, double null, CauseSet& best) {
  for (const ModeProbe& probe : probes) {
    q.Tell(0.3, "looking for a mode elsewhere");
    const Hypothesis& mode = q.search.hypotheses()[probe.hypothesis];
    std::vector<Hypothesis> causes = q.causes;
    causes.push_back(mode);
    std::vector<double> start = q.theta;
    start[probe.term] = probe.theta;
    Refined fit = q.refiner.Fit(causes, std::move(start), q.view, q.effort.passes);
    if (!fit.ok) continue;
    q.refitted.push_back({mode.effect, mode.place, fit.evidence - null, probe.hypothesis, true});
    best.Take(causes, std::move(fit));
  }
}

bool AddCause(Inquiry& q, double share) {
  const Evidence base(q.view.problem, q.terms, q.causes);
  const std::vector<Candidate> screened = Screen(base, q.search.hypotheses());
  if (screened.empty()) return false;
  const std::vector<ModeProbe> probes =
      q.effort.first_cause_only ? std::vector<ModeProbe>{}
                                : ProbeModes(q.rig, q.terms, q.search.hypotheses(), q.view.runs);
  if (!(screened.front().score > kDecisive) && probes.empty()) return false;
  const Refined before = q.refiner.Fit(q.causes, q.theta, q.view, 2);
  const double null =
      before.ok ? before.evidence : Refiner::EvidenceOfSet(q.view.problem, q.terms, q.causes);
  const double enough = Enough(null - Refiner::EvidenceOfSet(q.view.problem, q.terms, {}));
  if (!(screened.front().score > enough) && probes.empty()) return false;
  CauseSet best = BestOfScreen(q, screened, null, enough, share);
  TryProbes(q, probes, null, best);
  // The nonlinear model must confirm the gain of the linear screen. A large step may need more
  // passes than were spent on it: what is far beyond doubt is taken and linearised anew.
  if (!best.fit.ok || !(best.fit.evidence - null > enough)) {
    if (!(screened.front().score > kFarBeyond * enough)) return false;
    q.causes.push_back(q.search.hypotheses()[screened.front().hypothesis]);
    q.theta = q.search.Solve(q.view.problem, q.causes);
    if (q.effort.first_cause_only || !HasFamily(q.causes.back(), q.terms)) return true;
    Refined fit = q.refiner.Fit(q.causes, q.theta, q.view, q.effort.passes);
    if (fit.ok) SharpenLast(q, fit);
    return true;
  }
  q.theta = best.fit.theta;
  q.causes = std::move(best.causes);
  if (!q.effort.first_cause_only) SharpenLast(q, best.fit);
  DropSuperfluous(q, best.fit.problem);
  return true;
}

/// The best effect that, together with `others`, explains as much as all causes.
void TryBeside(Inquiry& q, const std::vector<Hypothesis>& others, double worth, CauseSet& best) {
  const auto screened = Screen(Evidence(q.view.problem, q.terms, others), q.search.hypotheses());
  for (std::size_t n = 0; n < std::min(screened.size(), q.effort.shortlist); ++n) {
    q.Tell(0.7, "refitting " + screened[n].effect);
    std::vector<Hypothesis> causes{q.search.hypotheses()[screened[n].hypothesis]};
    causes.insert(causes.end(), others.begin(), others.end());
    best.Take(causes, q.Refit(causes, worth));
  }
}

bool MergeOnce(Inquiry& q) {
  const Refined whole = q.refiner.Fit(q.causes, q.theta, q.view, 2);
  if (!whole.ok) return false;
  const double explained = whole.evidence - Refiner::EvidenceOfSet(q.view.problem, q.terms, {});
  const double worth = whole.evidence - Enough(explained);
  CauseSet best;
  // One for all first, then one for any two.
  if (q.causes.size() > 2) TryBeside(q, {}, worth, best);
  for (std::size_t i = 0; i < q.causes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (best.causes.size() == 1 && best.fit.evidence >= worth) break;
      TryBeside(q, Without(Without(q.causes, i), k), worth, best);
    }
  }
  if (!best.fit.ok || best.fit.evidence < worth) return false;
  q.theta = best.fit.theta;
  q.causes = std::move(best.causes);
  q.LineariseAll();
  return true;
}

/// Back to slower observers, which see more, as far as the model with the causes found so far does
/// not lose the rotor under them.
void SlowDown(Inquiry& q) {
  while (q.speed > q.slowest) {
    const std::size_t fast = q.speed;
    q.Observe(fast - 1);
    Refined fit;
    if (!Strays(q.rig, q.search.Run(q.records, q.gains, q.theta))) {
      q.LineariseAll();
      if (!RunsAway(q.view.sum)) fit = q.refiner.Fit(q.causes, q.theta, q.view, q.effort.passes);
    }
    if (!fit.ok) {
      q.Observe(fast);
      return;
    }
    q.theta = fit.theta;
    if (!q.effort.first_cause_only) SharpenLast(q, fit);
    q.calibrated_runs = q.search.Run(q.records, q.gains, q.calibrated);
  }
}

/// Once more without any cause and with a faster observer, which holds the model where a wrong
/// cause leads it astray.
void StartAgain(Inquiry& q) {
  q.causes.clear();
  q.theta = q.calibrated;
  q.slowest = q.speed + 1;
  q.Observe(q.slowest);
  q.LineariseAll();
}

}  // namespace

void FindCauses(Inquiry& q) {
  for (std::size_t stage = 0;; ++stage) {
    const double share = 0.2 + 0.2 * static_cast<double>(stage);
    if (stage > 0) SlowDown(q);
    q.Tell(share, "screening all causes");
    q.LineariseAll();
    while (RunsAway(q.view.sum) && q.speed + 1 < kSpeeds.size()) StartAgain(q);
    if (q.causes.empty()) q.calibrated_runs = q.view.runs;
    if (q.causes.size() >= q.settings.most_causes || !AddCause(q, share)) return;
    if (q.effort.first_cause_only) return;
  }
}

void MergeCauses(Inquiry& q) {
  for (std::size_t tried = 0; q.causes.size() > 1 && tried < q.settings.most_causes; ++tried) {
    if (!MergeOnce(q)) return;
  }
}

void DropUnproven(Inquiry& q) {
  while (!q.causes.empty()) {
    std::size_t weakest = 0;
    double least = q.GainOf(0);
    for (std::size_t i = 1; i < q.causes.size(); ++i) {
      const double gain = q.GainOf(i);
      if (gain >= least) continue;
      least = gain;
      weakest = i;
    }
    if (least >= kDecisive) return;
    q.causes = Without(q.causes, weakest);
    q.theta = q.causes.empty() ? q.calibrated : q.search.Solve(q.view.problem, q.causes);
  }
}

}  // namespace levitas::diagnosis
