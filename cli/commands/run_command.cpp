// amb run: controller and simulated rig as two processes, progress, and the commissioning verdict.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/commands/next_step.hpp"
#include "cli/json_file.hpp"
#include "cli/options/enter_session.hpp"
#include "cli/options/requirement.hpp"
#include "cli/run/disk_room.hpp"
#include "cli/run/interrupt.hpp"
#include "cli/run/live_page.hpp"
#include "cli/run/loop_warning.hpp"
#include "cli/run/port_lease.hpp"
#include "cli/run/progress.hpp"
#include "cli/run/run_folder.hpp"
#include "cli/run/run_options.hpp"
#include "cli/run/supervise.hpp"
#include "cli/run/telemetry.hpp"
#include "cli/text_file.hpp"
#include "common/output_file.hpp"
#include "common/time_option.hpp"
#include "common/whole_number.hpp"
#include "hil/socketcan/can_connection.hpp"
#include "plant_sim/loop/timed_events.hpp"
#include "rt/say.hpp"
#include "session/log/output_path.hpp"
#include "verdict/commission.hpp"
#include "verdict/report.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

/// Ports of our own unless the user named some.
PortLease Lease(std::optional<transport::LcmNetwork>& network) {
  if (network) return PortLease::Claim(network->base_port);
  PortLease lease = PortLease::FirstFree();
  network = transport::LcmNetwork{};
  network->base_port = lease.base_port();
  return lease;
}

RunPaths PathsOf(const RunOptions& options, const RunFolder& folder) {
  RunPaths paths;
  paths.session = options.record_path.empty() ? folder / "session.lcmlog" : options.record_path;
  paths.controller_json = folder / "controller.json";
  paths.plant_json = folder / "plant.json";
  paths.controller_log = folder / "controller.log";
  paths.plant_log = folder / "plant.log";
  // Beside a record the user keeps; else with the record, which a trip keeps.
  const fs::path beside = fs::path(paths.session).parent_path();
  paths.trip_folder = beside.empty() ? "." : beside.string();
  return paths;
}

RunResult RunBoth(const RunPlan& plan, const RunFiles& files,
                  const transport::LcmNetwork& network) {
  const InterruptGuard interrupts;
  Telemetry telemetry(network);
  const auto draw = [](const std::string& part) { rt::Say(part, rt::Speaker::Kind::kPart); };
  Progress progress(files.rig.bearings, files.rig.period_s(), draw, isatty(STDERR_FILENO) == 1);
  RunHooks hooks;
  hooks.telemetry = [&](std::chrono::milliseconds limit) { return telemetry.Wait(limit); };
  hooks.progress = [&](const ProgressSample& sample) { progress.Show(sample); };
  hooks.say = [&](const std::string& text) {
    progress.Close();
    rt::Say(text);
  };
  hooks.interrupts = [&] { return interrupts.count(); };
  RunResult result = Supervise(plan, hooks);
  progress.Close();
  static_cast<void>(rt::FlushSaid());  // what follows goes to standard output
  return result;
}

verdict::CommissionOptions WhatToJudge(const RunFiles& files, const RunPaths& paths,
                                       const RunResult& result, const std::string& port) {
  verdict::CommissionOptions judge;
  judge.session_path = paths.session;
  judge.controller_report = paths.controller_json;
  judge.plant_report = paths.plant_json;
  judge.provenance.rig_file = files.rig_path;
  judge.provenance.controller_file = files.controller_path;
  judge.provenance.scenario_file = files.scenario_path;
  judge.provenance.scenario = files.scenario_name;
  judge.provenance.session_file = paths.session;
  judge.provenance.port = port;
  const std::string stopped = RecordingStopped(paths.controller_log);
  if (!result.trouble.empty()) {
    judge.incomplete_reason = result.trouble.substr(0, result.trouble.find('\n'));
  } else if (!stopped.empty()) {
    judge.incomplete_reason = stopped;
  } else if (result.interrupted) {
    judge.incomplete_reason = "stopped by the operator before the end; the rotor was landed";
  }
  return judge;
}

ExitStatus StatusOf(const RunResult& result) {
  const bool refused = !result.controller.signalled &&
                       (result.controller.code == static_cast<int>(ExitStatus::kUsage) ||
                        result.controller.code == static_cast<int>(ExitStatus::kBadInput));
  if (refused) return static_cast<ExitStatus>(result.controller.code);
  if (!result.trouble.empty()) return ExitStatus::kOther;
  if (result.controller.code == static_cast<int>(ExitStatus::kTripped)) return ExitStatus::kTripped;
  return result.interrupted ? ExitStatus::kOther : ExitStatus::kDone;
}

