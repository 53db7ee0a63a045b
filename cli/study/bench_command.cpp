// amb bench diagnosis: hides effects in simulated rigs and asks the diagnosis for them.

#include "cli/study/bench_command.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/study_commands.hpp"
#include "cli/json_file.hpp"
#include "cli/study/bench_forecast.hpp"
#include "cli/study/bench_isolability.hpp"
#include "cli/study/bench_lives.hpp"
#include "cli/study/bench_mesh.hpp"
#include "cli/study/bench_spoilt.hpp"
#include "cli/study/bench_sweep.hpp"
#include "cli/study/bench_trials.hpp"
#include "cli/study/identify/geared_commands.hpp"
#include "cli/study/kept_memory.hpp"
#include "common/output_file.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kBenchHelp =
    "Draws a rig (rotor, magnets with ki i0 of 5 to 500 N, probe noise of 0.05 to 3 um) that is a "
    "few per cent off its file, hides an effect in it, records it standing, "
    "spinning and running up (5.3 s), and diagnoses the records. Every seed is one trial; effects "
    "take turns. Prints accuracy by effect and by size, "
    "false alarms, what is outside the vocabulary, several at once, and the confusion matrix. An "
    "effect that is not named is searched once more by an informed diagnosis, which is told the "
    "effect. If that fails although the records hold evidence for it, the trial is listed and "
    "counts as not named, in the size of that evidence.\n"
    "Example: amb bench diagnosis --seeds 34 --clean 10 --outside 10 --pairs 10";

/// Of which rig, and how many of each kind.
void AddTrialOptions(CLI::App& command, BenchOptions& options) {
  command.add_option("--rig", options.rig, "Nominal rig");
  command.add_option("--controller", options.controllers,
                     "Controllers, drawn by seed; without it those shipped for the rig");
  command.add_option("--seeds", options.seeds, "Trials with one hidden effect");
  command.add_option("--clean", options.clean, "Trials with nothing hidden");
  command.add_option("--outside", options.outside, "Trials outside the vocabulary");
  command.add_option("--pairs", options.pairs, "Trials with two clear effects");
  command.add_option("--weak", options.weak, "Trials with three small effects and a clear one");
}

/// What is done instead of the diagnoses.
void AddInsteadOptions(CLI::App& command, BenchOptions& options) {
  command.add_option("--spoilt", options.spoilt,
                     "Instead: so many trials of records with an error of their own, as many "
                     "healthy ones and two fifths with an effect, of which none may be accused");
  command.add_option("--kind", options.kinds,
                     "Of --spoilt only these: a kind of error (swapped, gaps, ...), healthy, "
                     "effect; so many of each of the three groups");
  command.add_option("--forecast", options.forecast,
                     "Instead: so many healthy rigs, fitted at rest and at one speed, foretell a "
                     "run-up: does the interval cover, and does calibration gain?");
  command.add_flag("--isolability", options.isolability,
                   "Instead: foretell what `amb diagnose --plan` would of every trial of --seeds, "
                   "from records without the effect, and compare it with the diagnosis");
  command.add_option("--answered", options.answered_path,
                     "With --isolability: the --json of an earlier run of the same trials, whose "
                     "answers are taken");
}

ExitStatus Run(const BenchOptions& options) {
  if (options.constants) {
    fmt::print("{}", diagnosis::JudgingMarkdown());
    return ExitStatus::kDone;
  }
  KeepFreedMemory();
  std::vector<std::string> controllers = options.controllers;
  if (controllers.empty() && options.rig == "flexible_rotor") {
    controllers = {"flexible_rotor", "flexible_rotor_commissioned"};
  }
  const accuracy::TestRig bench = accuracy::LoadTestRig(options.rig, controllers);
  if (options.spoilt > 0) {
    WriteJsonFile(options.json_path, RunSpoilt(options, bench));
    return ExitStatus::kDone;
  }
  if (options.isolability) {
    WriteJsonFile(options.json_path, RunIsolability(options, bench));
    return ExitStatus::kDone;
  }
  if (options.forecast > 0) {
    WriteJsonFile(options.json_path, RunForecast(options, bench));
    return ExitStatus::kDone;
  }
  if (!options.sweep.empty()) {
    WriteJsonFile(options.json_path, RunSweep(options, bench));
    return ExitStatus::kDone;
  }
  const std::vector<accuracy::TrialScore> outcomes = TryAll(Plans(options, bench), bench, options);
  nlohmann::ordered_json json;
  json["trials"] = nlohmann::ordered_json::array();
  for (const accuracy::TrialScore& outcome : outcomes) json["trials"].push_back(Json(outcome));
  fmt::print("\n{}\n{}", accuracy::Tables(outcomes), accuracy::ConfusionTable(outcomes));
  if (!options.markdown_path.empty()) {
    WriteWholeFile(options.markdown_path, "```\n" + accuracy::Tables(outcomes) + "```\n\n" +
                                              accuracy::ConfusionTable(outcomes));
  }
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

}  // namespace

void AddBenchCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* bench = AddStudyCommand(app, "bench");
  CLI::App* command =
      bench->add_subcommand("diagnosis", "Effects hidden in simulated rigs, to be named");
  bench->require_subcommand(1);
  AddBenchIdentification(*bench, action);
  AddBenchFullSpectrum(*bench, action);
  AddBenchPump(*bench, action);
  AddBenchLives(*bench, action);
  AddBenchMesh(*bench, action);
  command->footer(kBenchHelp);
  AddTrialOptions(*command, *options);
  AddInsteadOptions(*command, *options);
  command->add_option("--first", options->first, "Seed of the first trial");
  command->add_option("--effect", options->effects, "Only these effects");
  command->add_option("--size", options->sizes, "Sizes relative to clear, one after the other");
  command->add_flag("--quick", options->quick, "A first answer instead of the complete ranking");
  command->add_flag("--shipped", options->shipped,
                    "The rig file as it is, instead of rotor, magnets and noise drawn by seed");
  command->add_flag("--runup-validates", options->runup_validates,
                    "The run-up is not fitted: it is validation data, as of --holdout");
  command->add_flag("--in-file", options->in_file,
                    "Give the diagnosis rig files that hold the effects: right is none");
  command
      ->add_option("--bits", options->bits,
                   "Length of the test signal per axis; 2047 makes 5.3 s of records")
      ->check(CLI::Range(700, 2047));
  command->add_option("--jobs", options->jobs, "Trials at a time")->check(CLI::Range(1, 64));
  command->add_flag("--explain", options->explain, "The nearest candidates of every trial");
  command->add_option("--write", options->write_folder, "Also write the records as CSV here");
  command->add_option("--markdown", options->markdown_path, "Tables for docs/diagnosis_results.md");
  command->add_option("--sweep", options->sweep,
                      "NAME=V,V,...: the same trials with each value of a number that decides");
  command->add_flag(
      "--constants", options->constants,
      "Print the numbers that decide, with their sources (docs/diagnosis_results.md)");
  command->add_option("--json", options->json_path, "Every trial");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
