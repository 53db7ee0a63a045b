#include "diagnosis/inference/unmoved_start.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/moved_calibration.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kTried = 4;

/// The best of the causes that the present linearisation puts first.
CauseSet BestFromHere(const RecordLandscape& landscape, const SelectionRules& rules, double worth) {
  const std::vector<Candidate> screened = landscape.Screen({});
  CauseSet best;
  for (std::size_t i = 0; i < std::min(kTried, screened.size()); ++i) {
    landscape.ReportProgress(0.2, "fitting " + screened[i].effect + " from the rig file");
    const std::vector<Hypothesis> causes{landscape.hypotheses()[screened[i].hypothesis]};
    best.Take(causes, landscape.Fit(causes, landscape.SolutionOf(causes), rules.effort.passes,
                                    best.fit.ok ? best.fit.evidence : worth));
  }
  return best;
}

}  // namespace

bool StartNearFile(RecordLandscape& landscape, const std::vector<Record>& all,
                   const SelectionRules& rules, CauseSelection& found) {
  const Fit fit = landscape.EvidenceGiven({}).Solve();
  if (MovedBeyond(landscape.terms(), fit, found.theta, {}, rules.judging.moved_tolerances).empty())
    return false;
  const Refined calibrated = landscape.Fit({}, found.theta, 2);
  if (!calibrated.ok) return false;
  const double worth = calibrated.evidence + rules.judging.decisive_nat;
  const Whitener whitener = landscape.view().whitener;
  auto calibrated_runs = landscape.view().runs;
  landscape.ReportProgress(0.2, "starting near the rig file");
  landscape.LineariseAt(NearFile(landscape.rig(), landscape.search(), landscape.terms(), all,
                                 kSpeeds[landscape.speed()]),
                        whitener);
  CauseSet best;
  if (!SensitivitiesDiverge(landscape.view().sum)) best = BestFromHere(landscape, rules, worth);
  const bool ahead = best.fit.ok && best.fit.evidence > worth;
  if (ahead) {
    found.causes = std::move(best.causes);
    found.theta = best.fit.theta;
    found.calibrated_runs = std::move(calibrated_runs);
  }
  landscape.LineariseAt(found.theta);
  return ahead;
}

}  // namespace levitas::diagnosis
