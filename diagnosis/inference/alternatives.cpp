#include "diagnosis/inference/alternatives.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {

namespace {

void PutStrongestFirst(const EvidenceLandscape& landscape, CauseSelection& found) {
  double strongest = -1.0;
  for (std::size_t i = 0; i < found.causes.size(); ++i) {
    const double gain = landscape.GainOf(found.causes[i], Without(found.causes, i));
    if (gain <= strongest) continue;
    strongest = gain;
    std::swap(found.causes[0], found.causes[i]);
  }
}

/// Evidence predicted by the screen that the nonlinear model did not confirm.
void TakeRefitted(CauseSelection& found) {
  for (Candidate& c : found.candidates) {
    for (const Candidate& known : found.refitted) {
      if (known.effect == c.effect) c = known;
    }
  }
}

/// Of all sets that were fitted those near the best one, itself left out.
void KeepContenders(const Judging& judging, CauseSet leader, double best, double lead,
                    std::vector<CauseSet>& contenders) {
  const double near = std::max(judging.decisive_nat, judging.form_share * lead);
  contenders.push_back(std::move(leader));
  std::erase_if(contenders, [&](const CauseSet& set) {
    return !(set.fit.evidence > best - near) || set.fit.evidence == best;
  });
}

/// Causes with each near candidate in place of the first; the candidates get their scores of the
/// nonlinear model. `lead` is the leader's own.
CauseSet BestAlternative(const EvidenceLandscape& landscape, const SelectionRules& rules,
                         const CauseSet& leader, double lead, CauseSelection& found) {
  const Judging& judging = rules.judging;
  const double near = std::max(2.0 * judging.near_nat, judging.form_share * lead);
  CauseSet best = leader;
  std::size_t tried = 0;
  for (Candidate& candidate : found.candidates) {
    if (tried == rules.effort.alternatives ||
        candidate.score < std::max(judging.decisive_nat, lead - near))
      break;
    if (candidate.refitted) continue;
    ++tried;
    landscape.ReportProgress(0.78 + 0.03 * static_cast<double>(tried),
                             fmt::format("refitting {}", effect::At(candidate.effect).name));
    std::vector<Hypothesis> causes = leader.causes;
    causes[0] = landscape.hypotheses()[candidate.hypothesis];
    Refined fit = landscape.Refit(causes, best.fit.evidence - judging.decisive_nat);
    if (!fit.ok) continue;
    candidate.score = lead + fit.evidence - leader.fit.evidence;
    candidate.refitted = true;
    found.contenders.push_back({causes, fit});
    best.Take(causes, std::move(fit));
  }
  return best;
}

}  // namespace

void RankCandidates(const EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found) {
  landscape.ReportProgress(0.75, "ranking");
  PutStrongestFirst(landscape, found);
  const std::vector<Hypothesis> others = Without(found.causes, 0);
  found.candidates = landscape.Screen(others);
  if (found.causes.empty() || (rules.effort.first_cause_only && !found.whitened_anew)) {
    TakeRefitted(found);
    SortByScore(found.candidates);
    return;
  }
  // The leader is the hypothesis that was chosen, at the place that was chosen.
  const Hypothesis& first = found.causes[0];
  for (Candidate& c : found.candidates) {
    if (c.effect != first.effect) continue;
    for (std::size_t i = 0; i < landscape.hypotheses().size(); ++i) {
      const Hypothesis& h = landscape.hypotheses()[i];
      if (h.effect == c.effect && h.place == first.place) c.hypothesis = i;
    }
    c.place = landscape.PlaceAt(found.point, first);
    c.score = landscape.GainOf(first, others);
  }
  SortByScore(found.candidates);
}

void RefitAlternatives(const EvidenceLandscape& landscape, const SelectionRules& rules,
                       CauseSelection& found) {
  if (found.causes.empty()) return;
  const CauseSet leader{found.causes, landscape.Fit(found.causes, found.point, 1)};
  found.leader_evidence =
      leader.fit.ok ? leader.fit.evidence : std::numeric_limits<double>::infinity();
  if (!leader.fit.ok) return;
  found.point = leader.fit.point;
  const auto own =
      std::find_if(found.candidates.begin(), found.candidates.end(),
                   [&found](const auto& c) { return c.effect == found.causes[0].effect; });
  if (own == found.candidates.end()) return;
  const double lead = own->score;
  own->refitted = true;
  found.contenders.clear();
  CauseSet best = BestAlternative(landscape, rules, leader, lead, found);
  KeepContenders(rules.judging, leader, best.fit.evidence, lead, found.contenders);
  found.causes = std::move(best.causes);
  found.point = best.fit.point;
  found.leader_evidence = best.fit.evidence;
  SortByScore(found.candidates);
}

bool DropFailedLeader(EvidenceLandscape& landscape, const SelectionRules& rules,
                      CauseSelection& found) {
  if (found.causes.empty()) return false;
  const double decisive_nat = rules.judging.decisive_nat;
  const std::vector<Hypothesis> rest = Without(found.causes, 0);
  const Refined fit =
      landscape.Fit(rest, rest.empty() ? found.WithoutCauses() : landscape.SolutionOf(rest),
                    rules.effort.passes, found.leader_evidence - decisive_nat);
  if (!fit.ok || found.leader_evidence - fit.evidence >= decisive_nat) return false;
  found.causes = rest;
  found.point = fit.point;
  landscape.LineariseAt(found.point);
  return true;
}

}  // namespace levitas::diagnosis
