#include "diagnosis/inference/whiten_anew.hpp"

#include <utility>

#include "diagnosis/inference/coloured.hpp"

namespace levitas::diagnosis {

bool WhitenAnew(RecordLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  constexpr double kSomething = 1.03;  // 30 nat of a thousand samples
  if (found.causes.empty()) return false;
  if (!TakesAway(landscape.view().whitener,
                 landscape.search().WhitenerOf(*found.calibrated_runs, 0), kSomething))
    return false;
  // First without any filter: the next one would hold what the former one left of the cause.
  landscape.ReportProgress(0.6, "whitening anew");
  landscape.LineariseUnfiltered(found.theta);
  const Refined plain = landscape.Fit(found.causes, found.theta, rules.effort.passes);
  if (plain.ok) found.theta = plain.theta;
  landscape.LineariseAt(found.theta);
  Refined fit = landscape.Fit(found.causes, found.theta, rules.effort.passes);
  if (fit.ok) found.theta = std::move(fit.theta);
  found.refitted.clear();
  return true;
}

}  // namespace levitas::diagnosis
