#include "cli/study/levitator_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/diagnosis_files.hpp"
#include "cli/study/diagnosis_report.hpp"
#include "cli/study/diagnosis_text.hpp"
#include "cli/text_file.hpp"
#include "diagnosis/levitator/build_report.hpp"

namespace levitas::cli {
namespace {

using levitator::Fit;
using levitator::LevitatorResult;
using levitator::ValidationRun;

std::string Interval(const Fit& fit) { return fmt::format("{:.1f} to {:.1f}", fit.low, fit.high); }

void PrintRuns(const std::vector<ValidationRun>& runs) {
  fmt::print("{:<22}{:>9}{:>12}{:>10}{:>18}{:>9}\n", "", "nominal", "calibrated", "extended",
             "5 to 95 %", "ceiling");
  for (const ValidationRun& run : runs) {
    const auto row = [](const std::string& name, const Fit& nominal, const Fit& calibrated,
                        const Fit& extended, double ceiling) {
      fmt::print("{:<22}{:>9.2f}{:>12.2f}{:>10.2f}{:>18}{:>9.2f}\n", name, nominal.percent,
                 calibrated.percent, extended.percent, Interval(extended), ceiling);
    };
    if (run.current_ceiling > 0.0) {
      row(run.name + " I", run.nominal.current, run.calibrated.current, run.extended.current,
          run.current_ceiling);
    }
    row(run.name + " x", run.nominal.motion, run.calibrated.motion, run.extended.motion,
        run.motion_ceiling);
  }
}

nlohmann::ordered_json FitJson(const Fit& nominal, const Fit& calibrated, const Fit& extended,
                               double ceiling) {
  return {{"before", nominal.percent},   {"calibrated", calibrated.percent},
          {"after", extended.percent},   {"after_low", extended.low},
          {"after_high", extended.high}, {"ceiling", ceiling}};
}

nlohmann::ordered_json RunsJson(const std::vector<ValidationRun>& runs) {
  auto json = nlohmann::ordered_json::array();
  for (const ValidationRun& run : runs) {
    nlohmann::ordered_json entry{{"run", run.name}};
    if (run.current_ceiling > 0.0) {
      entry["current_percent"] = FitJson(run.nominal.current, run.calibrated.current,
                                         run.extended.current, run.current_ceiling);
      entry["lower_current_percent"] =
          FitJson(run.nominal.away, run.calibrated.away, run.extended.away, 0.0);
    }
    entry["motion_percent"] =
        FitJson(run.nominal.motion, run.calibrated.motion, run.extended.motion, run.motion_ceiling);
    json.push_back(entry);
  }
  return json;
}

std::string RunsTable(const std::vector<ValidationRun>& runs) {
  std::string rows;
  for (const ValidationRun& run : runs) {
    const auto row = [&](const char* what, const Fit& nominal, const Fit& calibrated,
                         const Fit& extended, double ceiling) {
      rows += fmt::format(
          "<tr><td>{}</td><td>{}</td><td class=n>{:.1f}</td><td class=n>{:.1f}</td>"
          "<td class=n><b>{:.1f}</b> ({})</td><td class=n>{:.1f}</td></tr>\n",
          run.name, what, nominal.percent, calibrated.percent, extended.percent, Interval(extended),
          ceiling);
    };
    if (run.current_ceiling > 0.0) {
      row("current, free run", run.nominal.current, run.calibrated.current, run.extended.current,
          run.current_ceiling);
    }
    row("motion, one step", run.nominal.motion, run.calibrated.motion, run.extended.motion,
        run.motion_ceiling);
  }
  return "<h2>Runs that were not fitted: fit in percent</h2><table><tr><th>run</th><th></th>"
         "<th>rig file</th><th>calibrated</th><th>extended (5 to 95 %)</th><th>noise alone</th>"
         "</tr>\n" +
         rows + "</table>\n";
}

/// Each stands in the place of the named cause it does most for.
std::vector<std::pair<std::string, std::string>> WhyNot(const LevitatorResult& answer) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const levitator::Score& score : answer.found.scores) {
    if (score.named || score.instead_of >= levitator::Causes().size()) continue;
    const std::string effect = levitator::Causes()[score.cause].effect;
    const std::string named = levitator::Causes()[score.instead_of].effect;
    const bool tied =
        std::any_of(answer.ties.begin(), answer.ties.end(), [&](const levitator::Tie& tie) {
          return tie.cause == named &&
                 std::find(tie.others.begin(), tie.others.end(), effect) != tie.others.end();
        });
    out.emplace_back(effect, tied ? fmt::format("not separable from {}", named)
                                  : fmt::format("explains {:.0f} nat less than {} in its place",
                                                score.behind_nat, named));
  }
  return out;
}

}  // namespace

void PrintLevitator(const LevitatorResult& answer, bool complete) {
  PrintDiagnosis(answer.common, complete);
  for (const levitator::Tie& tie : answer.ties) {
    if (tie.others.empty()) continue;
    fmt::print("{} is not separable from", tie.cause);
    for (const std::string& other : tie.others) fmt::print(" {}", other);
    fmt::print("\n");
  }
  fmt::print(
      "\nFit on runs that were not fitted, percent (I: current in free run, x: motion one "
      "step ahead)\n");
  PrintRuns(answer.validation);
}

nlohmann::ordered_json LevitatorJson(const LevitatorResult& answer) {
  nlohmann::ordered_json json = DiagnosisJson(levitator::BuildReport(answer));
  json["ties"] = nlohmann::ordered_json::object();
  for (const levitator::Tie& tie : answer.ties) json["ties"][tie.cause] = tie.others;
  json["runs_held_out"] = RunsJson(answer.validation);
  json["runs_fitted"] = RunsJson(answer.fitted);
  for (std::size_t i = 0; i < answer.found.scores.size(); ++i) {
    const double nat = answer.found.scores[i].held_out_nat;
    if (std::isfinite(nat)) json["candidates"][i]["held_out_nat"] = nat;
  }
  return json;
}

std::vector<std::string> WriteLevitator(const LevitatorResult& answer, const std::string& folder) {
  std::vector<std::string> paths{folder + "/diagnosis.json", folder + "/extended_rig.yaml",
                                 folder + "/calibrated_rig.yaml", folder + "/report.html"};
  WriteJsonFile(paths[0], LevitatorJson(answer));
  WriteTextFile(paths[1], answer.extended_rig);
  WriteTextFile(paths[2], answer.extended_rig);
  diagnosis::DiagnosisResult page = answer.common;
  if (page.own_words) page.own_words->why_not = WhyNot(answer);
  WriteTextFile(paths[3], DiagnosisPage(page, RunsTable(answer.validation)));
  return paths;
}

}  // namespace levitas::cli
