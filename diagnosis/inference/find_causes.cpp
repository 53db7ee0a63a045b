#include "diagnosis/inference/find_causes.hpp"

#include <utility>

#include "diagnosis/inference/coloured.hpp"
#include "diagnosis/inference/loud_fault.hpp"
#include "diagnosis/inference/selection_steps.hpp"
#include "diagnosis/inference/swallowed_causes.hpp"
#include "diagnosis/inference/whiten_anew.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Whether the model is farther from the readings than under the faster observer: one that has the
/// causes is as near, for it follows by itself.
bool FallsBehind(const ObservedLandscape& landscape, const Point& point, const Whitener& faster) {
  constexpr double kTimes = 1.5;
  return TakesAway(faster, landscape.PlainFilterOf(*landscape.RunsAt(point)), kTimes);
}

/// Back to slower observers, which see more, as far as the model with the causes found so far does
/// not lose the rotor under them, nor falls behind; not below `slowest`.
void SlowDown(ObservedLandscape& landscape, const SelectionRules& rules, std::size_t slowest,
              CauseSelection& found) {
  while (landscape.speed() > slowest) {
    const std::size_t fast = landscape.speed();
    const Whitener faster = landscape.PlainFilterOf(*landscape.RunsAt(found.point));
    landscape.Observe(fast - 1);
    Refined fit;
    if (!landscape.ModelDivergesAt(found.point)) {
      landscape.LineariseAt(found.point);
      if (!SensitivitiesDiverge(landscape.view().sum)) {
        fit = landscape.Fit(found.causes, found.point, rules.effort.passes);
      }
    }
    if (!fit.ok || FallsBehind(landscape, fit.point, faster)) {
      landscape.Observe(fast);
      return;
    }
    found.point = fit.point;
    RefineLastShape(landscape, fit, found);
    found.calibrated_runs = landscape.RunsAt(found.calibrated);
  }
}

/// Whether there were swallowed causes, or a calibration in place of one that had lost its way.
bool TakeSwallowed(ObservedLandscape& landscape, const SelectionRules& rules,
                   CauseSelection& found) {
  const Point before = found.calibrated;
  const bool taken = TakeSwallowedCauses(landscape, rules, found);
  if (!taken && found.calibrated == before) return false;
  found.calibrated_runs = landscape.RunsAt(found.calibrated);
  return true;
}

}  // namespace

void FindCauses(ObservedLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  std::size_t slowest = 0;                     // of the observers that can be gone back to
  bool asked = rules.effort.first_cause_only;  // for causes that calibration swallowed
  for (std::size_t stage = 0;; ++stage) {
    const double share = 0.2 + 0.2 * static_cast<double>(stage);
    if (stage > 0) SlowDown(landscape, rules, slowest, found);
    landscape.ReportProgress(share, "screening all causes");
    landscape.LineariseAt(found.point);
    while (SensitivitiesDiverge(landscape.view().sum) && landscape.speed() + 1 < kSpeeds.size()) {
      // Once more without any cause and with a faster observer, which holds the model where a
      // wrong cause leads it astray.
      found.causes.clear();
      found.point = found.WithoutCauses();
      slowest = landscape.speed() + 1;
      landscape.Observe(slowest);
      landscape.LineariseAt(found.point);
    }
    if (found.causes.empty()) found.calibrated_runs = landscape.view().runs;
    if (landscape.StopAsked()) return;
    // A first cause that brings calibrated numbers back is all there is to find.
    const bool first = !found.causes.empty() && !std::exchange(asked, true) &&
                       TakeSwallowed(landscape, rules, found);
    bool added =
        (found.causes.size() < rules.most_causes && AddCause(landscape, rules, share, found)) ||
        first;
    if (!added && !std::exchange(asked, true)) added = TakeSwallowed(landscape, rules, found);
    if (stage == 0) added = TakeLoudFault(landscape, rules, found) || added;
    if (!added) return;
    if (rules.effort.first_cause_only) {
      found.whitened_anew = WhitenAnew(landscape, rules, found);
      return;
    }
  }
}

}  // namespace levitas::diagnosis
