#include "diagnosis/inference/loud_fault.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/coloured.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kMostTried = 3;

bool IsLoud(const std::vector<Trajectory>& runs, std::size_t axes) {
  return TakesAway(MakeWhitener(runs, axes, kWhiteningOrder), MakeWhitener(runs, axes, 0), kLoud);
}

/// The best single cause from the rig file's numbers on, all innovations weighed alike.
CauseSet FromFile(RecordLandscape& landscape, const SelectionRules& rules) {
  landscape.LineariseUnfiltered(landscape.search().HealthyParameters());
  const std::vector<Candidate> screened = landscape.Screen({});
  CauseSet best;
  for (std::size_t i = 0; i < std::min(screened.size(), kMostTried); ++i) {
    if (!(screened[i].score > rules.judging.decisive_nat)) break;
    landscape.ReportProgress(0.4, fmt::format("asking for {} from the file's numbers",
                                              effect::At(screened[i].effect).name));
    const std::vector<Hypothesis> cause{landscape.hypotheses()[screened[i].hypothesis]};
    best.Take(cause, landscape.Refit(cause));
  }
  return best;
}

}  // namespace

bool TakeLoudFault(RecordLandscape& landscape, const SelectionRules& rules, CauseSelection& found) {
  if (rules.most_causes == 0 || !IsLoud(landscape.RunAt(found.theta), landscape.rig().axes))
    return false;
  const std::vector<double> linearised_at = landscape.view().theta;
  const double before = landscape.MisfitOf(found.causes, found.theta);
  CauseSet loud = FromFile(landscape, rules);
  if (loud.fit.ok) {
    landscape.LineariseAt(loud.fit.theta);
    Refined fit = landscape.Fit(loud.causes, loud.fit.theta, rules.effort.passes);
    // By as much as a cause must lead to be suspected: a model is never exact.
    const double most = before - rules.judging.suspected_nat;
    if (fit.ok && landscape.MisfitOf(loud.causes, fit.theta) < most) {
      found.causes = std::move(loud.causes);
      found.theta = std::move(fit.theta);
      found.refitted.clear();  // they were weighed by the filter that hid it
      return true;
    }
  }
  landscape.LineariseAt(linearised_at);
  return false;
}

}  // namespace levitas::diagnosis
