#include "diagnosis/inference/first_cause.hpp"

#include <algorithm>
#include <utility>

#include "diagnosis/inference/selection_steps.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kOtherFirsts = 3;
constexpr double kSmallShare = 0.1;  ///< of the evidence of the first cause

/// Whether every further one gains little beside the first, in the order of selection.
bool HasSmallOnesBehind(const EvidenceLandscape& landscape, const std::vector<Hypothesis>& causes) {
  if (causes.size() < 2) return false;
  std::vector<Hypothesis> set{causes.front()};
  double explained = landscape.EvidenceOf(set);
  const double small = kSmallShare * (explained - landscape.EvidenceOf({}));
  for (std::size_t i = 1; i < causes.size(); ++i) {
    set.push_back(causes[i]);
    const double with = landscape.EvidenceOf(set);
    if (with - explained >= small) return false;
    explained = with;
  }
  return true;
}

/// The last cause at each other place of its effect, which the screen has left out: the best stays.
void TryOtherPlaces(const EvidenceLandscape& landscape, const SelectionRules& rules,
                    CauseSelection& found) {
  const Hypothesis last = found.causes.back();
  CauseSet best{found.causes, landscape.Fit(found.causes, found.point, rules.effort.passes)};
  for (const Hypothesis& other : landscape.hypotheses()) {
    if (other.effect != last.effect || AreSame(other, last)) continue;
    std::vector<Hypothesis> causes = found.causes;
    causes.back() = other;
    best.Take(causes, landscape.Refit(causes, best.fit.evidence));
  }
  if (!best.fit.ok) return;
  found.causes = std::move(best.causes);
  found.point = std::move(best.fit.point);
}

}  // namespace

void AddCauses(EvidenceLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  while (found.causes.size() < rules.most_causes) {
    const double share = 0.1 + 0.06 * static_cast<double>(found.causes.size());
    landscape.LineariseAt(found.point);
    if (!AddCause(landscape, rules, std::min(share, 0.6), found)) return;
    TryOtherPlaces(landscape, rules, found);
  }
}

void ReconsiderFirstCause(EvidenceLandscape& landscape, const SelectionRules& rules,
                          CauseSelection& found) {
  landscape.LineariseAt(found.point);
  if (!HasSmallOnesBehind(landscape, found.causes)) return;
  CauseSet best{found.causes, landscape.Fit(found.causes, found.point, rules.effort.passes)};
  std::vector<Candidate> near = landscape.Screen({});
  std::erase_if(near, [&](const Candidate& c) { return c.effect == found.causes.front().effect; });
  near.resize(std::min(near.size(), kOtherFirsts));
  for (const Candidate& first : near) {
    CauseSelection other = found;
    other.causes = {landscape.hypotheses()[first.hypothesis]};
    landscape.LineariseAt(found.WithoutCauses());
    other.point = landscape.SolutionOf(other.causes);
    AddCauses(landscape, rules, other);
    best.Take(other.causes, landscape.Fit(other.causes, other.point, rules.effort.passes));
  }
  if (best.fit.ok) {
    found.causes = std::move(best.causes);
    found.point = std::move(best.fit.point);
  }
  landscape.LineariseAt(found.point);
}

}  // namespace levitas::diagnosis