/// What the programs could not say themselves, since it is where they say it.
std::string WithRoom(const std::string& trouble, const RunPaths& paths, const RunFolder& folder) {
  const std::string full = NoRoom({folder.path(), paths.session, paths.trip_folder});
  if (trouble.empty() || full.empty()) return trouble;
  return fmt::format(
      "{}\n{} (TMPDIR names the folder of a run's logs and reports, --record that "
      "of its record)",
      trouble, full);
}

void SayWhereTheRecordIs(const RunPaths& paths, const std::string& trip_file) {
  const std::string record = rt::OneLine(paths.session);
  const std::string trip = rt::OneLine(trip_file);
  fmt::print("record: {}   (amb replay {})\n", record, record);
  if (!trip.empty()) fmt::print("trip:   {}   (amb export {} --csv trip.csv)\n", trip, trip);
}

/// Prints the verdict of what was recorded, if anything was; the run's exit status.
ExitStatus JudgeRun(const RunOptions& options, const RunFiles& files, const RunPaths& paths,
                    const RunResult& result, const std::string& port, std::string& sentence) {
  const ExitStatus status = StatusOf(result);
  const bool keep = !options.record_path.empty() || status == ExitStatus::kTripped;
  if (!fs::exists(paths.session) || fs::file_size(paths.session) == 0) return status;
  verdict::CommissionOptions judge = WhatToJudge(files, paths, result, port);
  if (!keep) judge.provenance.session_file.clear();
  try {
    const verdict::Verdict verdict = verdict::Commission(judge);
    fmt::print("{}", verdict::Table(verdict));
    sentence = verdict.sentence;
    WriteJsonFile(options.json_path, verdict::Json(verdict));
    if (!options.record_path.empty()) EnterRun(paths.session, verdict, options.tags);
    if (keep) SayWhereTheRecordIs(paths, verdict.inputs.provenance.trip_file);
    const std::string next = NextStep(
        verdict, {options.rig, options.controller, options.record_path, options.changes.any()});
    if (!next.empty()) fmt::print("{}\n", next);
    const bool incomplete = verdict.outcome == verdict::Outcome::kIncomplete;
    if (status == ExitStatus::kDone && !incomplete) RequireRun(options.required, verdict);
    return incomplete && status == ExitStatus::kDone ? ExitStatus::kOther : status;
  } catch (const BadInput&) {
    // Files that are not whole follow from what went wrong, and that is what is told.
    if (result.trouble.empty()) throw;
    return status;
  }
}

/// The run is judged by its record, so it is read again.
void RefuseWhatCannotBeRead(const std::string& record_path) {
  if (record_path.empty() || !IsWrittenAsItIs(record_path)) return;
  throw Problem(ExitStatus::kUsage,
                fmt::format("--record {}: a pipe or a device, but a run is judged by its record. "
                            "Name a file, or start amb-controller by itself",
                            record_path));
}

/// Both programs read the rig from one file; where it is not as in its file, from one of the run.
RunFiles WithRigAsRun(const RunOptions& options, RunFiles files, const RunFolder& folder) {
  if (!options.rig_out.empty()) WriteTextFile(options.rig_out, files.rig_text);
  const RigChanges& changes = options.changes;
  if (!changes.any()) return files;
  if (changes.bias_current_a) rt::Say(fmt::format("bias current {:g} A", *changes.bias_current_a));
  for (const std::string& effect : changes.effects) rt::Say("effect added: " + effect);
  files.rig_path = folder / "rig.yaml";
  WriteTextFile(files.rig_path, files.rig_text);
  return files;
}

/// The rig as it is run, as a command takes it, and how it is kept where it is not yet.
std::pair<std::string, std::string> RigForCommands(const RunOptions& options) {
  if (!options.changes.any()) return {options.rig, ""};
  if (!options.rig_out.empty()) return {options.rig_out, ""};
  return {"as_run.yaml", " (--write-rig as_run.yaml keeps the rig as it is run)"};
}

