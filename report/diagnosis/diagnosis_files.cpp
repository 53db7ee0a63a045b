#include "report/diagnosis/diagnosis_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/output_file.hpp"
#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/report_text.hpp"
#include "report/diagnosis/diagnosis_page.hpp"
#include "report/diagnosis/old_keys.hpp"

namespace levitas::report {

using diagnosis::DiagnosisReport;

namespace {

const char* BracketWord(const diagnosis::NamedParameter& p) {
  if (p.low == p.high) return "none";
  return p.form ? "neighbouring forms" : "5 to 95 %";
}

nlohmann::ordered_json ParametersJson(const DiagnosisReport& report) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& p : report.parameters) {
    json[p.name] = {{"value", p.value},   {"low", p.low},
                    {"high", p.high},     {"unit", p.unit},
                    {"effect", p.effect}, {"where", p.location.name},
                    {"key", p.key},       {"bracket", BracketWord(p)}};
    if (!p.of_file) continue;
    json[p.name]["of_file"] = p.of_file->nominal;
    json[p.name]["with_file"] = p.of_file->total;
  }
  return json;
}

nlohmann::ordered_json CalibratedJson(const DiagnosisReport& report) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& v : report.calibrated) {
    nlohmann::ordered_json entry{{"effect", v.effect},
                                 {"where", v.place},
                                 {"key", v.key},
                                 {"unit", v.unit},
                                 {"nominal", v.nominal},
                                 {"calibrated", v.calibrated},
                                 {"std", v.deviation},
                                 {"tolerance", v.tolerance},
                                 {"expected", v.expected},
                                 {"moved_tolerances", v.moved},
                                 {"file_tolerances", v.from_file},
                                 {"moved_deviations", v.proven}};
    if (v.nominal_phase_rad) entry["nominal_phase_rad"] = *v.nominal_phase_rad;
    if (v.phase_rad) entry["phase_rad"] = *v.phase_rad;
    json.push_back(entry);
  }
  return json;
}

nlohmann::ordered_json FitJson(const DiagnosisReport& report) {
  const diagnosis::ReportFit& validation = report.validation;
  return {{"before", report.fitted.nominal_percent},
          {"calibrated", report.fitted.calibrated_percent},
          {"after", report.fitted.extended_percent},
          {"validation_before", validation.nominal_percent},
          {"validation_calibrated", validation.calibrated_percent},
          {"validation_after", validation.extended_percent},
          {"ceiling", validation.ceiling_percent}};
}

/// JSON has no infinity.
nlohmann::ordered_json Finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json ShareJson(const diagnosis::ReportShare& share) {
  return {{"fraction", share.fraction}, {"low", share.low}, {"high", share.high}};
}

nlohmann::ordered_json GainJson(const diagnosis::ReportFit& gain) {
  nlohmann::ordered_json json = ShareJson(gain.achieved);
  json["beyond_calibration"] = gain.beyond_calibration;
  json["meaningful"] = gain.meaningful;
  for (const auto& channel : gain.channels) {
    json["channels"][channel.name] = ShareJson(channel.achieved);
  }
  return json;
}

nlohmann::ordered_json CandidatesJson(const DiagnosisReport& report) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& c : report.candidates) {
    nlohmann::ordered_json entry{{"effect", c.effect}, {"where", c.place}, {"score", nullptr}};
    if (std::isfinite(c.evidence_nat)) entry["score"] = c.evidence_nat;
    entry["refitted"] = c.refitted;
    entry["reason"] = c.reason;
    if (c.validation_nat) entry["validation_nat"] = *c.validation_nat;
    json.push_back(entry);
  }
  return json;
}

nlohmann::ordered_json RunFitJson(const diagnosis::ReportRunFit& fit) {
  return {{"before", fit.nominal.value},     {"calibrated", fit.calibrated.value},
          {"after", fit.extended.value},     {"after_low", fit.extended.low},
          {"after_high", fit.extended.high}, {"ceiling", fit.ceiling_percent}};
}

nlohmann::ordered_json RunsJson(const std::vector<diagnosis::ReportRun>& runs) {
  auto json = nlohmann::ordered_json::array();
  for (const diagnosis::ReportRun& run : runs) {
    nlohmann::ordered_json entry{{"run", run.name}};
    if (run.current) entry["current_percent"] = RunFitJson(*run.current);
    if (run.lower_current) entry["lower_current_percent"] = RunFitJson(*run.lower_current);
    entry["motion_percent"] = RunFitJson(run.motion);
    json.push_back(entry);
  }
  return json;
}

