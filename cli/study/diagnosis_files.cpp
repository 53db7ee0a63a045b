#include "cli/study/diagnosis_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/diagnosis_report.hpp"
#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "diagnosis/report/calibrated_rig.hpp"
#include "diagnosis/report/extended_rig.hpp"

namespace levitas::cli {

using diagnosis::DiagnosisReport;
using diagnosis::DiagnosisResult;
using diagnosis::Verdict;

namespace {

const char* VerdictWord(Verdict verdict) {
  switch (verdict) {
    case Verdict::kEffect:
      return "effect";
    case Verdict::kUnknown:
      return "unknown";
    case Verdict::kNone:
      break;
  }
  return "none";
}

nlohmann::ordered_json ParametersJson(const DiagnosisReport& report) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& p : report.parameters) {
    json[p.name] = {{"value", p.value},   {"low", p.low},
                    {"high", p.high},     {"unit", p.unit},
                    {"effect", p.effect}, {"where", p.place},
                    {"key", p.key},       {"bracket", p.form ? "neighbouring forms" : "5 to 95 %"}};
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
  return {{"before", report.fitted.nominal_percent},
          {"calibrated", report.fitted.calibrated_percent},
          {"after", report.fitted.extended_percent},
          {"holdout_before", report.validation.nominal_percent},
          {"holdout_calibrated", report.validation.calibrated_percent},
          {"holdout_after", report.validation.extended_percent},
          {"ceiling", report.validation.ceiling_percent}};
}

nlohmann::ordered_json ShareJson(const diagnosis::ReportShare& share) {
  return {{"fraction", share.fraction}, {"low", share.low}, {"high", share.high}};
}

nlohmann::ordered_json GainJson(const diagnosis::ReportGain& gain) {
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
    json.push_back(entry);
  }
  return json;
}

}  // namespace

nlohmann::ordered_json DiagnosisJson(const DiagnosisReport& report) {
  nlohmann::ordered_json json;
  json["verdict"] = VerdictWord(report.verdict);
  json["cause"] = nullptr;
  if (!report.causes.empty()) json["cause"] = report.causes.front().effect;
  json["also_possible"] = report.also_possible;
  json["all_causes"] = nlohmann::ordered_json::array();
  for (const auto& cause : report.causes) json["all_causes"].push_back(cause.effect);
  json["confidence"] = report.confidence;
  json["place"] = report.place;
  json["channels"] = report.channels;
  json["parameters"] = ParametersJson(report);
  json["calibrated"] = CalibratedJson(report);
  json["fit_percent"] = FitJson(report);
  json["achievable_gain"] = GainJson(report.gain);
  json["residual"] = {{"frequency_hz", report.residual.frequency_hz},
                      {"order", report.residual.order},
                      {"coherent_with", report.residual.coherent_with},
                      {"channel", report.residual.channel},
                      {"sigma", report.residual.sigma},
                      {"explained", report.residual.explained}};
  json["cannot_tell"] = {{"sentence", report.coverage.sentence},
                         {"effects", report.coverage.effects},
                         {"record_next", report.coverage.missing_records}};
  json["doubt"] = report.input_warning;
  json["healthy_records"] = report.healthy_sentence;
  json["next_experiment"] = report.next_experiment;
  json["candidates"] = CandidatesJson(report);
  return json;
}

std::vector<std::string> WriteDiagnosis(const DiagnosisResult& answer,
                                        const DiagnosisReport& report, const config::RigFile& rig,
                                        const std::string& folder) {
  std::vector<std::string> paths{folder + "/diagnosis.json", folder + "/extended_rig.yaml",
                                 folder + "/calibrated_rig.yaml", folder + "/report.html"};
  WriteJsonFile(paths[0], DiagnosisJson(report));
  WriteTextFile(paths[1], diagnosis::ExtendedRig(answer, rig));
  WriteTextFile(paths[2], diagnosis::CalibratedRig(answer, rig));
  WriteTextFile(paths[3], DiagnosisPage(answer));
  return paths;
}

}  // namespace levitas::cli
