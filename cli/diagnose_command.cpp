// amb diagnose: what a rig does that its model does not, the extended model, and what it gains.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/analysis_options.hpp"
#include "cli/command.hpp"
#include "cli/diagnosis_files.hpp"
#include "cli/json_file.hpp"
#include "cli/kept_memory.hpp"
#include "cli/levitator_files.hpp"
#include "cli/text_file.hpp"
#include "diagnosis/plan.hpp"
#include "diagnosis/session.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kHelp =
    "Drives the rig's nonlinear model with the recorded currents and asks of every effect of the "
    "vocabulary (docs/effects.md) whether it explains what the model gets wrong, together with "
    "everything a healthy rig may differ by. Give several records of one rig at once: standing "
    "with "
    "a test signal, spinning, running up. Writes diagnosis.json, extended_rig.yaml and report.html "
    "into --out.\n"
    "Records are sessions, or CSV or MAT as in docs/formats.md. Example:\n"
    "  amb diagnose --rig flexible_rotor standing.csv spinning.csv runup.csv --out answer";

struct DiagnoseOptions : AnalysisOptions {
  std::vector<std::string> data;
  std::vector<std::string> holdout;
  std::vector<std::string> healthy;
  std::string out, plan;
  bool quick{};
};

void ShowProgress(double share, const std::string& what) {
  if (isatty(STDERR_FILENO) == 0) return;
  constexpr int kWidth = 30;
  const int done = static_cast<int>(share * kWidth);
  fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:<40}", "", done, "", kWidth - done, what);
  if (share >= 1.0) fmt::print(stderr, "\r{:80}\r", "");
}

/// One axis whose coils are on a voltage: models, causes and fits of its own.
ExitStatus RunLevitator(const diagnosis::SessionInputs& inputs, const DiagnoseOptions& options) {
  if (!options.plan.empty() || !options.healthy.empty()) {
    throw BadInput("--plan and --healthy are not offered for rigs whose coils are on a voltage");
  }
  const levitator::Answer answer = levitator::Diagnose(inputs);
  PrintLevitator(answer);
  WriteLevitator(answer, options.out);
  WriteJsonFile(options.json_path, LevitatorJson(answer));
  return ExitStatus::kDone;
}

ExitStatus Run(const DiagnoseOptions& options) {
  KeepFreedMemory();
  std::error_code failed;
  std::filesystem::create_directories(options.out, failed);
  if (failed) {
    throw BadInput(fmt::format("--out {}: cannot be made a folder ({}); name another", options.out,
                               failed.message()));
  }
  diagnosis::SessionInputs inputs;
  inputs.rig = LoadRig(options);
  inputs.data = options.data;
  inputs.holdout = options.holdout;
  inputs.healthy = options.healthy;
  inputs.scratch_folder = options.out;
  inputs.settings.quick = options.quick;
  inputs.settings.progress = ShowProgress;
  if (levitator::IsLevitator(inputs.rig.plant)) return RunLevitator(inputs, options);
  const diagnosis::SessionAnswer answer = diagnosis::DiagnoseFiles(inputs);
  PrintDiagnosis(answer);
  WriteDiagnosis(answer, inputs.rig, options.out);
  WriteJsonFile(options.json_path, DiagnosisJson(answer));
  if (!options.plan.empty()) WriteTextFile(options.plan, diagnosis::PlanScenario(answer));
  return ExitStatus::kDone;
}

}  // namespace

void AddDiagnoseCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<DiagnoseOptions>();
  CLI::App* command = app.add_subcommand("diagnose", "What the model of a rig gets wrong, and why");
  command->footer(kHelp);
  command->add_option("DATA", options->data, "Sessions, CSV or MAT files of one rig")->required();
  AddRigOption(*command, *options);
  command->add_option("--holdout", options->holdout,
                      "Data on which the gain is measured; without it every sixth stretch of "
                      "50 ms is kept back");
  command->add_option("--healthy", options->healthy,
                      "Earlier records of the same rig, known to be well: they narrow what it may "
                      "differ by from its file");
  command->add_option("--plan", options->plan,
                      "Write the scenario that would separate what these data cannot");
  command->add_option("--out", options->out, "Folder for the answer")->required();
  command->add_flag(
      "--quick", options->quick,
      "First answer: the strongest cause, from at most 30 000 samples of all records");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
