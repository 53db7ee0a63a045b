#include "diagnosis/inference/swallowed_causes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/inference/calibrate.hpp"
#include "diagnosis/inference/moved_calibration.hpp"
#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kMostSwallowed = 3;
constexpr std::size_t kFewRows = 18'000;
constexpr std::size_t kJointRows = 30'000;
constexpr int kHeldPasses = 12;
constexpr int kFreePasses = 12;

/// Causes, the point held to the file, and the fit that is free within the tolerances.
struct JointFit {
  std::vector<Hypothesis> causes;
  Point held;
  Refined free;
  double cost{std::numeric_limits<double>::infinity()};  ///< [nat]
};

/// Whether a fit left a number, shapes of modes included, surely beyond the tolerances.
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

/// Fits under the fast observer: on few rows and on more, held to the file and free.
class FileFits {
 public:
  explicit FileFits(const RecordLandscape& landscape)
      : landscape_(landscape),
        held_(HeldToFile(landscape.terms())),
        cautious_(landscape.rig(), held_, std::nullopt, landscape.search().model_error_share()),
        few_(Spans(landscape.records(), kFewRows, landscape.rig().period_s)),
        part_(Spans(landscape.records(), kJointRows, landscape.rig().period_s)),
        fast_few_(cautious_.DesignGains(few_, kFast)),
        fast_(cautious_.DesignGains(part_, kFast)),
        coarse_(cautious_, held_, few_, fast_few_, landscape.rig().axes),
        fine_(cautious_, held_, part_, fast_, landscape.rig().axes),
        free_(landscape.search(), landscape.terms(), part_, fast_, landscape.rig().axes) {}

  [[nodiscard]] Point FileNumbers() const { return cautious_.HealthyPoint(); }

  [[nodiscard]] JointFit Free(const Point& held, const std::vector<Hypothesis>& causes) const {
    JointFit made{causes, held, free_.Approach(held, kWhiteningOrder, kFreePasses, causes)};
    if (made.free.ok) made.cost = free_.Misfit(made.free.point, kWhiteningOrder, causes);
    return made;
  }

  /// The nuisances alone from the file's numbers on, by the way that causes go.
  [[nodiscard]] JointFit Anew() const {
    const Refined coarse = coarse_.Approach(FileNumbers(), kWhiteningOrder, kHeldPasses);
    const Refined held =
        fine_.Approach(coarse.ok ? coarse.point : FileNumbers(), kWhiteningOrder, kHeldPasses);
    return Free(held.ok ? held.point : FileNumbers(), {});
  }

  [[nodiscard]] View LineariseAt(const Point& held) const {
    return cautious_.Linearise(few_, fast_few_, held, kWhiteningOrder, cautious_.Everything());
  }

  /// Every effect at its best place on top of these.
  [[nodiscard]] std::vector<Candidate> Screened(const View& view, const JointFit& base) const {
    return Screen(Evidence(view.problem, held_, base.causes), landscape_.hypotheses());
  }

  /// With a cause more; of infinite cost where the model cannot follow.
  [[nodiscard]] JointFit With(const View& view, const JointFit& base,
                              const Hypothesis& cause) const {
    std::vector<Hypothesis> causes = base.causes;
    causes.push_back(cause);
    const Refined nearest = Nearest(view, base, causes);
    if (!nearest.ok) return {};
    const Refined held = fine_.Approach(nearest.point, kWhiteningOrder, kHeldPasses, causes);
    return Free(held.ok ? held.point : nearest.point, causes);
  }

 private:
  /// From the best of four sizes of the last cause: none, as the screen sees it, and two and four
  /// times as large, since a straight line sees too little of what moves a lightly damped mode by
  /// more than its width. Where none and the largest end alike, the others would, too.
  [[nodiscard]] Refined Nearest(const View& view, const JointFit& base,
                                const std::vector<Hypothesis>& causes) const {
    constexpr double kAlike = 1.0;  // [nat]
    const std::vector<double> seen = cautious_.Solve(view.problem, causes);
    Refined nearest;
    double least = std::numeric_limits<double>::infinity();
    double first = least;
    for (const double times : {0.0, 4.0, 1.0, 2.0}) {
      Refined fit = coarse_.Approach(Start(base.held, seen, causes.back(), times), kWhiteningOrder,
                                     kHeldPasses, causes);
      const double misfit = fit.ok ? coarse_.Misfit(fit.point, kWhiteningOrder, causes)
                                   : std::numeric_limits<double>::infinity();
      if (misfit < least) {
        least = misfit;
        nearest = std::move(fit);
      }
      if (times == 0.0) first = misfit;
      if (times == 4.0 && std::abs(misfit - first) < kAlike) break;
    }
    return nearest;
  }

