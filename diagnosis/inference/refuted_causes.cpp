#include "diagnosis/inference/refuted_causes.hpp"

#include <utility>

#include "diagnosis/inference/ranking.hpp"

namespace levitas::diagnosis {

void DropRefuted(EvidenceLandscape& landscape, const SelectionRules& rules,
                 const GainOnValidation& gain, std::size_t kept, CauseSelection& found) {
  while (found.causes.size() > kept) {
    const Refined whole = landscape.Fit(found.causes, found.point, rules.effort.passes);
    CauseSet rest;
    for (std::size_t i = 0; i < found.causes.size(); ++i) {
      const std::vector<Hypothesis> others = Without(found.causes, i);
      rest.Take(others, landscape.Refit(others));
    }
    if (!whole.ok || !rest.fit.ok || gain(whole, rest.fit).value >= 0.0) return;
    found.causes = std::move(rest.causes);
    found.refitted.clear();  // what they gain beyond a set that is no longer believed
    found.point = std::move(rest.fit.point);
    landscape.LineariseAt(found.point);
  }
}

}  // namespace levitas::diagnosis
