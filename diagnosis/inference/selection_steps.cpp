#include "diagnosis/inference/selection_steps.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/inference/suspicion.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kShareAtTheEnd = 0.88;  ///< of the whole diagnosis

/// Least gain of a further cause, given the evidence explained already.
double Enough(const Judging& judging, double explained_nat) {
  return judging.decisive_nat + judging.form_share * std::max(0.0, explained_nat);
}

void DropSuperfluous(const EvidenceLandscape& landscape, const SelectionRules& rules,
                     const Refined& fit, CauseSelection& found) {
  for (std::size_t i = 0; i + 1 < found.causes.size();) {
    const std::vector<Hypothesis> rest = Without(found.causes, i);
    if (landscape.GainAt(fit, found.causes[i], rest) < rules.judging.decisive_nat) {
      found.causes = rest;
      found.point = landscape.SolutionAt(fit, found.causes);
    } else {
      ++i;
    }
  }
}

/// Evidence without a further cause, and the least gain of one.
struct Bar {
  double null{}, enough{};
};

/// The best few of the screen on the nonlinear model; the best of those.
CauseSet BestOfScreen(const EvidenceLandscape& landscape, const SelectionRules& rules,
                      const std::vector<Candidate>& screened, const Bar& bar, double share,
                      CauseSelection& found) {
  // Of the strongest causes the screen errs by a share of their gain rather than by an amount.
  constexpr double kScreenErrs = 0.3;
  const double from = std::min(screened.front().score - rules.judging.near_nat,
                               kScreenErrs * screened.front().score);
  CauseSet best;
  found.refitted.clear();
  for (std::size_t i = 0; i < std::min(screened.size(), rules.effort.shortlist); ++i) {
    if (i > 0 && rules.screen_decides && screened[i].score < std::max(from, bar.enough)) break;
    if (landscape.StopAsked()) break;
    landscape.ReportProgress(share + 0.02 * static_cast<double>(i),
                             fmt::format("refitting {}", effect::At(screened[i].effect).name));
    std::vector<Hypothesis> causes = found.causes;
    causes.push_back(landscape.hypotheses()[screened[i].hypothesis]);
    Refined fit = landscape.Refit(causes, best.fit.ok ? best.fit.evidence : bar.null + bar.enough);
    Candidate& tried = found.refitted.emplace_back(screened[i]);
    tried.refitted = true;
    if (fit.ok) {
      const double gain = fit.evidence - bar.null;
      tried.score = rules.screen_decides ? std::min(tried.score, gain) : gain;
    }
    best.Take(causes, std::move(fit));
  }
  return best;
}

/// Modes that may lie where the screen does not look.
void TryProbes(const EvidenceLandscape& landscape, const SelectionRules& rules,
               const std::vector<ModeProbe>& probes, double null, CauseSelection& found,
               CauseSet& best) {
  for (const ModeProbe& probe : probes) {
    if (landscape.StopAsked()) return;
    landscape.ReportProgress(0.3, "looking for a mode elsewhere");
    const Hypothesis& mode = landscape.hypotheses()[probe.hypothesis];
    std::vector<Hypothesis> causes = found.causes;
    causes.push_back(mode);
    Point start = found.point;
    start.theta[probe.term] = probe.theta;
    Refined fit = landscape.Fit(causes, start, rules.effort.passes);
    if (!fit.ok) continue;
    found.refitted.push_back(
        {mode.effect, mode.place, fit.evidence - null, probe.hypothesis, true});
    best.Take(causes, std::move(fit));
  }
}

/// A cause that is far beyond doubt though its fit has not confirmed it yet: a large step may need
/// more passes than were spent on it. It is taken, and linearised anew.
void TakeUnconfirmed(const EvidenceLandscape& landscape, const SelectionRules& rules,
                     std::size_t hypothesis, CauseSelection& found) {
  found.causes.push_back(landscape.hypotheses()[hypothesis]);
  found.point = landscape.SolutionOf(found.causes);
  if (rules.effort.first_cause_only || !landscape.HasShape(found.causes.back())) return;
  Refined fit = landscape.Fit(found.causes, found.point, rules.effort.passes);
  if (fit.ok) RefineLastShape(landscape, fit, found);
}

/// Which hypotheses of the landscape the causes are.
std::set<std::size_t> Indices(const EvidenceLandscape& landscape,
                              const std::vector<Hypothesis>& causes) {
  std::set<std::size_t> indices;
  for (const Hypothesis& cause : causes) indices.insert(IndexOf(landscape.hypotheses(), cause));
  return indices;
}

/// Sets in place of several causes: the best one so far, and what was tried.
struct Merger {
  CauseSet best;
  std::set<std::set<std::size_t>> tried;
};

/// The best effect that, together with `others`, explains as much as all causes.
void TryEffectWith(const EvidenceLandscape& landscape, const SelectionRules& rules,
                   const std::vector<Hypothesis>& others, double worth, Merger& merger) {
  const auto screened = landscape.Screen(others);
  const std::set<std::size_t> rest = Indices(landscape, others);
  for (std::size_t n = 0; n < std::min(screened.size(), rules.effort.shortlist); ++n) {
    std::set<std::size_t> set = rest;
    set.insert(screened[n].hypothesis);
    if (!merger.tried.insert(set).second || landscape.StopAsked()) continue;
    landscape.ReportProgress(0.7, fmt::format("refitting {}", effect::At(screened[n].effect).name));
    std::vector<Hypothesis> causes{landscape.hypotheses()[screened[n].hypothesis]};
    causes.insert(causes.end(), others.begin(), others.end());
    merger.best.Take(causes, landscape.Refit(causes, worth));
  }
}