nlohmann::ordered_json ErrorSharesJson(const std::vector<diagnosis::ReportErrorShare>& shares) {
  auto json = nlohmann::ordered_json::array();
  for (const diagnosis::ReportErrorShare& e : shares) {
    json.push_back({{"effect", e.effect.empty() ? "mode_shapes" : e.effect},
                    {"place", e.place},
                    {"calibrated", e.place.empty()},
                    {"share", e.fraction}});
  }
  return json;
}

/// Of a diagnosis that judges records one by one.
void AddRuns(const DiagnosisReport& report, nlohmann::ordered_json& json) {
  json["ties"] = nlohmann::ordered_json::object();
  for (const diagnosis::ReportTie& tie : report.ties) json["ties"][tie.cause] = tie.others;
  json["runs_validation"] = RunsJson(report.validation_runs);
  json["runs_fitted"] = RunsJson(report.fitted_runs);
}

nlohmann::ordered_json RecordErrorsJson(const std::vector<diagnosis::RecordErrors>& found) {
  auto json = nlohmann::ordered_json::array();
  for (const diagnosis::RecordErrors& record : found) {
    for (const diagnosis::RecordError& error : record.errors) {
      json.push_back({{"record", record.record},
                      {"kind", diagnosis::Name(error.kind)},
                      {"channels", error.columns},
                      {"size", error.size},
                      {"times_better", error.statistic},
                      {"sentence", error.sentence},
                      {"mend", error.mend},
                      {"by_map", error.by_map}});
    }
  }
  return json;
}

nlohmann::ordered_json LoopJson(const diagnosis::ReportLoop& loop) {
  nlohmann::ordered_json json{{"levitates", nullptr}};
  if (loop.levitates) json["levitates"] = *loop.levitates;
  if (!loop.levitates.value_or(true)) json["speed_rpm"] = loop.rpm;
  if (!loop.why.empty()) json["why"] = loop.why;
  return json;
}

nlohmann::ordered_json LevitationJson(const diagnosis::ReportLevitations& s) {
  auto laws = nlohmann::ordered_json::array();
  for (const diagnosis::ReportLevitation& of : s.by_law) {
    laws.push_back({{"law", of.law},
                    {"speed_rpm_from", of.from_rpm},
                    {"speed_rpm_to", of.to_rpm},
                    {"rig_file", LoopJson(of.rig_file)},
                    {"extended_rig", LoopJson(of.extended_rig)},
                    {"calibrated_rig", LoopJson(of.calibrated_rig)}});
  }
  return {{"laws", std::move(laws)},
          {"records_without_law", s.records_without_law},
          {"sentences", s.sentences}};
}

const char* SeverityWord(diagnosis::Severity severity) {
  switch (severity) {
    case diagnosis::Severity::kSlight:
      return "slight";
    case diagnosis::Severity::kMarked:
      return "marked";
    case diagnosis::Severity::kSevere:
      return "severe";
    case diagnosis::Severity::kNotSaid:
      break;
  }
  return "not said";
}

/// For who acts on it: what it is in words, how severe, what to do, where.
void AddAdvice(const DiagnosisReport& report, nlohmann::ordered_json& json) {
  json["headline"] = report.headline;
  json["certainty"] = report.certainty;
  json["undecided"] = report.undecided;
  json["odds_log10"] = nullptr;
  if (!report.causes.empty()) {
    json["odds_log10"] = Finite(diagnosis::OwnEvidence(report) * std::numbers::log10e);
  }
  json["severity"] = SeverityWord(report.severity);
  json["what_it_does"] = report.severity_sentence;
  json["action"] = report.action;
  auto causes = nlohmann::ordered_json::array();
  for (const auto& cause : report.causes) {
    causes.push_back({{"effect", cause.effect},
                      {"where", cause.place},
                      {"words", diagnosis::InWords(report, cause)}});
  }
  json["causes_in_words"] = std::move(causes);
  auto marks = nlohmann::ordered_json::array();
  for (const auto& mark : report.marks) {
    marks.push_back({{"effect", mark.text}, {"z_mm", 1e3 * mark.z_m}});
  }
  json["places_on_shaft"] = std::move(marks);
  json["healthy_proposal"] = report.healthy_proposal;
  json["healthy_record_found"] = report.healthy_record;
}

