#include "diagnosis/inference/whiten_anew.hpp"

#include <utility>

namespace levitas::diagnosis {
namespace {

/// Whether the filter takes anything away. It begins with one over the rms of what it leaves.
bool Colours(const Whitener& filter, const Whitener& plain) {
  constexpr double kOfTheRms = 1.03;  // 30 nat of a thousand samples
  for (std::size_t a = 0; a < filter.filter.size(); ++a) {
    if (filter.filter[a].front() > kOfTheRms * plain.filter[a].front()) return true;
  }
  return false;
}

}  // namespace

bool WhitenAnew(RecordLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  if (found.causes.empty()) return false;
  if (!Colours(landscape.view().whitener, landscape.search().WhitenerOf(*found.calibrated_runs, 0)))
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