bool MergeOnce(EvidenceLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  const Refined whole = landscape.Fit(found.causes, found.point, 2);
  if (!whole.ok) return false;
  const double explained = whole.evidence - landscape.EvidenceOf(OfExactForm(found.causes));
  const double worth = whole.evidence - Enough(rules.judging, explained);
  Merger merger;
  CauseSet& best = merger.best;
  // One for all first, then one for any two.
  if (found.causes.size() > 2) TryEffectWith(landscape, rules, {}, worth, merger);
  for (std::size_t i = 0; i < found.causes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (best.causes.size() == 1 && best.fit.evidence >= worth) break;
      TryEffectWith(landscape, rules, Without(Without(found.causes, i), k), worth, merger);
    }
  }
  if (!best.fit.ok || best.fit.evidence < worth) return false;
  found.point = best.fit.point;
  found.causes = std::move(best.causes);
  landscape.LineariseAt(found.point);
  return true;
}

}  // namespace

void RefineLastShape(const EvidenceLandscape& landscape, Refined& fit, CauseSelection& found) {
  const Hypothesis& last = found.causes.back();
  if (!landscape.HasShape(last)) return;
  landscape.ReportProgress(0.5,
                           fmt::format("finding the form of {}", effect::At(last.effect).name));
  fit = landscape.RefineShapeOf(found.causes, found.causes.size() - 1, std::move(fit));
  found.point = fit.point;
}

bool AddCause(const EvidenceLandscape& landscape, const SelectionRules& rules, double share,
              CauseSelection& found) {
  const std::vector<Candidate> screened = landscape.Screen(found.causes);
  if (screened.empty()) return false;
  const std::vector<ModeProbe> probes =
      rules.effort.first_cause_only ? std::vector<ModeProbe>{} : landscape.Probes();
  const double first = screened.front().score;
  const bool goes_on = !rules.screen_decides || !probes.empty();
  if (!(first > rules.judging.decisive_nat) && !goes_on) return false;
  const Refined before = landscape.Fit(found.causes, found.point, 2);
  Bar bar;
  bar.null = before.ok ? before.evidence : landscape.EvidenceOf(found.causes);
  bar.enough = Enough(rules.judging, bar.null - landscape.EvidenceOf(OfExactForm(found.causes)));
  if (!(first > bar.enough) && !goes_on) return false;
  CauseSet best = BestOfScreen(landscape, rules, screened, bar, share, found);
  TryProbes(landscape, rules, probes, bar.null, found, best);
  // The nonlinear model must confirm the gain of the linear screen.
  if (!best.fit.ok || !(best.fit.evidence - bar.null > bar.enough)) {
    if (!(first > rules.judging.far_beyond * bar.enough) || landscape.StopAsked()) return false;
    TakeUnconfirmed(landscape, rules, screened.front().hypothesis, found);
    return true;
  }
  found.point = best.fit.point;
  found.causes = std::move(best.causes);
  if (!rules.effort.first_cause_only) RefineLastShape(landscape, best.fit, found);
  DropSuperfluous(landscape, rules, best.fit, found);
  return true;
}

void MergeCauses(EvidenceLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  for (std::size_t tried = 0; found.causes.size() > 1 && tried < rules.most_causes; ++tried) {
    if (landscape.StopAsked() || !MergeOnce(landscape, rules, found)) return;
  }
}

void DropUnproven(const EvidenceLandscape& landscape, const SelectionRules& rules,
                  CauseSelection& found) {
  while (!found.causes.empty()) {
    std::size_t weakest = 0;
    double least = landscape.GainOf(found.causes[0], Without(found.causes, 0));
    for (std::size_t i = 1; i < found.causes.size(); ++i) {
      const double gain = landscape.GainOf(found.causes[i], Without(found.causes, i));
      if (gain >= least) continue;
      least = gain;
      weakest = i;
    }
    if (least >= rules.judging.decisive_nat) return;
    found.causes = Without(found.causes, weakest);
    found.refitted.clear();  // what they gain beyond a set that is no longer believed
    found.point = found.causes.empty() ? found.WithoutCauses() : landscape.SolutionOf(found.causes);
  }
}

void DoubtCutOffChain(const EvidenceLandscape& landscape, const SelectionRules& rules,
                      CauseSelection& found) {
  if (found.doubt != Doubt::kNothing || found.causes.size() < 2 ||
      found.causes.size() < rules.most_causes)
    return;
  // What an inexact law leaves does not excuse a full chain: any decisive gain counts.
  SelectionRules strict = rules;
  strict.judging.form_share = 0.0;
  CauseSelection more = found;
  if (!AddCause(landscape, strict, kShareAtTheEnd, more) ||
      more.causes.size() <= found.causes.size())
    return;
  found.doubt = Doubt::kCutOff;
  found.probability = ProbabilityOfLeader(found.candidates, rules.judging.decisive_nat);
}

}  // namespace levitas::diagnosis