nlohmann::ordered_json OriginJson(const diagnosis::ReportOrigin& origin) {
  return {{"date_utc", origin.date_utc},
          {"program_version", origin.program_version},
          {"rig_file", origin.rig_file},
          {"records", origin.records},
          {"validation", origin.validation},
          {"healthy", origin.healthy},
          {"quick", origin.quick}};
}

}  // namespace

nlohmann::ordered_json ForecastJson(const diagnosis::ReportForecast& forecast) {
  const diagnosis::ReportForeseen& fit = forecast.fit_percent;
  auto bands = nlohmann::ordered_json::array();
  for (const diagnosis::ReportForecast::Band& band : forecast.by_speed) {
    bands.push_back({{"speed_rpm_from", band.from_rpm},
                     {"speed_rpm_to", band.to_rpm},
                     {"residual_um_low", Finite(band.residual_um.low)},
                     {"residual_um_high", Finite(band.residual_um.high)},
                     {"residual_um_measured", Finite(band.residual_um.measured)},
                     {"fit_percent_low", Finite(band.fit_percent.low)},
                     {"fit_percent_high", Finite(band.fit_percent.high)},
                     {"fit_percent_measured", Finite(band.fit_percent.measured)},
                     {"covered", band.residual_um.covered}});
  }
  return {{"fit_percent_low", Finite(fit.low)},
          {"fit_percent_high", Finite(fit.high)},
          {"fit_percent_measured", Finite(fit.measured)},
          {"covered", fit.covered},
          {"chance_better_than_file", forecast.better_than_file},
          {"by_speed", std::move(bands)}};
}

nlohmann::ordered_json DiagnosisJson(const DiagnosisReport& report) {
  nlohmann::ordered_json json;
  json["verdict"] = Word(report.verdict);
  json["stopped"] = report.stopped;
  json["cause"] = nullptr;
  if (!report.causes.empty()) json["cause"] = report.causes.front().effect;
  json["also_possible"] = report.also_possible;
  json["all_causes"] = nlohmann::ordered_json::array();
  for (const auto& cause : report.causes) json["all_causes"].push_back(cause.effect);
  json["confidence"] = report.confidence;
  json["suspected_because"] = report.suspected_because;
  json["outside_tolerance"] = report.outside_tolerance;
  json["place"] = report.place;
  json["channels"] = report.channels;
  json["parameters"] = ParametersJson(report);
  json["calibrated"] = CalibratedJson(report);
  json["fit_percent"] = FitJson(report);
  json["error_shares"] = ErrorSharesJson(report.error_shares);
  json["forecast"] = nullptr;
  if (report.forecast) json["forecast"] = ForecastJson(*report.forecast);
  json["levitation"] = LevitationJson(report.levitation);
  json["achievable_gain"] = GainJson(report.validation);
  json["residual"] = {{"frequency_hz", report.residual.frequency_hz},
                      {"order", report.residual.order},
                      {"coherent_with", report.residual.coherent_with},
                      {"channel", report.residual.channel},
                      {"sigma", report.residual.sigma},
                      {"explained", report.residual.explained}};
  json["cannot_tell"] = {{"sentence", report.coverage.sentence},
                         {"effects", report.coverage.effects},
                         {"record_next", report.coverage.missing_records}};
  json["record_errors"] = RecordErrorsJson(report.record_errors);
  json["doubt"] = report.input_warning;
  json["healthy_records"] = report.healthy_sentence;
  json["next_experiment"] = report.next_experiment;
  json["candidates"] = CandidatesJson(report);
  AddAdvice(report, json);
  json["origin"] = OriginJson(report.origin);
  if (!report.fitted_runs.empty()) AddRuns(report, json);
  AddOldKeys(json);
  return json;
}

std::vector<std::string> WriteDiagnosis(const DiagnosisReport& report, const std::string& folder) {
  std::vector<std::string> paths{folder + "/diagnosis.json", folder + "/extended_rig.yaml",
                                 folder + "/calibrated_rig.yaml", folder + "/report.html"};
  WriteWholeFile(paths[0], DiagnosisJson(report).dump(2) + '\n');
  WriteWholeFile(paths[1], report.extended_rig);
  WriteWholeFile(paths[2], report.calibrated_rig);
  WriteWholeFile(paths[3], DiagnosisPage(report));
  return paths;
}

}  // namespace levitas::report
