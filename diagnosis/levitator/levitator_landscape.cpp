#include "diagnosis/levitator/levitator_landscape.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "diagnosis/inference/ranking.hpp"

namespace levitas::levitator {
namespace {

using diagnosis::Hypothesis;

constexpr int kCalibrationSteps = 16;
constexpr int kFirstSteps = 4;  ///< after which a set is left that is worth too little
/// Share of the evidence that further steps may still find.
constexpr double kUnsettled = 0.1;

std::vector<std::size_t> SetKey(const std::vector<Hypothesis>& set) {
  std::vector<std::size_t> key;
  key.reserve(set.size());
  for (const Hypothesis& cause : set) key.push_back(diagnosis::IndexOf(AllCauses(), cause));
  std::sort(key.begin(), key.end());
  return key;
}

diagnosis::Refined RefinedOf(const Fitted& fitted) {
  diagnosis::Refined refined;
  refined.point.theta = fitted.theta;
  refined.evidence = fitted.evidence;
  refined.ok = true;
  return refined;
}

}  // namespace

LevitatorLandscape::LevitatorLandscape(const Misfit& data, Progress progress)
    : fitter_(data), progress_(std::move(progress)) {
  ReportProgress(0.02, "calibrating");
  filters_ = fitter_.Noise();
  ReportProgress(0.05, "calibrating");
  at_.theta = Zeros(data.series().size());
  Keep({}, fitter_.Fit({}, at_.theta, filters_, kCalibrationSteps), true);
  at_.theta = Find({})->best.theta;
}

const LevitatorLandscape::Kept* LevitatorLandscape::Find(const Causes& set) const {
  const auto kept = kept_.find(SetKey(set));
  return kept == kept_.end() ? nullptr : &kept->second;
}

void LevitatorLandscape::Keep(const Causes& set, Fitted fitted, bool settled) const {
  const auto [at, is_new] = kept_.try_emplace(SetKey(set));
  Kept& kept = at->second;
  kept.settled = kept.settled || settled;
  if (is_new || fitted.evidence > kept.best.evidence) kept.best = std::move(fitted);
}

const Fitted& LevitatorLandscape::FitOf(const Causes& set) const {
  if (const Kept* kept = Find(set)) return kept->best;
  (void)Refit(set);
  return Find(set)->best;
}

void LevitatorLandscape::LineariseAt(const Point& point) {
  if (point.theta != at_.theta) ++linearisation_;
  at_ = point;
}

double LevitatorLandscape::GainOf(const Hypothesis& cause, const Causes& given) const {
  return Refit(diagnosis::With(given, cause)).evidence - Refit(given).evidence;
}

double LevitatorLandscape::GainAt(const Refined& fit, const Hypothesis& cause,
                                  const Causes& given) const {
  return FitOf(diagnosis::With(given, cause)).evidence - Fit(given, fit.point, kAllSteps).evidence;
}

std::vector<diagnosis::Candidate> LevitatorLandscape::Screen(const Causes& given) const {
  const Fitted base = FitOf(given);
  std::vector<double> gains = fitter_.Screen(given, base, filters_);
  for (std::size_t i = 0; i < gains.size(); ++i) {
    if (diagnosis::HasEffect(given, hypotheses()[i].effect))
      gains[i] = -std::numeric_limits<double>::infinity();
  }
  return diagnosis::BestOfEachEffect(hypotheses(), gains);
}

double LevitatorLandscape::EvidenceOf(const Causes& set) const {
  const Kept* kept = Find(set);
  return kept != nullptr && kept->settled ? kept->best.evidence : Refit(set).evidence;
}

diagnosis::Point LevitatorLandscape::SolutionOf(const Causes& set) const {
  return Refit(set).point;
}

diagnosis::Point LevitatorLandscape::SolutionAt(const Refined& fit, const Causes& set) const {
  return Fit(set, fit.point, kAllSteps).point;
}

bool LevitatorLandscape::Settle(const Causes& set, const Point& start, int passes,
                                double worth) const {
  const Kept* kept = Find(set);
  if (kept != nullptr && kept->best.theta == start.theta) return kept->settled;
  Fitted fitted = fitter_.Fit(set, start.theta, filters_, std::min(passes, kFirstSteps));
  const double hopeless = worth - kUnsettled * std::max(0.0, worth - kept_.at({}).best.evidence);
  const bool settles = passes > kFirstSteps && !(fitted.evidence < hopeless);
  if (settles) {
    Fitted settled = fitter_.Fit(set, fitted.theta, filters_, passes);
    if (settled.evidence > fitted.evidence) fitted = std::move(settled);
  }
  Keep(set, std::move(fitted), settles);
  return settles;
}

diagnosis::Refined LevitatorLandscape::Fit(const Causes& set, const Point& start, int passes,
                                           double worth) const {
  (void)Settle(set, start, passes, worth);
  return RefinedOf(Find(set)->best);
}

diagnosis::Refined LevitatorLandscape::Refit(const Causes& set, double worth) const {
  const Kept* kept = Find(set);
  const bool done = kept != nullptr && kept->linearisation == linearisation_;
  if (!done && Settle(set, at_, kAllSteps, worth)) {
    kept_.at(SetKey(set)).linearisation = linearisation_;
  }
  return RefinedOf(Find(set)->best);
}

diagnosis::Refined LevitatorLandscape::RefineShapeOf(const Causes& /*set*/, std::size_t /*at*/,
                                                     Refined fit, double /*worth*/) const {
  return fit;
}

bool LevitatorLandscape::HasShape(const Hypothesis& /*cause*/) const { return false; }

std::string LevitatorLandscape::PlaceAt(const Point& /*point*/, const Hypothesis& cause) const {
  return cause.place;
}

std::vector<diagnosis::ModeProbe> LevitatorLandscape::Probes() const { return {}; }

void LevitatorLandscape::ReportProgress(double share, const std::string& what) const {
  if (!progress_) return;
  share_ = std::max(share_, share);
  progress_(share_, what);
}

}  // namespace levitas::levitator
