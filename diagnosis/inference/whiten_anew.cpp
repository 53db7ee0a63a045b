#include "diagnosis/inference/whiten_anew.hpp"

#include <utility>

#include "diagnosis/inference/coloured.hpp"

namespace levitas::diagnosis {

bool WhitenAnew(ObservedLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  constexpr double kSomething = 1.03;  // 30 nat of a thousand samples
  if (found.causes.empty()) return false;
  if (!TakesAway(landscape.view().whitener, landscape.PlainFilterOf(*found.calibrated_runs),
                 kSomething))
    return false;
  // First without any filter: the next one would hold what the former one left of the cause.
  landscape.ReportProgress(0.6, "whitening anew");
  landscape.LineariseUnfiltered(found.point);
  const Refined plain = landscape.Fit(found.causes, found.point, rules.effort.passes);
  if (plain.ok) found.point = plain.point;
  landscape.LineariseAt(found.point);
  Refined fit = landscape.Fit(found.causes, found.point, rules.effort.passes);
  if (fit.ok) found.point = std::move(fit.point);
  found.refitted.clear();
  return true;
}

}  // namespace levitas::diagnosis