  static Point Start(Point at, const std::vector<double>& seen, const Hypothesis& cause,
                     double times) {
    for (const std::size_t i : cause.terms) at.theta[i] += times * (seen[i] - at.theta[i]);
    return at;
  }

  const RecordLandscape& landscape_;
  std::vector<Term> held_;
  Search cautious_;
  std::vector<Record> few_, part_;
  Gains fast_few_, fast_;
  Refiner coarse_, fine_, free_;
};

/// The best cause more, where it lowers the cost by `margin`.
bool AddOne(const FileFits& fits, const RecordLandscape& landscape, const Judging& judging,
            JointFit& found) {
  const View view = fits.LineariseAt(found.held);
  const std::vector<Candidate> screened = fits.Screened(view, found);
  JointFit best;
  for (std::size_t i = 0; i < std::min(screened.size(), kMostSwallowed); ++i) {
    if (!(screened[i].score > judging.decisive_nat)) break;
    landscape.ReportProgress(
        0.25, fmt::format("calibrating anew with {}", effect::At(screened[i].effect).name));
    JointFit with = fits.With(view, found, landscape.hypotheses()[screened[i].hypothesis]);
    if (with.cost < best.cost) best = std::move(with);
  }
  if (!(best.cost < found.cost - judging.suspected_nat)) return false;
  found = std::move(best);
  return true;
}

/// The causes with all rows, under the observer of the landscape; false where their gain over no
/// cause, and over those found so far, does not hold there.
bool TakeOver(RecordLandscape& landscape, const SelectionRules& rules, const JointFit& without,
              const JointFit& with, CauseSelection& found) {
  landscape.LineariseAt(without.free.point);
  const Refined base = landscape.Fit({}, without.free.point, rules.effort.passes);
  if (!base.ok) return false;
  double most = landscape.MisfitOf({}, base.point);
  if (!found.causes.empty()) {
    landscape.LineariseAt(found.point);
    const Refined now = landscape.Fit(found.causes, found.point, rules.effort.passes);
    if (now.ok) most = std::min(most, landscape.MisfitOf(found.causes, now.point));
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
/// where it fits better under the observer of the landscape, too, than what was found so far.
void CalibrateAnew(RecordLandscape& landscape, const SelectionRules& rules, const JointFit& anew,
                   CauseSelection& found) {
  const double before = landscape.MisfitOf(found.causes, found.point);
  landscape.LineariseAt(anew.free.point);
  const Refined fit = landscape.Fit({}, anew.free.point, rules.effort.passes);
  if (!fit.ok || !(landscape.MisfitOf({}, fit.point) < before)) return;
  found.causes.clear();
  found.point = found.calibrated = fit.point;
}

}  // namespace

bool TakeSwallowedCauses(RecordLandscape& landscape, const SelectionRules& rules,
                         CauseSelection& found) {
  const std::vector<Term>& terms = landscape.terms();
  const double tolerances = rules.judging.moved_tolerances;
  if (!WentFar(terms, landscape.view().problem, found.point.theta, found.causes, tolerances))
    return false;
  const FileFits fits(landscape);
  // Compared on the same rows and with the same observer; the better of two ways without a cause,
  // and what was found so far.
  JointFit without = fits.Free(found.calibrated, {});
  if (JointFit anew = fits.Anew(); anew.cost < without.cost) {
    without = std::move(anew);
    CalibrateAnew(landscape, rules, without, found);
  }
  if (!without.free.ok) return false;
  JointFit with = without;
  if (!found.causes.empty()) {
    with.cost = std::min(with.cost, fits.Free(found.point, found.causes).cost);
  }
  with.held = fits.FileNumbers();
  while (with.causes.size() < rules.most_causes &&
         WentFar(terms, with.free.problem, with.free.point.theta, with.causes, tolerances)) {
    if (!AddOne(fits, landscape, rules.judging, with)) break;
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
