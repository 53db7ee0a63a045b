#include "diagnosis/inference/calibrate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/problem.hpp"
#include "diagnosis/inference/coloured.hpp"
#include "diagnosis/inference/frequency_scan.hpp"
#include "diagnosis/inference/residual.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kFastRows = 18'000;  ///< of all records
constexpr std::size_t kStartRows = 30'000;
constexpr int kStartPasses = 5;
constexpr int kSecondPasses = 12;
constexpr double kHeld = 0.2;  ///< of its tolerance

/// Whether a filter takes the fit's innovations for coloured: it may hide an orbit.
bool IsColoured(const Search& search, const std::vector<Record>& records, const Gains& gains,
                const Point& point) {
  const auto runs = search.Run(records, gains, point);
  return TakesAway(search.WhitenerOf(runs, kWhiteningOrder), search.WhitenerOf(runs, 0), kLoud);
}

bool IsBetter(const Refiner& refiner, const Refined& fit, const Refined& than) {
  return fit.ok && (!than.ok || refiner.Misfit(fit.point, kWhiteningOrder) <
                                    refiner.Misfit(than.point, kWhiteningOrder));
}

/// From the nominal rig: a fast observer on a few rows, then the one of `gains`. Where that ends
/// with what a filter takes for colour, also without the fast one; what fits better stays. A filter
/// that hides an orbit leaves more than it claims, and Misfit counts that.
Point FromFar(const RigView& rig, const Search& search, const std::vector<Term>& terms,
              const std::vector<Record>& few, const std::vector<Record>& records,
              const Gains& gains) {
  const Gains fast = search.DesignGains(few, kFast);
  const Point file = search.HealthyPoint();
  const Refined coarse =
      Refiner(search, terms, few, fast, rig.axes).Approach(file, kWhiteningOrder, 3);
  const Refiner refiner(search, terms, records, gains, rig.axes);
  const Refined fine =
      refiner.Approach(coarse.ok ? coarse.point : file, kWhiteningOrder, kStartPasses);
  if (fine.ok && !IsColoured(search, records, gains, fine.point)) return fine.point;
  const Refined direct = refiner.Approach(file, kWhiteningOrder, kStartPasses);
  if (IsBetter(refiner, direct, fine)) return direct.point;
  return fine.ok ? fine.point : file;
}

/// The records of a rotor that stands; none where all do, or none does.
std::vector<Record> AtRest(const std::vector<Record>& records) {
  constexpr double kTurnsRadPerS = 1.0;
  std::vector<Record> resting;
  for (const Record& record : records)
    if (std::abs(record.mean_speed_rad_per_s) < kTurnsRadPerS) resting.push_back(record);
  if (resting.size() == records.size()) resting.clear();
  return resting;
}

/// Whether a calibration ended so far from the records that it may have lost its way.
bool IsLost(const RigView& rig, const Search& search, const std::vector<Record>& records,
            const Gains& gains, const Refined& fit) {
  constexpr double kFar = 100.0;  // standard deviations of the worst band
  return !fit.ok || !(AnalyseResidual(rig, search.Run(records, gains, fit.point)).sigma < kFar);
}

/// The better of the fit and of one that begins at another frequency of a mode, if there is one.
Refined OrFromOtherFrequencies(const Search& search, const std::vector<Term>& terms,
                               const std::vector<Record>& few, const ObserverSpeed& speed,
                               const Refiner& refiner, int passes, Refined fit) {
  if (!fit.ok) return fit;
  std::optional<Gains> gains;  // of which hardly a calibration has need
  const auto cost = [&](const Point& at) {
    if (!gains) gains = search.DesignGains(few, speed);
    return Refiner(search, terms, few, *gains, search.rig().axes).Misfit(at, kWhiteningOrder);
  };
  const Point start = AlongFrequencies(terms, cost, fit.point);
  if (start == fit.point) return fit;
  Refined again = refiner.Approach(start, kWhiteningOrder, passes);
  return IsBetter(refiner, again, fit) ? again : fit;
}

}  // namespace

std::vector<Term> HeldToFile(std::vector<Term> terms) {
  using effect::Id;
  constexpr std::array kState{Id::kUnbalance, Id::kStaticLoad, Id::kSensorOffset,
                              Id::kSensorRunout};
  for (Term& term : terms) {
    const bool of_state =
        std::any_of(kState.begin(), kState.end(), [&term](Id id) { return term.effect == id; });
    if (!of_state) term.tolerance *= kHeld;
  }
  return terms;
}

Search SearchHeldBy(const std::vector<Term>& held, const Search& search) {
  Search made(search.rig(), held, std::nullopt, search.model_error_share());
  made.StopWhen(search.stop());
  return made;
}

Refined CalibrateNuisances(const RigView& rig, const Search& search, const std::vector<Term>& terms,
                           const std::vector<Record>& all, const std::vector<Record>& records,
                           const Gains& gains, const ObserverSpeed& speed, int passes) {
  const std::vector<Term> held = HeldToFile(terms);
  const Search cautious = SearchHeldBy(held, search);
  const std::vector<Record> few = Spans(all, kFastRows, rig.period_s);
  const std::vector<Record> part = Spans(all, kStartRows, rig.period_s);
  const Point start = FromFar(rig, cautious, held, few, part, cautious.DesignGains(part, speed));
  const Refiner refiner(search, terms, records, gains, rig.axes);
  Refined best = OrFromOtherFrequencies(search, terms, few, speed, refiner, passes,
                                        refiner.Approach(start, kWhiteningOrder, passes));
  const std::vector<Record> resting = AtRest(all);
  if (resting.empty() || !IsLost(rig, search, records, gains, best)) return best;
  const std::vector<Record> resting_part = Spans(resting, kStartRows, rig.period_s);
  const Point other = FromFar(rig, cautious, held, Spans(resting, kFastRows, rig.period_s),
                              resting_part, cautious.DesignGains(resting_part, speed));
  // As far as a part of all records shows: a start that is no better there is not worth all rows.
  const Gains part_gains = search.DesignGains(part, speed);
  const Refiner partly(search, terms, part, part_gains, rig.axes);
  const Refined begun = partly.Approach(other, kWhiteningOrder, kSecondPasses);
  if (!IsBetter(partly, begun, best)) return best;
  Refined again = refiner.Approach(begun.point, kWhiteningOrder, passes);
  return IsBetter(refiner, again, best) ? again : best;
}

std::vector<Term> LearnFromHealthy(const RigView& rig, const std::vector<Record>& healthy,
                                   const Judging& judging, const std::vector<Term>& terms) {
  const Search search(rig, terms, std::nullopt, judging.model_error_share);
  const std::vector<Record> records = Spans(healthy, kHealthyRows, rig.period_s);
  constexpr int kPasses = 8;
  const Refined fit = CalibrateNuisances(rig, search, terms, healthy, records,
                                         search.DesignGains(records, kSlow), kSlow, kPasses);
  if (!fit.ok) throw BadInput("the healthy records cannot be calibrated: is it the same rig?");
  const Fit posterior = Evidence(fit.problem, terms, {}).Solve();
  std::vector<Term> narrowed = terms;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    Term& term = narrowed[i];
    if (!term.nuisance()) continue;
    const double left = posterior.deviation[static_cast<Eigen::Index>(i)] * term.scale();
    term.healthy_mean = fit.point.theta[i];
    term.tolerance = std::min(term.tolerance, std::hypot(left, kDaily * term.tolerance));
  }
  return narrowed;
}

}  // namespace levitas::diagnosis
