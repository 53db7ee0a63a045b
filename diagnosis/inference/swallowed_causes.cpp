#include "diagnosis/inference/swallowed_causes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "diagnosis/inference/moved_calibration.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kMostSwallowed = 3;
/// [nat] What begins so far behind the best, on few rows and held to the file, does not end before
/// it: right causes began hundreds of nat ahead of others.
constexpr double kFarBehind = 100.0;

/// What is worth a fit on top of `found`: the best few of the screen, and causes that were found
/// about the calibrated numbers, whose own numbers may have gone the wrong way with those.
std::vector<Hypothesis> WorthAFit(const EvidenceLandscape& landscape,
                                  const std::vector<Candidate>& screened, const Judging& judging,
                                  const std::vector<Hypothesis>& before, const JointFit& found) {
  std::vector<Hypothesis> worth;
  for (const Hypothesis& cause : before) {
    if (!IsAmong(found.causes, cause)) worth.push_back(cause);
  }
  for (std::size_t i = 0; i < std::min(screened.size(), kMostSwallowed); ++i) {
    const Hypothesis& cause = landscape.hypotheses()[screened[i].hypothesis];
    if (screened[i].score > judging.decisive_nat && !IsAmong(worth, cause)) worth.push_back(cause);
  }
  return worth;
}

/// The best cause more, where it lowers the cost by suspected_nat.
bool AddOne(const FileFits& fits, const EvidenceLandscape& landscape, const Judging& judging,
            const std::vector<Hypothesis>& before, JointFit& found) {
  const View view = fits.LineariseAt(found.held);
  std::vector<JointStart> begun;
  double least = std::numeric_limits<double>::infinity();
  for (const Hypothesis& cause :
       WorthAFit(landscape, fits.Screened(view, found), judging, before, found)) {
    if (landscape.StopAsked()) break;
    landscape.ReportProgress(
        0.25, fmt::format("calibrating anew with {}", effect::At(cause.effect).name));
    begun.push_back(fits.Begin(view, found, cause));
    least = std::min(least, begun.back().cost);
  }
  JointFit best;
  for (const JointStart& start : begun) {
    if (!(start.cost < least + kFarBehind) || landscape.StopAsked()) continue;
    JointFit with = fits.Finish(start);
    if (with.cost < best.cost) best = std::move(with);
  }
  if (!(best.cost < found.cost - judging.suspected_nat)) return false;
  found = std::move(best);
  return true;
}

/// [nat] What is left with these causes, fitted from the point on under the observer of the
/// landscape: a point that another observer led to pays for that until it is fitted anew. Leaves
/// the landscape linearised at the point.
double FittedMisfit(ObservedLandscape& landscape, const SelectionRules& rules,
                    const std::vector<Hypothesis>& causes, const Point& point) {
  landscape.LineariseAt(point);
  const Refined fit = landscape.Fit(causes, point, rules.effort.passes);
  return fit.ok ? landscape.MisfitOf(causes, fit.point) : std::numeric_limits<double>::infinity();
}

/// The causes with all rows, under the observer of the landscape; false where their gain over no
/// cause, and over those found so far, does not hold there.
bool TakeOver(ObservedLandscape& landscape, const SelectionRules& rules, const JointFit& without,
              const JointFit& with, CauseSelection& found) {
  double most = FittedMisfit(landscape, rules, {}, without.free.point);
  if (most == std::numeric_limits<double>::infinity()) return false;
  if (!found.causes.empty()) {
    most = std::min(most, FittedMisfit(landscape, rules, found.causes, found.point));
  }
  most -= rules.judging.suspected_nat;
  landscape.LineariseAt(with.free.point);
  Refined fit = landscape.Fit(with.causes, with.free.point, rules.effort.passes);
  if (!fit.ok || !(landscape.MisfitOf(with.causes, fit.point) < most)) return false;
  found.causes = with.causes;
  for (std::size_t i = 0; i < found.causes.size(); ++i) {
    fit = landscape.RefineShapeOf(with.causes, i, std::move(fit));
  }
  found.point = fit.point;
  found.refitted.clear();  // weighed about the calibration that hid them
  return true;
}

/// A calibration that had lost its way, and not to a cause: the one from the file takes its place,
/// where it fits better under the observer of the landscape, too, than what was found so far. That
/// keeps its point, fitted or not: a slower observer, which sees more, may have led it there.
void CalibrateAnew(ObservedLandscape& landscape, const SelectionRules& rules, const JointFit& anew,
                   CauseSelection& found) {
  const double before = std::min(landscape.MisfitOf(found.causes, found.point),
                                 FittedMisfit(landscape, rules, found.causes, found.point));
  landscape.LineariseAt(anew.free.point);
  const Refined fit = landscape.Fit({}, anew.free.point, rules.effort.passes);
  if (!fit.ok || !(landscape.MisfitOf({}, fit.point) < before)) return;
  found.causes.clear();
  found.point = found.calibrated = fit.point;
  found.refitted.clear();  // weighed about the calibration that had lost its way
}

}  // namespace

bool WentFar(const std::vector<Term>& terms, const LinearProblem& problem,
             const std::vector<double>& theta, const std::vector<Hypothesis>& causes,
             double tolerances) {
  const Fit fit = Evidence(problem, terms, causes).Solve();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].nuisance() && !Moves(causes, i) &&
        SurelyAway(terms[i], fit, theta, i) > tolerances)
      return true;
  }
  return false;
}

bool TakeSwallowedCauses(ObservedLandscape& landscape, const SelectionRules& rules,
                         CauseSelection& found) {
  const std::vector<Term>& terms = landscape.terms();
  const double tolerances = rules.judging.moved_tolerances;
  if (!WentFar(terms, landscape.view().problem, found.point.theta, found.causes, tolerances))
    return false;
  const std::unique_ptr<FileFits> fits = landscape.FitsFromFile();
  // Compared on the same rows and with the same observer; the better of two ways without a cause,
  // and what was found so far.
  const std::vector<Hypothesis> before = found.causes;
  JointFit without = fits->Free(found.calibrated, {});
  if (JointFit anew = fits->Anew(); anew.cost < without.cost) {
    without = std::move(anew);
    CalibrateAnew(landscape, rules, without, found);
  }
  if (!without.free.ok) return false;
  JointFit with = without;
  if (!found.causes.empty()) {
    with.cost = std::min(with.cost, fits->Free(found.point, found.causes).cost);
  }
  with.held = landscape.FileNumbers();
  while (with.causes.size() < rules.most_causes && !landscape.StopAsked() &&
         WentFar(terms, with.free.problem, with.free.point.theta, with.causes, tolerances)) {
    if (!AddOne(*fits, landscape, rules.judging, before, with)) break;
  }
  bool taken = false;
  if (!with.causes.empty()) {
    const std::size_t slow = landscape.speed();
    landscape.Observe(kSpeeds.size() - 1);
    taken = TakeOver(landscape, rules, without, with, found);
    if (!taken) landscape.Observe(slow);
  }
  landscape.LineariseAt(found.point);
  return taken;
}

}  // namespace levitas::diagnosis
