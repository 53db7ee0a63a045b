#include "diagnosis/inference/swallowed_cause.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
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

bool CalibrationWentFar(const RecordLandscape& landscape, const SelectionRules& rules,
                        const CauseSelection& found) {
  const Fit fit = landscape.EvidenceGiven({}).Solve();
  const std::vector<Term>& terms = landscape.terms();
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (terms[i].nuisance() &&
        SurelyAway(terms[i], fit, found.calibrated, i) > rules.judging.moved_tolerances)
      return true;
  }
  return false;
}

/// The records and the two ways to fit them: held to the file, and free within its tolerances.
class FitsFromFile {
 public:
  explicit FitsFromFile(const RecordLandscape& landscape)
      : landscape_(landscape),
        held_(HeldToFile(landscape.terms())),
        cautious_(landscape.rig(), held_, std::nullopt, landscape.search().model_error_share()),
        few_(Spans(landscape.records(), kFewRows, landscape.rig().period_s)),
        part_(Spans(landscape.records(), kJointRows, landscape.rig().period_s)),
        fast_(cautious_.DesignGains(few_, kFast)),
        gains_(cautious_.DesignGains(part_, kFast)),
        free_(landscape.search(), landscape.terms(), part_, gains_, landscape.rig().axes),
        at_file_(cautious_.Linearise(few_, fast_, cautious_.HealthyParameters(), kWhiteningOrder,
                                     cautious_.Everything())) {}

  /// Effects at their best places about the file's numbers, of those that are looked for.
  [[nodiscard]] std::vector<Candidate> Screened() const {
    return Screen(Evidence(at_file_.problem, held_, {}), landscape_.hypotheses());
  }

  /// theta with these causes; `ok` false where the model cannot follow.
  [[nodiscard]] Refined With(const std::vector<Hypothesis>& causes) const {
    const Refiner coarse(cautious_, held_, few_, fast_, landscape_.rig().axes);
    Refined nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<double>& start : Starts(causes)) {
      Refined fit = coarse.Approach(start, kWhiteningOrder, kHeldPasses, causes);
      if (!fit.ok) continue;
      const double misfit = coarse.Misfit(fit.theta, kWhiteningOrder, causes);
      if (!(misfit < least)) continue;
      least = misfit;
      nearest = std::move(fit);
    }
    if (!nearest.ok) return {};
    const Refined held = Refiner(cautious_, held_, part_, gains_, landscape_.rig().axes)
                             .Approach(nearest.theta, kWhiteningOrder, kHeldPasses, causes);
    return Free(held.ok ? held.theta : nearest.theta, causes);
  }

  [[nodiscard]] Refined Free(const std::vector<double>& start,
                             const std::vector<Hypothesis>& causes) const {
    if (start.empty()) return {};
    return free_.Approach(start, kWhiteningOrder, kFreePasses, causes);
  }

  /// [nat] of all that is not explained, and of all that was moved; smaller is better.
  [[nodiscard]] double Cost(const Refined& fit, const std::vector<Hypothesis>& causes) const {
    return free_.Misfit(fit.theta, kWhiteningOrder, causes);
  }

 private:
  /// The file's numbers; with the causes as the screen sees them; twice and four times as large: of
  /// what moves a lightly damped mode by more than its width a straight line sees too little.
  [[nodiscard]] std::vector<std::vector<double>> Starts(
      const std::vector<Hypothesis>& causes) const {
    const std::vector<double> seen = cautious_.Solve(at_file_.problem, causes);
    constexpr std::array kTimes{0.0, 1.0, 2.0, 4.0};
    std::vector<std::vector<double>> starts(kTimes.size(), cautious_.HealthyParameters());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!Moves(causes, i)) continue;
      const double healthy = starts[0][i];
      for (std::size_t k = 0; k < starts.size(); ++k) {
        starts[k][i] = healthy + kTimes[k] * (seen[i] - healthy);
      }
    }
    return starts;
  }

  const RecordLandscape& landscape_;
  std::vector<Term> held_;
  Search cautious_;
  std::vector<Record> few_, part_;
  Gains fast_, gains_;
  Refiner free_;
  View at_file_;
};

/// The cheapest of the first few, if it costs less than `most`.
std::pair<std::vector<Hypothesis>, Refined> CheapestBelow(double most, const FitsFromFile& fits,
                                                          const RecordLandscape& landscape,
                                                          const Judging& judging) {
  std::pair<std::vector<Hypothesis>, Refined> best;
  std::size_t tried = 0;
  for (const Candidate& candidate : fits.Screened()) {
    if (tried++ == kMostSwallowed || !(candidate.score > judging.decisive_nat)) break;
    landscape.ReportProgress(
        0.25, fmt::format("calibrating anew with {}", effect::At(candidate.effect).name));
    const std::vector<Hypothesis> cause{landscape.hypotheses()[candidate.hypothesis]};
    Refined fit = fits.With(cause);
    if (!fit.ok) continue;
    const double cost = fits.Cost(fit, cause);
    if (!(cost < most)) continue;
    most = cost;
    best = {cause, std::move(fit)};
  }
  return best;
}

}  // namespace

bool TakeSwallowedCause(RecordLandscape& landscape, const SelectionRules& rules,
                        CauseSelection& found) {
  if (rules.most_causes == 0 || !CalibrationWentFar(landscape, rules, found)) return false;
  const FitsFromFile fits(landscape);
  // On the same rows and with the same observer as the fits with a cause.
  const Refined without = fits.Free(found.calibrated, {});
  if (!without.ok) return false;
  const double margin = rules.judging.suspected_nat;
  const auto [causes, start] =
      CheapestBelow(fits.Cost(without, {}) - margin, fits, landscape, rules.judging);
  if (causes.empty()) return false;
  const std::size_t slow = landscape.speed();
  landscape.Observe(kSpeeds.size() - 1);
  landscape.LineariseAt(start.theta);
  const Refined fit = landscape.Fit(causes, start.theta, rules.effort.passes);
  if (!fit.ok ||
      !(landscape.MisfitOf(causes, fit.theta) < landscape.MisfitOf({}, without.theta) - margin)) {
    landscape.Observe(slow);
    landscape.LineariseAt(found.theta);
    return false;
  }
  found.causes = causes;
  found.theta = fit.theta;
  found.calibrated = without.theta;
  found.refitted.clear();  // weighed about the calibration that hid it
  landscape.LineariseAt(found.theta);
  return true;
}

}  // namespace levitas::diagnosis
