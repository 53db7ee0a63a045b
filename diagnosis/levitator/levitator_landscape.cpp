#include "diagnosis/levitator/levitator_landscape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/inference/ranking.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::levitator {
namespace {

using diagnosis::Hypothesis;

constexpr int kCalibrationSteps = 16;
constexpr int kFirstSteps = 4;  ///< after which a set is left that is worth too little
/// Share of the evidence that further steps may still find.
constexpr double kUnsettled = 0.1;
constexpr int kAllSteps = 8;

std::size_t IndexOf(const Hypothesis& cause) {
  const auto& all = Causes();
  const auto same = std::find_if(all.begin(), all.end(), [&](const Hypothesis& h) {
    return h.effect == cause.effect && h.terms == cause.terms;
  });
  return static_cast<std::size_t>(same - all.begin());
}

std::vector<std::size_t> SetKey(const std::vector<Hypothesis>& set) {
  std::vector<std::size_t> key;
  key.reserve(set.size());
  for (const Hypothesis& cause : set) key.push_back(IndexOf(cause));
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<Hypothesis> With(std::vector<Hypothesis> set, const Hypothesis& cause) {
  set.push_back(cause);
  return set;
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
  at_.theta = Keep({}, fitter_.Fit({}, at_.theta, filters_, kCalibrationSteps), true).theta;
}

const LevitatorLandscape::Kept* LevitatorLandscape::Find(const Causes& set) const {
  const auto kept = kept_.find(SetKey(set));
  return kept == kept_.end() ? nullptr : &kept->second;
}

const Fitted& LevitatorLandscape::Keep(const Causes& set, Fitted fitted, bool settled) const {
  const auto [at, is_new] = kept_.try_emplace(SetKey(set));
  Kept& kept = at->second;
  kept.settled = kept.settled || settled;
  if (is_new || fitted.evidence > kept.best.evidence) kept.best = std::move(fitted);
  return kept.best;
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
  return Refit(With(given, cause)).evidence - Refit(given).evidence;
}

double LevitatorLandscape::GainAt(const Refined& fit, const Hypothesis& cause,
                                  const Causes& given) const {
  return FitOf(With(given, cause)).evidence - Fit(given, fit.point, kAllSteps).evidence;
}

std::vector<diagnosis::Candidate> LevitatorLandscape::Screen(const Causes& given) const {
  const Fitted base = FitOf(given);
  const std::vector<double> gains = fitter_.Screen(given, base, filters_);
  std::map<effect::Id, Candidate, effect::ByName> best;
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const Hypothesis& h = hypotheses()[i];
    const bool has = std::any_of(given.begin(), given.end(),
                                 [&](const Hypothesis& g) { return g.effect == h.effect; });
    if (has || !std::isfinite(gains[i])) continue;
    const Candidate candidate{h.effect, h.place, gains[i], i, false};
    const auto [at, added] = best.try_emplace(h.effect, candidate);
    if (!added && gains[i] > at->second.score) at->second = candidate;
  }
  std::vector<Candidate> sorted;
  for (const auto& [effect, candidate] : best) sorted.push_back(candidate);
  diagnosis::SortByScore(sorted);
  return sorted;
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

diagnosis::Refined LevitatorLandscape::Fit(const Causes& set, const Point& start, int passes,
                                           double worth) const {
  const Kept* kept = Find(set);
  if (kept != nullptr && kept->best.theta == start.theta) return RefinedOf(kept->best);
  Fitted fitted = fitter_.Fit(set, start.theta, filters_, std::min(passes, kFirstSteps));
  const double hopeless = worth - kUnsettled * std::max(0.0, worth - kept_.at({}).best.evidence);
  const bool settles = passes > kFirstSteps && !(fitted.evidence < hopeless);
  if (settles) {
    Fitted settled = fitter_.Fit(set, fitted.theta, filters_, passes);
    if (settled.evidence > fitted.evidence) fitted = std::move(settled);
  }
  return RefinedOf(Keep(set, std::move(fitted), settles));
}

diagnosis::Refined LevitatorLandscape::Refit(const Causes& set, double worth) const {
  const Kept* kept = Find(set);
  if (kept != nullptr && kept->linearisation == linearisation_) return RefinedOf(kept->best);
  Refined refined = Fit(set, at_, kAllSteps, worth);
  Kept& fitted = kept_.at(SetKey(set));
  if (fitted.settled) fitted.linearisation = linearisation_;
  return refined;
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
