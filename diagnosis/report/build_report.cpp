#include "diagnosis/report/build_report.hpp"

#include "common/rotational_speed.hpp"
#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/report/affected_part.hpp"
#include "diagnosis/report/calibrated_rig.hpp"
#include "diagnosis/report/drawn_rotor.hpp"
#include "diagnosis/report/excitation_coverage.hpp"
#include "diagnosis/report/extended_rig.hpp"
#include "diagnosis/report/input_warnings.hpp"
#include "diagnosis/report/levitation.hpp"
#include "diagnosis/report/named_values.hpp"
#include "diagnosis/report/report_text.hpp"
#include "diagnosis/report/validation_check.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// From here on effects go by name: the report is that of a levitator, too, whose effects the
/// catalogue lacks.
std::string NameOf(effect::Id id) { return std::string(effect::At(id).name); }

ReportShare ShareOf(const Share& share) { return {share.value, share.low, share.high}; }

ReportFit FitOf(const Gain& gain, const std::vector<std::string>& channels) {
  ReportFit fit;
  fit.nominal_percent = gain.nominal_percent;
  fit.calibrated_percent = gain.calibrated_percent;
  fit.extended_percent = gain.extended_percent;
  fit.ceiling_percent = gain.ceiling_percent;
  fit.nominal_over_noise = 1.0 + gain.to_gain.value;
  fit.calibrated_over_noise = gain.calibrated_over_noise;
  fit.extended_over_noise = gain.extended_over_noise;
  fit.achieved = ShareOf(gain.achieved);
  fit.beyond_calibration = gain.beyond_calibration.value;
  fit.meaningful = SomethingToGain(gain);
  fit.calibration_is_complete = gain.calibrated_over_noise < 1.0 + kLeastToGain;
  for (std::size_t i = 0; i < gain.channel.size(); ++i) {
    const auto at = [i](const std::vector<double>& percent) {
      return i < percent.size() ? percent[i] : 0.0;
    };
    fit.channels.push_back({channels[i], at(gain.channel_nominal_percent),
                            at(gain.channel_extended_percent), ShareOf(gain.channel[i])});
  }
  return fit;
}

ReportForeseen Foreseen(const Interval& interval, double measured, double unit) {
  return {unit * interval.low, unit * interval.high, unit * measured, interval.Covers(measured)};
}

ReportForecast ForecastOf(const Forecast& forecast) {
  constexpr double kMicrometres = 1e6;
  ReportForecast out;
  out.fit_percent = Foreseen(forecast.fit_percent, forecast.fit_measured_percent, 1.0);
  out.residual_um = Foreseen(forecast.residual_m, forecast.residual_measured_m, kMicrometres);
  out.better_than_file = forecast.better_than_file;
  for (const ForecastBand& band : forecast.by_speed) {
    out.by_speed.push_back({RadPerSToRpm(band.from_rad_per_s), RadPerSToRpm(band.to_rad_per_s),
                            Foreseen(band.fit_percent, band.fit_measured_percent, 1.0),
                            Foreseen(band.residual_m, band.residual_measured_m, kMicrometres)});
  }
  return out;
}

ReportResidual ResidualOf(const DiagnosisResult& result) {
  const Residual& residual = result.answer.residual;
  return {.frequency_hz = residual.frequency_hz,
          .order = residual.order,
          .coherent_with = residual.coherent_with,
          .channel = result.view->numbers.channels[residual.worst_channel],
          .sigma = residual.sigma,
          .explained = result.answer.explained};
}

ReportCoverage CoverageFor(const DiagnosisResult& result) {
  const Coverage coverage = CoverageOf(result);
  return {.turns = coverage.turns,
          .excited = coverage.excited,
          .sentence = UnobservableSentence(result),
          .effects = effect::NamesOf(UnobservableEffects(result)),
          .missing_records = MissingRecords(result)};
}

void AddFound(const SearchResult& found, DiagnosisReport& report) {
  report.verdict = found.verdict;
  report.doubt = found.doubt;
  report.stopped = found.stopped;
  report.probability = found.probability;
  for (const Hypothesis& cause : found.causes) {
    report.causes.push_back({NameOf(cause.effect), cause.place});
  }
  report.also_possible = effect::NamesOf(found.also_possible);
  report.evidence_nat = found.evidence;
  for (const Candidate& c : found.candidates) {
    report.candidates.push_back({.effect = NameOf(c.effect),
                                 .place = c.place,
                                 .evidence_nat = c.score,
                                 .refitted = c.refitted,
                                 .reason = {},
                                 .validation_nat = c.validation_nat});
  }
}

void AddFits(const DiagnosisResult& result, DiagnosisReport& report) {
  report.fitted = FitOf(result.fitted, report.rig_channels);
  report.validation = FitOf(result.validation, report.rig_channels);
  for (const ErrorShare& share : result.error_shares) {
    report.error_shares.push_back(
        {share.effect ? NameOf(*share.effect) : "", share.place, share.share});
  }
  if (result.forecast) report.forecast = ForecastOf(*result.forecast);
  report.separate_validation = result.separate_validation;
  report.validation_is_faster =
      IsFaster(result.validation_fastest_rad_per_s, result.fastest_rad_per_s);
  report.residual = ResidualOf(result);
  report.spectra = {.channel = report.rig_channels[result.shown_channel],
                    .line_spacing_hz = result.line_spacing_hz,
                    .nominal = result.ratio_before,
                    .calibrated = result.ratio_calibrated,
                    .extended = result.ratio_after};
  report.seconds_of_data = result.seconds_of_data;
  report.record_errors = result.record_errors;
  report.seconds_used = result.seconds_used;
}

void AddWarnings(const DiagnosisResult& result, DiagnosisReport& report) {
  report.input_warning = InputWarning(report);
  if (result.file_tolerance.empty()) return;  // without healthy records
  report.healthy_sentence = HealthySentence(report.calibrated);
  report.changed_since_healthy = !ChangedSince(report.calibrated).empty();
}

}  // namespace

DiagnosisReport BuildReport(const DiagnosisResult& result) {
  DiagnosisReport report;
  report.rig_name = result.view->numbers.name;
  report.rig_channels = result.view->numbers.channels;
  AddFound(result.answer, report);
  AddFits(result, report);
  report.place = PlaceOf(result);
  report.channels = Channels(result);
  report.parameters = Parameters(result);
  report.calibrated = CalibratedValues(result);
  report.taken_by_causes = TakenByCauses(result);
  report.scale = ScaleOf(result);
  report.rotor = RotorOf(result);
  report.marks = MarksOf(result, report.parameters);
  report.coverage = CoverageFor(result);
  AddWarnings(result, report);
  const std::string experiment = SeparatingExperiment(report);
  report.needs_experiment = experiment != kNoneNeeded;
  report.next_experiment = NextExperiment(report, experiment);
  CompleteReport(report);
  return report;
}

DiagnosisReport BuildReport(const DiagnosisResult& result, const configuration::RigFile& rig) {
  DiagnosisReport report = BuildReport(result);
  report.extended_rig = ExtendedRig(result, rig);
  report.calibrated_rig = CalibratedRig(result, rig);
  JudgeLevitation(rig, result.known_laws, report);
  return report;
}

}  // namespace levitas::diagnosis
