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

/// The best single cause from the rig file's numbers on, all innovations weighed alike; with the
/// shapes found so far.
CauseSet FromFile(ObservedLandscape& landscape, const SelectionRules& rules,
                  const CauseSelection& found) {
  landscape.LineariseUnfiltered({landscape.FileNumbers().theta, found.point.shapes});
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

bool IsLoud(const std::vector<Trajectory>& runs, std::size_t axes) {
  return TakesAway(MakeWhitener(runs, axes, kWhiteningOrder), MakeWhitener(runs, axes, 0), kLoud);
}

bool TakeLoudFault(ObservedLandscape& landscape, const SelectionRules& rules,
                   CauseSelection& found) {
  if (rules.most_causes == 0 || !landscape.IsLoudAt(found.point)) return false;
  const Point linearised_at = landscape.view().point;
  const double before = landscape.MisfitOf(found.causes, found.point);
  CauseSet loud = FromFile(landscape, rules, found);
  if (loud.fit.ok) {
    landscape.LineariseAt(loud.fit.point);
    Refined fit = landscape.Fit(loud.causes, loud.fit.point, rules.effort.passes);
    // By as much as a cause must lead to be suspected: a model is never exact.
    const double most = before - rules.judging.suspected_nat;
    if (fit.ok && landscape.MisfitOf(loud.causes, fit.point) < most) {
      found.causes = std::move(loud.causes);
      found.point = std::move(fit.point);
      found.refitted.clear();  // they were weighed by the filter that hid it
      return true;
    }
  }
  landscape.LineariseAt(linearised_at);
  return false;
}

}  // namespace levitas::diagnosis
