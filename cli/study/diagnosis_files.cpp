#include "cli/study/diagnosis_files.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/diagnosis_report.hpp"
#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "diagnosis/report/calibrated_rig.hpp"
#include "diagnosis/report/excitation_coverage.hpp"
#include "diagnosis/report/extended_rig.hpp"
#include "diagnosis/report/input_warnings.hpp"
#include "diagnosis/report/words.hpp"

namespace levitas::cli {

using diagnosis::DiagnosisResult;
using diagnosis::Verdict;

namespace {

nlohmann::ordered_json ParametersJson(const DiagnosisResult& s) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& p : diagnosis::Parameters(s)) {
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

nlohmann::ordered_json CalibratedJson(const DiagnosisResult& s) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& v : diagnosis::CalibratedValues(s)) {
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

}  // namespace

nlohmann::ordered_json DiagnosisJson(const DiagnosisResult& s) {
  nlohmann::ordered_json json;
  const auto& a = s.answer;
  json["verdict"] = a.verdict == Verdict::kEffect    ? "effect"
                    : a.verdict == Verdict::kUnknown ? "unknown"
                                                     : "none";
  json["cause"] = nullptr;
  if (!a.causes.empty()) json["cause"] = a.causes.front().effect;
  json["also_possible"] = a.also_possible;
  json["all_causes"] = nlohmann::ordered_json::array();
  for (const auto& cause : a.causes) json["all_causes"].push_back(cause.effect);
  json["confidence"] = diagnosis::Confidence(s);
  json["place"] = diagnosis::PlaceOf(s);
  json["channels"] = diagnosis::Channels(s);
  json["parameters"] = ParametersJson(s);
  json["calibrated"] = CalibratedJson(s);
  json["fit_percent"] = {{"before", s.fitted.nominal_percent},
                         {"calibrated", s.fitted.calibrated_percent},
                         {"after", s.fitted.extended_percent},
                         {"holdout_before", s.validation.nominal_percent},
                         {"holdout_calibrated", s.validation.calibrated_percent},
                         {"holdout_after", s.validation.extended_percent},
                         {"ceiling", s.validation.ceiling_percent}};
  const auto share = [](const diagnosis::Share& g) {
    return nlohmann::ordered_json{{"fraction", g.value}, {"low", g.low}, {"high", g.high}};
  };
  json["achievable_gain"] = share(s.validation.achieved);
  json["achievable_gain"]["beyond_calibration"] = s.validation.beyond_calibration.value;
  json["achievable_gain"]["meaningful"] = diagnosis::SomethingToGain(s.validation);
  for (std::size_t i = 0; i < s.validation.channel.size(); ++i) {
    json["achievable_gain"]["channels"][s.view->numbers.channels[i]] =
        share(s.validation.channel[i]);
  }
  json["residual"] = {{"frequency_hz", a.remainder.frequency_hz},
                      {"order", a.remainder.order},
                      {"coherent_with", a.remainder.coherent_with},
                      {"channel", s.view->numbers.channels[a.remainder.worst_channel]},
                      {"sigma", a.remainder.sigma},
                      {"explained", a.explained}};
  json["cannot_tell"] = {{"sentence", diagnosis::UnobservableSentence(s)},
                         {"effects", diagnosis::UnobservableEffects(s)},
                         {"record_next", diagnosis::MissingRecords(s)}};
  json["doubt"] = diagnosis::DoubtSentence(s);
  json["healthy_records"] = diagnosis::HealthySentence(s);
  json["next_experiment"] = diagnosis::NextExperiment(s);
  json["candidates"] = nlohmann::ordered_json::array();
  for (const auto& c : a.candidates) {
    nlohmann::ordered_json entry{{"effect", c.effect}, {"where", c.place}, {"score", nullptr}};
    if (std::isfinite(c.score)) entry["score"] = c.score;
    entry["refitted"] = c.refitted;
    json["candidates"].push_back(entry);
  }
  return json;
}

std::vector<std::string> WriteDiagnosis(const DiagnosisResult& answer, const config::RigFile& rig,
                                        const std::string& folder) {
  std::vector<std::string> paths{folder + "/diagnosis.json", folder + "/extended_rig.yaml",
                                 folder + "/calibrated_rig.yaml", folder + "/report.html"};
  WriteJsonFile(paths[0], DiagnosisJson(answer));
  WriteTextFile(paths[1], diagnosis::ExtendedRig(answer, rig));
  WriteTextFile(paths[2], diagnosis::CalibratedRig(answer, rig));
  WriteTextFile(paths[3], DiagnosisPage(answer));
  return paths;
}

}  // namespace levitas::cli
