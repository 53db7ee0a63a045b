// amb diagnose: names the cause of the difference between a rig and its model; extends the model.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/commands/study_commands.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/answer_folder.hpp"
#include "cli/study/diagnose_plan.hpp"
#include "cli/study/diagnosis_inputs.hpp"
#include "cli/study/early_stop.hpp"
#include "cli/study/healthy_session.hpp"
#include "cli/study/kept_memory.hpp"
#include "cli/study/laws_of_records.hpp"
#include "cli/study/progress_line.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "cli/utc_text.hpp"
#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/levitator/levitator_result.hpp"
#include "diagnosis/levitator/plan.hpp"
#include "diagnosis/report/build_report.hpp"
#include "diagnosis/report/plan.hpp"
#include "levitas_version.hpp"
#include "report/diagnosis/diagnosis_files.hpp"
#include "report/diagnosis/diagnosis_text.hpp"
#include "rt/say.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kDiagnoseHelp =
    "Drives the rig's nonlinear model with the recorded currents and tests for every effect "
    "of docs/effects.md whether it explains the residual, together with all deviations that a "
    "healthy rig may have. Give several records of one rig at once: standing "
    "with "
    "a test signal, spinning, running up. Writes diagnosis.json, extended_rig.yaml, "
    "calibrated_rig.yaml and report.html into --out; a terminal shows how far it is. Ctrl-C ends "
    "the search and writes the best answer so far, which says so, with exit status 1; once more "
    "ends at once.\n"
    "--plan without --out prints before any diagnosis which faults, at the size that `amb effects` "
    "calls clear, these records can tell apart.\n"
    "Records are sessions, or CSV or MAT as in docs/formats.md. Examples:\n"
    "  amb diagnose --plan --rig flexible_rotor --scenario default\n"
    "  amb diagnose --rig flexible_rotor standing.csv spinning.csv runup.csv --out answer";

struct DiagnoseOptions : AnalysisOptions {
  std::vector<std::string> data;
  std::vector<std::string> holdout;
  std::vector<std::string> healthy;
  std::vector<std::string> scenarios;
  std::string out, plan;
  double size{1.0};
  bool quick{}, explain{}, plans{}, as_is{};
};

/// `--plan record.lcm` gives a record to an option whose value may be left out.
bool IsScenario(const std::string& path) {
  return path.ends_with(".yaml") || path.ends_with(".yml");
}

ExitStatus PlanBefore(DiagnoseOptions options) {
  if (!options.plan.empty() && !IsScenario(options.plan)) {
    options.data.insert(options.data.begin(), options.plan);
    options.plan.clear();
  }
  if (options.data.empty() && options.scenarios.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--plan: nothing to plan with: give records of the rig, or --rig and --scenario "
                  "to simulate them");
  }
  if (!options.holdout.empty() || !options.healthy.empty() || options.quick || options.explain ||
      options.as_is) {
    throw Problem(
        ExitStatus::kUsage,
        "--holdout, --healthy, --quick, --explain and --as-is belong to a diagnosis: give "
        "--out, or leave them out");
  }
  return Plan({options.data, options.scenarios, options.controller_name, options.plan, options.size,
               options.json_path},
              LoadRigOfRecords(options, options.data));
}

/// What was found, and the scenario that would separate what is left.
struct Diagnosed {
  diagnosis::DiagnosisReport report;
  std::string scenario;       ///< empty when none is needed or would help
  const char* no_scenario{};  ///< why
};

/// Two-magnet levitator: voltage-driven coils, with separate models, causes and fits.
Diagnosed DiagnoseLevitator(const diagnosis::DiagnosisRequest& inputs) {
  Diagnosed out;
  out.report = levitator::Diagnose(inputs).report;
  out.scenario = levitator::PlanScenario(inputs.rig, out.report);
  out.no_scenario = "nothing is left that a scenario could separate";
  return out;
}

Diagnosed DiagnoseRotor(diagnosis::DiagnosisRequest inputs) {
  const EarlyStop stop;
  inputs.settings.stop = EarlyStop::Asked;
  Diagnosed out;
  out.report = diagnosis::BuildReport(diagnosis::DiagnoseFiles(inputs), inputs.rig);
  if (out.report.needs_experiment) {
    out.scenario = diagnosis::PlanScenario(out.report, inputs.rig);
  }
  out.no_scenario = "nothing is left to separate";
  return out;
}

/// Prints the reason if there is no scenario.
void WritePlan(const std::string& path, const Diagnosed& found, std::vector<std::string>& written) {
  if (found.scenario.empty()) {
    fmt::print("--plan: {}, {} is not written\n", found.no_scenario, path);
    return;
  }
  WriteTextFile(path, found.scenario);
  written.push_back(path);
}

/// When and of what this answer is.
diagnosis::ReportOrigin OriginOf(const DiagnoseOptions& options) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  diagnosis::ReportOrigin origin;
  origin.date_utc = UtcText(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
  origin.program_version = LEVITAS_VERSION;
  origin.rig_file = options.rig_named;
  origin.records = options.data;
  origin.validation = options.holdout;
  origin.healthy = options.healthy;
  origin.quick = options.quick;
  return origin;
}

