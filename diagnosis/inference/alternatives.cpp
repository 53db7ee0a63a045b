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
    const bool is_near =
        tried < rules.effort.alternatives &&
        (!rules.screen_decides || candidate.score >= std::max(judging.decisive_nat, lead - near));
    const bool is_alike = rules.alike && candidate.score >= 0.0 &&
                          rules.alike(leader.causes.front().effect, candidate.effect);
    if (candidate.refitted || !(is_near || is_alike)) continue;
    if (is_near) ++tried;
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

/// Every effect in the place of the first cause, on the linearisation.
void ScreenInPlaceOfFirst(const EvidenceLandscape& landscape, CauseSelection& found) {
  const std::vector<Hypothesis> others = Without(found.causes, 0);
  found.candidates = landscape.Screen(others);
  // The leader is the hypothesis that was chosen, at the place that was chosen; where no straight
  // line leads to it, the screen does not have it.
  const Hypothesis& first = found.causes[0];
  std::erase_if(found.candidates,
                [&first](const Candidate& c) { return c.effect == first.effect; });
  found.candidates.push_back({first.effect, landscape.PlaceAt(found.point, first),
                              landscape.GainOf(first, others),
                              IndexOf(landscape.hypotheses(), first), false});
  SortByScore(found.candidates);
}

/// The weightiest first, each by what it adds to all others.
void SortByGain(const EvidenceLandscape& landscape, CauseSelection& found) {
  std::vector<std::pair<double, Hypothesis>> weighed;
  for (std::size_t i = 0; i < found.causes.size(); ++i) {
    weighed.emplace_back(landscape.GainOf(found.causes[i], Without(found.causes, i)),
                         found.causes[i]);
  }
  std::stable_sort(weighed.begin(), weighed.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  found.causes.clear();
  for (auto& [gain, cause] : weighed) found.causes.push_back(std::move(cause));
}

}  // namespace

void RankCandidates(const EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found) {
  landscape.ReportProgress(0.75, "ranking");
  PutStrongestFirst(landscape, found);
  if (found.causes.empty() || (rules.effort.first_cause_only && !found.whitened_anew)) {
    found.candidates = landscape.Screen(Without(found.causes, 0));
    TakeRefitted(found);
    SortByScore(found.candidates);
    return;
  }
  ScreenInPlaceOfFirst(landscape, found);
}

std::vector<std::vector<Candidate>> RankInPlaceOfEach(EvidenceLandscape& landscape,
                                                      const SelectionRules& rules,
                                                      CauseSelection& found) {
  if (found.causes.empty()) {
    RankCandidates(landscape, rules, found);
    return {found.candidates};
  }
  std::vector<std::vector<Candidate>> in_place;
  landscape.LineariseAt(found.point);
  SortByGain(landscape, found);
  for (std::size_t exchanged = 0; in_place.size() < found.causes.size();) {
    const std::size_t k = in_place.size();
    CauseSelection here = found;
    std::swap(here.causes[0], here.causes[k]);
    ScreenInPlaceOfFirst(landscape, here);
    RefitAlternatives(landscape, rules, here);
    const bool is_other = here.causes[0].effect != found.causes[k].effect;
    if (is_other && exchanged++ < found.causes.size()) {
      std::swap(here.causes[0], here.causes[k]);
      found.causes = here.causes;
      found.point = here.point;
      landscape.LineariseAt(found.point);
      SortByGain(landscape, found);
      in_place.clear();
      continue;
    }
    in_place.push_back(here.candidates);
  }
  found.candidates = in_place.front();
  return in_place;
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
