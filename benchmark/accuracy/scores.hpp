#pragma once
// Scores of a diagnosis on Monte-Carlo trials: right, partly, false alarms, confusion, parameters.
//
// Right      the first cause is the main effect, or the main effect is among those declared
//            inseparable from it.
// Available  evidence in the records for the hidden effect, from the final ranking. The drawn size
//            says little about it: some effects are smaller than the tolerances of similar
//            parameters.
// Informed   a diagnosis that is given the hidden effect. It has failed if it does not name the
//            effect although the records hold it (available_evidence.hpp). The available evidence
//            is then unknown, and the trial counts as not named in the size that was drawn.
// Partly     any effect really present is named, but not as first.
// Thread     any; pure.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/report/diagnosis_report.hpp"

namespace levitas::accuracy {

/// One trial's outcome, as one row of the bench.
struct TrialScore {
  std::uint64_t seed{};
  std::vector<effect::Id> truth;    ///< empty: nothing hidden
  std::vector<effect::Id> in_file;  ///< what the diagnosis's rig file holds
  std::string outside;              ///< empty: nothing outside the vocabulary
  double drawn{};                   ///< size relative to what is drawn as clear
  std::string verdict;              ///< "none", "effect", "suspected", "unknown"
  std::vector<effect::Id> named;    ///< all causes, in order
  std::vector<effect::Id> ties;
  double score_nat{};
  double available_nat{};   ///< evidence for the main effect, as far as a fit found it
  double record_nat{-1.0};  ///< AvailableEvidence; -1 = not computed, or none
  bool informed_failed{};   ///< `available_nat` says nothing
  double explained{};       ///< share of the calibrated model's excess
  double remainder_sigma{};
  std::vector<std::string> nearest;  ///< candidates in words, best first
  double achieved{};                 ///< fraction of the achievable gain, on validation data
  double parameter_error{-1.0};      ///< of the main parameter: share of it; -1 = not comparable
  double parameter_sigmas{-1.0};
  double seconds{};
  /// Of several effects, those not named, with their evidence in the records given the others.
  std::vector<std::pair<effect::Id, std::optional<double>>> missed;

  [[nodiscard]] Size size() const noexcept {
    if (!informed_failed) return SizeOf(available_nat);
    return record_nat < 0.0 ? SizeDrawn(drawn) : SizeOf(record_nat);
  }
  [[nodiscard]] bool Right() const;
  [[nodiscard]] bool Partly() const;
  [[nodiscard]] bool Names(effect::Id effect) const;  ///< at any rank, or as a tie
  [[nodiscard]] bool NamesMain() const;
  [[nodiscard]] bool NamesAll() const;
  /// Of several, whether records that can be read hold every one clearly. What was named is.
  [[nodiscard]] bool HoldsAllClearly() const;
};

[[nodiscard]] TrialScore Judge(const TrialPlan& plan, const GroundTruth& ground_truth,
                               const diagnosis::DiagnosisReport& report);

/// Above this evidence a missed effect counts as an error even if the informed diagnosis missed it
/// too (twice kDecisive: a fit also pays an Occam factor).
inline constexpr double kAvailableFrom = 2.0 * diagnosis::kDecisive;

/// Updates the outcome with the result of the informed diagnosis. `held` is that of
/// AvailableEvidence; without it, the informed diagnosis counts as failed when it leaves an
/// unexplained residual.
void AddInformedDiagnosis(const diagnosis::DiagnosisReport& informed, std::optional<double> held,
                          TrialScore& outcome);

/// Tables for people, of all outcomes.
[[nodiscard]] std::string Tables(const std::vector<TrialScore>& outcomes);
/// The confusion matrix as a Markdown table: truth by row, first cause by column.
[[nodiscard]] std::string ConfusionTable(const std::vector<TrialScore>& outcomes);

}  // namespace levitas::accuracy