/// Before anything is lifted: an unstable loop is said; an unstable block of synchronous control,
/// and an event for which the rig lacks the part, are refused.
void CheckLoop(const RunOptions& options, const RunFiles& files) {
  const configuration::RigFile rig = configuration::ParseRig(files.rig_text, files.rig_path);
  const auto controller = configuration::LoadController(files.controller_path, files.rig);
  const auto scenario = configuration::LoadScenario(files.scenario_path, files.rig);
  // Throws for an event that cannot be.
  const plant_run::TimedEvents events(scenario, rig.numbers, rig.plant);
  const auto [rig_name, kept] = RigForCommands(options);
  const std::string text =
      UnstableLoop(rig, controller.law, ScenarioSpeeds(scenario), rig_name, files.controller_path);
  if (!text.empty()) rt::Say("amb: warning: " + text + kept);
  const std::string blocks = UnstableBlocksOf(rig, controller);
  if (blocks.empty()) return;
  throw BadInput(
      fmt::format("{}: {}. Nothing was lifted. amb design notch --rig {} makes blocks for it, amb "
                  "margins shows "
                  "these{}",
                  files.controller_path, blocks, rig_name, kept));
}

std::string PortOf(const RunOptions& options, const transport::LcmNetwork& network) {
  return socketcan::IsCanPort(options.port) ? options.port
                                            : network.Url(transport::Direction::kSensor);
}

std::string PaceText(const RunOptions& options) {
  if (options.pace != "paced") return options.pace;
  return fmt::format("paced at {:g} x the clock", options.pace_factor.value_or(1.0));
}

/// `ending` is filled as soon as it is known: a verdict that throws does not undo it.
ExitStatus RunAndJudge(const RunOptions& options, const RunFiles& files, const RunPlan& plan,
                       RunFolder& folder, const transport::LcmNetwork& network,
                       LivePage::Ending& ending) {
  const RunPaths paths = PathsOf(options, folder);
  RunResult result = RunBoth(plan, files, network);
  ending.interrupted = result.interrupted;
  if (result.trouble.empty()) {
    ending.over(result.controller.code == 0 ? ExitStatus::kDone : ExitStatus::kTripped);
  }
  result.trouble = WithRoom(result.trouble, paths, folder);
  for (const std::string& note : TripFolderNotes(paths.controller_log)) rt::Say(note);
  const ExitStatus status =
      JudgeRun(options, files, paths, result, PortOf(options, network), ending.verdict);
  if (status == ExitStatus::kTripped && options.record_path.empty()) folder.Keep();
  std::fflush(stdout);
  if (!result.trouble.empty()) throw Problem(status, result.trouble);
  return status;
}

ExitStatus Execute(const RunOptions& asked) {
  for (const std::string& path : {asked.record_path, asked.json_path, asked.rig_out}) {
    session::CheckOutputPath(path, {});
  }
  RefuseWhatCannotBeRead(asked.record_path);
  session::CheckNoRecording(asked.record_path, asked.overwrite);
  std::optional<transport::LcmNetwork> network = CheckPort(asked.port);
  const RunFiles files = CheckFiles(asked);
  session::RefuseClash({{"--record", asked.record_path},
                        {"--json", asked.json_path},
                        {"--write-rig", asked.rig_out}},
                       {{"the rig file", files.rig_path},
                        {"the controller file", files.controller_path},
                        {"the scenario file", files.scenario_path}});
  const RunOptions options = SettleRig(asked, configuration::LoadRig(files.rig_path));
  CheckBuses(options, files);
  const PortLease lease = Lease(network);
  transport::TakeKey(*network, options.key, "play the rig or the controller");
  RunFolder folder;
  if (!folder.removed().empty()) {
    rt::Say(fmt::format("removed {} older folders of runs beside {}", folder.removed().size(),
                        folder.path()));
  }
  const RunPlan plan =
      PlanRun(options, WithRigAsRun(options, files, folder), PathsOf(options, folder), *network);
  rt::Say(fmt::format("rig {}{}, controller {}, scenario {}, {}, port {}", files.rig.name,
                      options.rig_is_there ? " (not simulated)" : "", files.controller_path,
                      files.scenario_name, PaceText(options), PortOf(options, *network)));
  CheckLoop(options, files);
  LivePage page(PlanPage(options.page, LookAround(options.pace != "lockstep")), *network,
                [](const std::string& line) { rt::Say(line); });
  return page.Outlive([&](LivePage::Ending& ending) {
    return RunAndJudge(options, files, plan, folder, *network, ending);
  });
}

