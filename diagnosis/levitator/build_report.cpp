#include "diagnosis/levitator/build_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/inference/judging.hpp"
#include "diagnosis/levitator/causes.hpp"
#include "diagnosis/levitator/plan.hpp"
#include "diagnosis/levitator/report_fits.hpp"
#include "diagnosis/levitator/report_values.hpp"
#include "diagnosis/levitator/words.hpp"
#include "diagnosis/report/affected_part.hpp"
#include "diagnosis/report/report_text.hpp"

namespace levitas::levitator {
namespace {

/// A candidate whose parameters include all of a named cause's is that cause with one more free
/// parameter, not a tie.
bool Contains(const Cause& cause, const Cause& named) {
  return std::all_of(named.moves.begin(), named.moves.end(), [&](std::size_t i) {
    return std::find(cause.moves.begin(), cause.moves.end(), i) != cause.moves.end();
  });
}

bool IsTie(const Found& found, const Score& score, std::size_t k) {
  if (score.named || !score.refitted || found.causes[k] != score.instead_of) return false;
  const double least = std::max(diagnosis::kDecisive, kFormOfTie * found.scores[k].nat);
  return score.behind_nat < least && !Contains(Causes()[score.cause], Causes()[found.causes[k]]);
}

/// A candidate stands in the place of the named cause it does most for.
std::string ReasonOf(const Score& score, const std::vector<diagnosis::ReportTie>& ties) {
  if (score.named || score.instead_of >= Causes().size()) return {};
  const std::string& effect = Causes()[score.cause].effect;
  const std::string& named = Causes()[score.instead_of].effect;
  const bool tied = std::any_of(ties.begin(), ties.end(), [&](const diagnosis::ReportTie& tie) {
    return tie.cause == named &&
           std::find(tie.others.begin(), tie.others.end(), effect) != tie.others.end();
  });
  return tied ? fmt::format("not separable from {}", named)
              : fmt::format("explains {:.0f} nat less than {} in its place", score.behind_nat,
                            named);
}

std::string PlaceOf(const Found& found, const diagnosis::DiagnosisReport& report) {
  if (!found.causes.empty()) {
    return std::string(Table()[Causes()[found.causes.front()].moves.front()].place);
  }
  if (report.verdict == diagnosis::Verdict::kNone) return "";
  return diagnosis::PlaceOfResidual(report.residual.coherent_with);
}

}  // namespace

void AddCauses(const Found& found, diagnosis::DiagnosisReport& report) {
  for (const std::size_t c : found.causes) {
    report.causes.push_back({Causes()[c].effect, Causes()[c].where});
    report.ties.push_back({Causes()[c].effect, {}});
  }
  for (const Score& score : found.scores) {
    for (std::size_t k = 0; k < found.causes.size(); ++k) {
      if (IsTie(found, score, k)) report.ties[k].others.push_back(Causes()[score.cause].effect);
    }
  }
  if (!report.ties.empty()) report.also_possible = report.ties.front().others;
  for (const Score& score : found.scores) {
    const Cause& cause = Causes()[score.cause];
    diagnosis::ReportCandidate& candidate = report.candidates.emplace_back();
    candidate.effect = cause.effect;
    candidate.place = cause.where;
    candidate.evidence_nat = score.nat;
    candidate.refitted = score.refitted;
    candidate.reason = ReasonOf(score, report.ties);
    if (std::isfinite(score.validation_nat)) candidate.validation_nat = score.validation_nat;
  }
  report.evidence_nat = found.evidence;
}

diagnosis::DiagnosisReport BuildReport(const configuration::RigFile& rig, const NominalRig& nominal,
                                       const std::vector<Series>& data,
                                       const LevitatorResult& result) {
  diagnosis::DiagnosisReport report;
  report.rig_name = rig.numbers.name;
  report.own_words = OwnWords();
  report.rig_channels = rig.numbers.channels;
  AddCauses(result.found, report);
  AddResidual(nominal, data, result.found, report);
  const std::string& channel = rig.numbers.channels.front();
  report.place = PlaceOf(result.found, report);
  if (report.verdict != diagnosis::Verdict::kNone) report.channels = {channel};
  report.parameters = ReportParameters(rig, nominal.origin, result.found);
  report.calibrated = ReportCalibration(rig, nominal.origin, result.found);
  for (const Series& series : data) {
    report.seconds_of_data += static_cast<double>(series.size()) * nominal.period_s;
  }
  report.seconds_used = report.seconds_of_data;
  const bool probes = data.front().has_currents();
  report.fitted = MeanFit(result.fitted, probes, channel);
  report.validation = MeanFit(result.validation, probes, channel);
  report.fitted_runs = ReportRuns(result.fitted);
  report.validation_runs = ReportRuns(result.validation);
  const std::vector<std::string> separations = Separations(report);
  report.needs_experiment = !separations.empty();
  report.next_experiment = report.needs_experiment ? fmt::format("{}", fmt::join(separations, "; "))
                                                   : diagnosis::kNoneNeeded;
  diagnosis::CompleteReport(report);
  report.extended_rig = ExtendedRig(rig, nominal.origin, result.found);
  report.calibrated_rig = CalibratedRig(rig, nominal.origin, result.found);
  return report;
}

}  // namespace levitas::levitator