/// Of a diagnosis, not of a plan before it.
void CheckUsage(const DiagnoseOptions& options) {
  if (options.data.empty()) throw Problem(ExitStatus::kUsage, "DATA is required");
  if (options.out.empty()) throw Problem(ExitStatus::kUsage, "--out is required");
  if (options.plans && options.plan.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--plan after a diagnosis needs the file to write: FILE.yaml");
  }
  if (!options.scenarios.empty() || !options.controller_name.empty()) {
    throw Problem(ExitStatus::kUsage,
                  "--scenario and --controller simulate records for --plan: leave out --out");
  }
}

ExitStatus Run(const DiagnoseOptions& options) {
  KeepFreedMemory();
  if (options.plans && options.out.empty()) return PlanBefore(options);
  CheckUsage(options);
  diagnosis::DiagnosisRequest inputs;
  std::vector<std::string> records = options.data;
  records.insert(records.end(), options.holdout.begin(), options.holdout.end());
  records.insert(records.end(), options.healthy.begin(), options.healthy.end());
  inputs.rig = LoadRigOfRecords(options, records);
  RefuseSameFiles(options.data, options.holdout, options.healthy);
  const AnswerFolder folder(options.out);
  ProgressLine progress(stderr, isatty(STDERR_FILENO) == 1);
  inputs.data = options.data;
  inputs.holdout = options.holdout;
  inputs.healthy = options.healthy;
  std::vector<std::string> judged = options.data;
  judged.insert(judged.end(), options.holdout.begin(), options.holdout.end());
  inputs.known_laws = LawsOfRecords(judged, inputs.rig);
  inputs.settings.quick = options.quick;
  inputs.as_is = options.as_is;
  inputs.settings.progress = [&progress](double share, const std::string& what) {
    progress.Show(share, EarlyStop::Asked() ? "stopping: " + what : what);
  };
  Diagnosed found =
      levitator::IsLevitator(inputs.rig.plant) ? DiagnoseLevitator(inputs) : DiagnoseRotor(inputs);
  progress.Close();
  found.report.origin = OriginOf(options);
  if (!found.report.healthy_proposal.empty()) {
    found.report.healthy_record = LastAcceptedSession(inputs.rig, records);
  }
  report::PrintDiagnosis(found.report, options.explain);
  WriteJsonFile(options.json_path, report::DiagnosisJson(found.report));
  auto written = report::WriteDiagnosis(found.report, options.out);
  if (!options.plan.empty()) WritePlan(options.plan, found, written);
  if (!options.json_path.empty()) written.push_back(options.json_path);
  TellWritten(written);
  if (!found.report.stopped) return ExitStatus::kDone;
  rt::Say("amb: the search was stopped before its end: the answer is what it had found by then");
  return ExitStatus::kOther;
}

CLI::Option* AddPlanOptions(CLI::App& command, DiagnoseOptions& options) {
  CLI::Option* plan =
      command
          .add_option("--plan", options.plan,
                      "Without --out: diagnose nothing, but foretell which faults the records can "
                      "tell apart, and what would help; FILE.yaml: also write the scenario that "
                      "helps most. With --out: write to FILE.yaml the scenario that would separate "
                      "what these data cannot; not written when nothing is left to separate")
          ->expected(0, 1);
  command.add_option("--scenario", options.scenarios,
                     "With --plan: a scenario file or shipped name, simulated with the healthy "
                     "rig instead of a record");
  command.add_option("--controller", options.controller_name,
                     "Of what --plan simulates; default: the one the rig file names");
  command
      .add_option("--size", options.size,
                  "Of the faults of --plan, as a share of the size that `amb effects` calls clear")
      ->check(CLI::Range(0.01, 1.0))
      ->capture_default_str();
  return plan;
}

}  // namespace

void AddDiagnoseCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DiagnoseOptions>();
  CLI::App* command = AddStudyCommand(app, "diagnose");
  command->footer(kDiagnoseHelp);
  command->add_option("DATA", options->data,
                      "Sessions, CSV or MAT files of one rig; not needed with --scenario");
  AddRigOfRecordsOption(*command, *options);
  command->add_option("--holdout", options->holdout,
                      "Validation data for the gain, none of DATA; without it every sixth "
                      "stretch of 50 ms is validation data");
  command->add_option("--healthy", options->healthy,
                      "Earlier records of the same rig in good condition: they narrow its "
                      "tolerances");
  CLI::Option* plan = AddPlanOptions(*command, *options);
  command->add_option("--out", options->out,
                      "Folder for the answer; required except to --plan before a diagnosis");
  command->add_flag(
      "--quick", options->quick,
      "First answer: the strongest cause, from at most 30 000 samples of all records");
  command->add_flag("--explain", options->explain,
                    "Print every calibrated value and every candidate");
  command->add_flag("--as-is", options->as_is,
                    "Take columns, times and rig file as they are: look for no errors of the "
                    "records");
  AddJsonOption(*command, *options);
  command->callback([options, plan, &action] {
    options->plans = plan->count() > 0;
    action = [options] { return Run(*options); };
  });
}

}  // namespace levitas::cli