void AddRigOptions(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  command.add_option("--rig", options->rig, "Rig file, or the name of a shipped one")
      ->capture_default_str();
  command.add_option("--bias-current-a", options->changes.bias_current_a,
                     "Bias current [A] in place of the rig file's, for the rig and the controller; "
                     "the session holds the rig as it was run");
  command
      .add_option("--effect", options->changes.effects,
                  "Add an effect to the simulated rig, as an entry of a rig file's effects (amb "
                  "effects lists them, docs/effects.md has one of each to copy); may be repeated; "
                  "the session holds the rig as it was run")
      ->expected(1)
      ->take_all();
  command.add_option("--write-rig", options->rig_out,
                     "Write the rig as it is run to this file, for the commands on the record");
}

void AddPaceOptions(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  command
      .add_option(
          "--pace", options->pace,
          "lockstep (as fast as the machine allows), paced (lockstep held to the clock, for "
          "eyes) or realtime; default: realtime where the rig is not simulated here, paced "
          "with --dash or --pace-factor")
      ->check(CLI::IsMember({"lockstep", "paced", "realtime"}))
      ->default_str("lockstep");
  command
      .add_option("--pace-factor", options->pace_factor,
                  "How many seconds of the rig pass in one of the clock in a paced run; default: 1")
      ->check(CLI::Range(0.05, 100.0));
}

void AddPortOptions(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  command.add_option("--port", options->port,
                     "lcm, lcm:udpm://<group>:<port>?ttl=<n>, can, or can:IF[,IF...] (the rig then "
                     "stands behind CAN buses, see docs/real_rig.md); default: lcm on free ports");
  command.add_flag("--no-simulated-rig", options->rig_is_there,
                   "Start the controller alone, for a rig that is on --port already; on a bus "
                   "that is no virtual "
                   "one (vcan, vxcan) a simulated rig is never started");
  command.add_option("--key", options->key,
                     "File with the key of those who may speak on the network (amb key FILE "
                     "makes one); with ttl above 0 it is needed");
  command.add_flag("--no-commands", options->no_commands,
                   "Take no commands over the network, not even the live page's");
}

void AddRecordOptions(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  auto* record = command.add_option(
      "--record", options->record_path,
      "Keep the record in this file; packed by zstd under a name that ends in .zst");
  command.add_flag("--overwrite", options->overwrite, "Replace a record that is there already");
  command
      .add_option("--tag", options->tags, "Tag of the record, see amb sessions; may be repeated")
      ->needs(record);
}

void AddPageOptions(CLI::App& command, const std::shared_ptr<RunOptions>& options) {
  auto* dash = command.add_flag_callback(
      "--dash", [options] { options->page = PageWish::kAlways; },
      "Serve the live page during the run, at the clock's pace, print its address, and keep it "
      "after the run until Ctrl-C");
  command
      .add_flag_callback(
          "--no-dash", [options] { options->page = PageWish::kNever; },
          "No live page; default: on a terminal, when the pace is real time or paced, it is "
          "served and opened in the desktop's browser")
      ->excludes(dash);
}

}  // namespace

void AddRunCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run",
                                         "Levitate the rig, simulated or on a real bus, with the "
                                         "controller process and judge the run");
  AddRigOptions(*command, options);
  command
      ->add_option("--controller", options->controller,
                   "Controller file or shipped name; default: the one the rig file names")
      ->default_str(kGeneralController);
  command
      ->add_option("--scenario", options->scenario,
                   "Scenario file or shipped name; default: the one the rig file names")
      ->default_str(kGeneralScenario);
  command
      ->add_option("--duration", options->duration_s,
                   "Land after this long [s of the rig's time], wherever the scenario is")
      ->check(WhyNoTime);
  AddPaceOptions(*command, options);
  AddPortOptions(*command, options);
  AddRecordOptions(*command, options);
  command->add_option("--seed", options->seed, "Seed of the sensor noise")
      ->check(WhyNoWholeNumber)
      ->capture_default_str();
  AddRunRequirement(*command, options->required);
  command->add_option("--json", options->json_path,
                      "Write the verdict to this file; -: to standard output, the text then to "
                      "standard error");
  AddPageOptions(*command, options);
  command->callback([options, &action] { action = [options] { return Execute(*options); }; });
}

}  // namespace levitas::cli
