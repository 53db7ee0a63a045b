#include "diagnosis/inference/unmoved_start.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/moved_calibration.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "diagnosis/model/divergence.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kFrozen = 0.01;      ///< of a tolerance
constexpr std::size_t kTried = 4;     ///< causes that are fitted with the rig held
constexpr std::size_t kReleased = 2;  ///< of those, with the file's tolerances

/// The best causes of a rig that is as its file says, each with its fit, best first. Without
/// linearisation afterwards.
std::vector<CauseSet> OfTheFile(RecordLandscape& landscape, const std::vector<Record>& all,
                                const SelectionRules& rules, const Whitener& whitener) {
  const double share = landscape.search().model_error_share();
  const std::vector<Term> held = Held(landscape.terms(), kFrozen);
  const std::vector<double> start =
      NearFile(landscape.rig(), held, share, all, kSpeeds[landscape.speed()]);
  const Search search(landscape.rig(), held, "", share);
  landscape.DropLinearisation();
  auto runs = std::make_shared<const std::vector<Trajectory>>(
      search.Run(landscape.records(), landscape.gains(), start));
  const View view = search.Linearise(std::move(runs), start, whitener, search.Everything());
  std::vector<CauseSet> sets;
  if (SensitivitiesDiverge(view.sum)) return sets;
  const Refiner refiner(search, held, landscape.records(), landscape.gains(), landscape.rig().axes);
  const std::vector<Candidate> screened =
      Screen(Evidence(view.problem, held, {}), landscape.hypotheses());
  for (std::size_t i = 0; i < std::min(kTried, screened.size()); ++i) {
    landscape.ReportProgress(0.2, "fitting " + screened[i].effect + " from the rig file");
    const std::vector<Hypothesis> causes{landscape.hypotheses()[screened[i].hypothesis]};
    Refined fit =
        refiner.Fit(causes, search.Solve(view.problem, causes), view, rules.effort.passes);
    if (fit.ok) sets.push_back({causes, std::move(fit)});
  }
  std::ranges::stable_sort(
      sets, [](const auto& a, const auto& b) { return a.fit.evidence > b.fit.evidence; });
  return sets;
}

}  // namespace

bool StartNearFile(RecordLandscape& landscape, const std::vector<Record>& all,
                   const SelectionRules& rules, CauseSelection& found) {
  const Fit fit = landscape.EvidenceGiven({}).Solve();
  if (MovedBeyond(landscape.terms(), fit, found.theta, {}, rules.judging.moved_tolerances).empty())
    return false;
  const Refined calibrated = landscape.Fit({}, found.theta, 2);
  if (!calibrated.ok) return false;
  const Whitener whitener = landscape.view().whitener;
  auto calibrated_runs = landscape.view().runs;
  landscape.ReportProgress(0.2, "starting near the rig file");
  const std::vector<CauseSet> sets = OfTheFile(landscape, all, rules, whitener);
  CauseSet best;
  double worth = calibrated.evidence + rules.judging.decisive_nat;
  for (std::size_t i = 0; i < std::min(kReleased, sets.size()); ++i) {
    landscape.LineariseAt(sets[i].fit.theta, whitener);
    if (SensitivitiesDiverge(landscape.view().sum)) continue;
    best.Take(sets[i].causes,
              landscape.Fit(sets[i].causes, sets[i].fit.theta, rules.effort.passes, worth));
    if (best.fit.ok) worth = std::max(worth, best.fit.evidence);
  }
  const bool ahead =
      best.fit.ok && best.fit.evidence > calibrated.evidence + rules.judging.decisive_nat;
  if (ahead) {
    found.causes = std::move(best.causes);
    found.theta = best.fit.theta;
    found.calibrated_runs = std::move(calibrated_runs);
  }
  landscape.LineariseAt(found.theta);
  return ahead;
}

}  // namespace levitas::diagnosis
