#include "diagnosis/inference/find_causes.hpp"

#include <memory>

#include "diagnosis/inference/loud_fault.hpp"
#include "diagnosis/inference/selection_steps.hpp"
#include "diagnosis/inference/whiten_anew.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

/// Back to slower observers, which see more, as far as the model with the causes found so far does
/// not lose the rotor under them; not below `slowest`.
void SlowDown(RecordLandscape& landscape, const SelectionRules& rules, std::size_t slowest,
              CauseSelection& found) {
  while (landscape.speed() > slowest) {
    const std::size_t fast = landscape.speed();
    landscape.Observe(fast - 1);
    Refined fit;
    if (!ModelDiverges(landscape.rig(), landscape.RunAt(found.theta))) {
      landscape.LineariseAt(found.theta);
      if (!SensitivitiesDiverge(landscape.view().sum)) {
        fit = landscape.Fit(found.causes, found.theta, rules.effort.passes);
      }
    }
    if (!fit.ok) {
      landscape.Observe(fast);
      return;
    }
    found.theta = fit.theta;
    if (!rules.effort.first_cause_only) RefineLastShape(landscape, fit, found);
    found.calibrated_runs =
        std::make_shared<const std::vector<Trajectory>>(landscape.RunAt(found.calibrated));
  }
}

}  // namespace

void FindCauses(RecordLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  std::size_t slowest = 0;  // of the observers that can be gone back to
  for (std::size_t stage = 0;; ++stage) {
    const double share = 0.2 + 0.2 * static_cast<double>(stage);
    if (stage > 0) SlowDown(landscape, rules, slowest, found);
    landscape.ReportProgress(share, "screening all causes");
    landscape.LineariseAt(found.theta);
    while (SensitivitiesDiverge(landscape.view().sum) && landscape.speed() + 1 < kSpeeds.size()) {
      // Once more without any cause and with a faster observer, which holds the model where a
      // wrong cause leads it astray.
      found.causes.clear();
      found.theta = found.calibrated;
      slowest = landscape.speed() + 1;
      landscape.Observe(slowest);
      landscape.LineariseAt(found.theta);
    }
    if (found.causes.empty()) found.calibrated_runs = landscape.view().runs;
    bool added =
        found.causes.size() < rules.most_causes && AddCause(landscape, rules, share, found);
    if (stage == 0) added = TakeLoudFault(landscape, rules, found) || added;
    if (!added) return;
    if (rules.effort.first_cause_only) {
      found.whitened_anew = WhitenAnew(landscape, rules, found);
      return;
    }
  }
}

}  // namespace levitas::diagnosis
