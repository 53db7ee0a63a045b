#include "diagnosis/report/build_report.hpp"

#include "diagnosis/report/diagnose_files.hpp"
#include "diagnosis/report/excitation_coverage.hpp"
#include "diagnosis/report/input_warnings.hpp"
#include "diagnosis/report/words.hpp"

namespace levitas::diagnosis {
namespace {

ReportFit FitOf(const Gain& gain) {
  return {gain.nominal_percent, gain.calibrated_percent, gain.extended_percent,
          gain.ceiling_percent};
}

ReportShare ShareOf(const Share& share) { return {share.value, share.low, share.high}; }

ReportGain GainOf(const DiagnosisResult& result) {
  const Gain& gain = result.validation;
  ReportGain out;
  out.achieved = ShareOf(gain.achieved);
  out.beyond_calibration = gain.beyond_calibration.value;
  out.meaningful = SomethingToGain(gain);
  for (std::size_t i = 0; i < gain.channel.size(); ++i) {
    out.channels.push_back({result.view->numbers.channels[i], ShareOf(gain.channel[i])});
  }
  return out;
}

ReportResidual ResidualOf(const DiagnosisResult& result) {
  const Residual& residual = result.answer.remainder;
  return {.frequency_hz = residual.frequency_hz,
          .order = residual.order,
          .coherent_with = residual.coherent_with,
          .channel = result.view->numbers.channels[residual.worst_channel],
          .sigma = residual.sigma,
          .explained = result.answer.explained};
}

}  // namespace

DiagnosisReport BuildReport(const DiagnosisResult& result) {
  return BuildReport(result, PlaceOf(result));
}

DiagnosisReport BuildReport(const DiagnosisResult& result, const std::string& place) {
  const SearchResult& found = result.answer;
  DiagnosisReport report;
  report.verdict = found.verdict;
  for (const Hypothesis& cause : found.causes) report.causes.push_back({cause.effect, cause.place});
  report.also_possible = found.also_possible;
  report.confidence = Confidence(result);
  report.place = place;
  report.channels = Channels(result);
  report.parameters = Parameters(result);
  report.calibrated = CalibratedValues(result);
  report.fitted = FitOf(result.fitted);
  report.validation = FitOf(result.validation);
  report.gain = GainOf(result);
  report.residual = ResidualOf(result);
  report.coverage = {UnobservableSentence(result), UnobservableEffects(result),
                     MissingRecords(result)};
  report.input_warning = DoubtSentence(result);
  report.healthy_sentence = HealthySentence(result);
  report.next_experiment = NextExperiment(result);
  for (const Candidate& c : found.candidates) {
    report.candidates.push_back({c.effect, c.place, c.score, c.refitted});
  }
  return report;
}

}  // namespace levitas::diagnosis
