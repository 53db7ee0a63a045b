#include "cli/diagnosis_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/diagnosis_report.hpp"
#include "cli/json_file.hpp"
#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "diagnosis/extended_rig.hpp"
#include "diagnosis/words.hpp"

namespace levitas::cli {

using diagnosis::SessionAnswer;
using diagnosis::Verdict;

void PrintDiagnosis(const SessionAnswer& s) {
  fmt::print("{}\n\n", diagnosis::VerdictSentence(s));
  for (const auto& p : diagnosis::Parameters(s)) {
    fmt::print("  {} {}: {:.5g} {} ({:.5g} to {:.5g})\n", p.effect, p.name, p.value, p.unit, p.low,
               p.high);
  }
  const auto& fit = s.fitted;
  const auto& held = s.held_out;
  fmt::print(
      "\nFit of the one-step prediction, percent: nominal {:.2f}, calibrated {:.2f}, extended "
      "{:.2f}, ceiling {:.2f}\nOn data not used: nominal {:.2f}, calibrated {:.2f}, extended "
      "{:.2f}, "
      "ceiling {:.2f}\n",
      fit.nominal_percent, fit.calibrated_percent, fit.extended_percent, fit.ceiling_percent,
      held.nominal_percent, held.calibrated_percent, held.extended_percent, held.ceiling_percent);
  fmt::print(
      "Of what could be gained there: {:.3f} ({:.3f} to {:.3f}); beyond calibration {:.3f}\n",
      held.achieved.value, held.achieved.low, held.achieved.high, held.beyond_calibration.value);
  fmt::print("\n{:<26}{:<36}{:>10}\n", "effect", "where", "nat");
  for (std::size_t i = 0; i < std::min<std::size_t>(8, s.answer.candidates.size()); ++i) {
    const auto& c = s.answer.candidates[i];
    fmt::print("{:<26}{:<36}{:>10.1f}{}\n", c.effect, c.place, c.score,
               c.refitted ? "" : "  (screen)");
  }
  fmt::print("\nNext: {}\n", diagnosis::NextExperiment(s));
}

nlohmann::ordered_json DiagnosisJson(const SessionAnswer& s) {
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
  json["parameters"] = nlohmann::ordered_json::object();
  for (const auto& p : diagnosis::Parameters(s)) {
    json["parameters"][p.name] = {{"value", p.value},
                                  {"low", p.low},
                                  {"high", p.high},
                                  {"unit", p.unit},
                                  {"effect", p.effect}};
  }
  json["fit_percent"] = {{"before", s.fitted.nominal_percent},
                         {"calibrated", s.fitted.calibrated_percent},
                         {"after", s.fitted.extended_percent},
                         {"holdout_before", s.held_out.nominal_percent},
                         {"holdout_calibrated", s.held_out.calibrated_percent},
                         {"holdout_after", s.held_out.extended_percent},
                         {"ceiling", s.held_out.ceiling_percent}};
  const auto share = [](const diagnosis::Share& g) {
    return nlohmann::ordered_json{{"fraction", g.value}, {"low", g.low}, {"high", g.high}};
  };
  json["achievable_gain"] = share(s.held_out.achieved);
  json["achievable_gain"]["beyond_calibration"] = s.held_out.beyond_calibration.value;
  for (std::size_t i = 0; i < s.held_out.channel.size(); ++i) {
    json["achievable_gain"]["channels"][s.view->numbers.channels[i]] = share(s.held_out.channel[i]);
  }
  json["residual"] = {{"frequency_hz", a.remainder.frequency_hz},
                      {"order", a.remainder.order},
                      {"coherent_with", a.remainder.coherent_with},
                      {"channel", s.view->numbers.channels[a.remainder.worst_channel]},
                      {"sigma", a.remainder.sigma},
                      {"explained", a.explained}};
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

void WriteDiagnosis(const SessionAnswer& answer, const config::RigFile& rig,
                    const std::string& folder) {
  WriteJsonFile(folder + "/diagnosis.json", DiagnosisJson(answer));
  WriteTextFile(folder + "/extended_rig.yaml", diagnosis::ExtendedRig(answer, rig));
  WriteTextFile(folder + "/report.html", DiagnosisPage(answer));
}

}  // namespace levitas::cli
