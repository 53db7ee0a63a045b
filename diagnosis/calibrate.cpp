#include "diagnosis/calibrate.hpp"

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kFastRows = 18'000;  ///< of all records

}  // namespace

Refined CalibrateNuisances(const RigView& rig, const Search& search, const std::vector<Term>& terms,
                           const std::vector<Record>& all, const std::vector<Record>& records,
                           const Gains& gains, int passes) {
  Refined fit;
  fit.theta = search.Usual();
  const auto settle = [&](const std::vector<Record>& data, const Gains& with, int most) {
    const Refiner refiner(search, terms, data, with, rig.axes);
    // What a fast observer likes on a part of the records may be worse than the usual rig. Judged by
    // plain power: a whitening of its own would take a large orbit for colour and forgive it.
    const double here = refiner.Misfit(fit.theta, 0);
    const double usual = refiner.Misfit(search.Usual(), 0);
    if (!std::isfinite(here) || usual < here) fit.theta = search.Usual();
    Refined better = refiner.Approach(fit.theta, kWhiteningOrder, most);
    if (better.ok) fit = std::move(better);
  };
  const std::vector<Record> few = Spans(all, kFastRows);
  const Gains fast = search.DesignGains(few, kFast);
  Refined first =
      Refiner(search, terms, few, fast, rig.axes).Approach(fit.theta, kWhiteningOrder, 3);
  if (first.ok) fit = std::move(first);
  settle(records, gains, passes);
  return fit;
}

void LearnFromHealthy(const RigView& rig, const std::vector<Record>& healthy,
                      std::vector<Term>& terms) {
  const Search search(rig, terms);
  const std::vector<Record> records = Spans(healthy, kHealthyRows);
  constexpr int kPasses = 8;
  const Refined fit = CalibrateNuisances(rig, search, terms, healthy, records,
                                         search.DesignGains(records, kSlow), kPasses);
  if (!fit.ok) throw BadInput("the healthy records cannot be calibrated: is it the same rig?");
  const Fit posterior = Evidence(fit.problem, terms, {}).Solve();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    Term& term = terms[i];
    if (!term.nuisance()) continue;
    const double left = posterior.deviation[static_cast<Eigen::Index>(i)] * term.scale();
    term.usual = fit.theta[i];
    term.tolerance = std::min(term.tolerance, std::hypot(left, kDaily * term.tolerance));
  }
}

}  // namespace levitas::diagnosis
