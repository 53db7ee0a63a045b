// amb design schedule: a law over speed, searched or put together from the laws of several speeds.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "cli/json_file.hpp"
#include "cli/run/interrupt.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/judged_law.hpp"
#include "cli/study/design/pid_options.hpp"
#include "cli/study/design/schedule_page.hpp"
#include "cli/study/progress_line.hpp"
#include "cli/study/written_files.hpp"
#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"
#include "design/pid/align_blocks.hpp"
#include "design/pid/schedule_search.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

constexpr double kFastestRpm = 1e6;  // of a controller file

struct ScheduleCommandOptions {
  PidCommandOptions pid;
  std::vector<double> speeds_rpm;
  std::vector<std::string> laws;  ///< RPM:FILE each
};

struct Entry {
  double speed_rad_per_s{};
  std::string controller;
};

Entry EntryOf(const std::string& text) {
  const auto colon = text.find(':');
  double rpm = 0.0;
  if (colon == std::string::npos || !CLI::detail::lexical_cast(text.substr(0, colon), rpm) ||
      !(rpm >= 0.0 && rpm <= kFastestRpm) || colon + 1 == text.size()) {
    throw Problem(
        ExitStatus::kUsage,
        "--law " + text + ": expected RPM:CONTROLLER, as in 6000:fast.yaml, up to 1e6 rpm");
  }
  return {RpmToRadPerS(rpm), text.substr(colon + 1)};
}

/// The laws of files as a table; their blocks, whose order and scale are free, brought next to
/// those of the entry before. A law of another structure than the one before is exchanged for it.
std::vector<NamedLaw> FromFiles(const ScheduleCommandOptions& options,
                                const configuration::RigFile& rig) {
  if (options.laws.size() < 2 || options.laws.size() > design::kMostEntries)
    throw Problem(ExitStatus::kUsage, fmt::format("--law: given {} times, allowed 2 to {}",
                                                  options.laws.size(), design::kMostEntries));
  std::vector<NamedLaw> named;
  std::vector<law::LawAtSpeed> entries;
  law::LawConfig table;
  for (const std::string& text : options.laws) {
    const Entry entry = EntryOf(text);
    AnalysisOptions load = options.pid.loop;
    load.controller_name = entry.controller;
    const auto found = LoadController(load, rig);
    if (!found.file.law.schedule.empty())
      throw BadInput(found.path + ": is a schedule itself; a table is made of laws of one speed");
    named.push_back({std::filesystem::path(found.path).stem().string(), found.file.law});
    law::LawAtSpeed at{entry.speed_rad_per_s, found.file.law.axes, found.file.law.state_space};
    if (at.state_space && !entries.empty() && entries.back().state_space)
      at.state_space = design::AlignBlocks(*entries.back().state_space, *at.state_space);
    if (!entries.empty()) {
      if (!(at.speed_rad_per_s > entries.back().speed_rad_per_s))
        throw Problem(ExitStatus::kUsage,
                      fmt::format("--law {}: the speeds of a table rise, and the one before has "
                                  "{:g} rpm",
                                  text, RadPerSToRpm(entries.back().speed_rad_per_s)));
      at.exchange = !law::WhyUnlike(entries.back(), at).empty();
      if (at.exchange)
        fmt::print("exchange {} takes over at {:g} rpm: its structure is another one\n", found.path,
                   RadPerSToRpm(at.speed_rad_per_s));
    }
    entries.push_back(std::move(at));
    table = found.file.law;
  }
  // Below the first speed its law stays.
  table.axes = entries.front().axes;
  table.state_space = entries.front().state_space;
  if (entries.front().speed_rad_per_s == 0.0) entries.erase(entries.begin());
  table.schedule = std::move(entries);
  const std::string why = law::WhyNoSchedule(table);
  if (!why.empty()) throw Problem(ExitStatus::kUsage, "--law: " + why);
  named.push_back({"schedule", table});
  return named;
}

std::vector<double> TableSpeeds(const ScheduleCommandOptions& options,
                                const configuration::RigFile& rig) {
  std::vector<double> out;
  for (const double rpm : options.speeds_rpm) out.push_back(RpmToRadPerS(rpm));
  const double top = rig.numbers.max_speed_rad_per_s;
  if (out.empty()) out = {0.0, 0.5 * top, top};
  if (out.front() > 0.0) out.insert(out.begin(), 0.0);
  for (std::size_t i = 1; i < out.size(); ++i)
    if (!(out[i] > out[i - 1])) throw Problem(ExitStatus::kUsage, "--speeds: rising, each once");
  if (out.size() > design::kMostEntries)
    throw Problem(ExitStatus::kUsage, fmt::format("--speeds: {} with rest, at most {}", out.size(),
                                                  design::kMostEntries));
  if (out.size() < 2) throw Problem(ExitStatus::kUsage, "--speeds: one above rest at least");
  return out;
}

std::vector<NamedLaw> Search(ScheduleCommandOptions& options, const configuration::RigFile& rig) {
  CompleteSearch(rig, options.pid);
  design::ScheduleOptions search{options.pid.search, TableSpeeds(options, rig)};
  ProgressLine line(stderr, isatty(STDERR_FILENO) != 0);
  const InterruptGuard interrupt;
  std::fflush(stdout);  // whoever reads a pipe sees what is being designed
  const auto found = design::SearchSchedule(rig, LimitsOf(options.pid, rig),
                                            ParametersOf(rig, options.pid.gate.from), search,
                                            [&](double share, const std::string& text) {
                                              line.Show(share, text);
                                              return interrupt.count() == 0;
                                            });
  line.Close();
  fmt::print("search   {} laws for {} speeds{}\n", found.evaluations, found.law.schedule.size() + 1,
             found.interrupted ? "; ended by a signal, the best so far is judged" : "");
  for (const auto& [from, to] : found.open)
    fmt::print(
        "         no laws found that hold, or keep |S|, everywhere from {:.0f} to {:.0f} rpm\n",
        RadPerSToRpm(from), RadPerSToRpm(to));
  return {{"one law", found.one.law}, {"schedule", found.law}};
}

ExitStatus Run(ScheduleCommandOptions options) {
  PidCommandOptions& pid = options.pid;
  session::CheckOutputPath(pid.out_path, {});
  session::CheckOutputPath(pid.html_path, {});
  session::CheckOutputPath(pid.loop.json_path, {});
  const auto weights = DesignOf(pid.gate);
  auto rig = LoadRig(pid.loop);
  const std::string delay = TakeDelayOfPort(pid.loop, rig);
  if (rig.numbers.max_speed_rad_per_s <= 0.0 || rig.numbers.axes() < 2)
    throw BadInput(rig.numbers.name + ": a rig that does not turn has no law over speed");
  const auto template_controller = LoadController(pid.loop, rig);
  fmt::print("rig {}; protections from {}\n{}", rig.numbers.name, template_controller.path, delay);
  const std::vector<NamedLaw> laws =
      options.laws.empty() ? Search(options, rig) : FromFiles(options, rig);
  const law::LawConfig& table = laws.back().law;
  const std::vector<LawOverSpeed> figures = FiguresOverSpeed(rig, laws);
  PrintOverSpeed(figures);
  const auto result = JudgeAndPrint(rig, table, pid.gate, weights.analysis);
  const configuration::ControllerFile file{rig.numbers.name + "_schedule", table,
                                           template_controller.file.supervisor};
  auto written =
      WriteJudged(pid.out_path, "amb design schedule", pid.gate.seed, file, rig.numbers, result);
  if (!pid.html_path.empty())
    WriteTextFile(pid.html_path, SchedulePage(rig, figures, table, result));
  written.push_back(pid.html_path);
  auto json = GateJson(result);
  json["laws"] = OverSpeedJson(figures);
  WriteJsonFile(pid.loop.json_path, json);
  written.push_back(pid.loop.json_path);
  TellWritten(written);
  return result.accepted ? ExitStatus::kDone : ExitStatus::kOther;
}

}  // namespace

void AddDesignSchedule(CLI::App& design, Action& action) {
  auto options = std::make_shared<ScheduleCommandOptions>();
  PidCommandOptions& pid = options->pid;
  CLI::App* command = design.add_subcommand(
      "schedule",
      "Law over speed: PIDs searched for several speeds, or laws of files, beside one law for all");
  AddRigOption(*command, pid.loop);
  AddControllerOption(*command, pid.loop);
  AddPortOption(*command, pid.loop);
  command
      ->add_option("--speeds", options->speeds_rpm,
                   "Speeds of the table [rpm], rising; rest belongs to it; default: half and full "
                   "rated speed")
      ->check(CLI::Range(0.0, 1e6));
  CLI::Option* law = command->add_option("--law", options->laws,
                                         "RPM:CONTROLLER, an entry of the table from a file, "
                                         "instead of a search; once for each speed, "
                                         "rising; the first holds from rest");
  command->add_option("--out", pid.out_path, "Controller file to write when accepted");
  command->add_option("--html", pid.html_path,
                      "Page to write: |S| and damping over speed, of the table and without it");
  AddPidSearchOptions(*command, pid);
  for (const char* of_search :
       {"--speeds", "--evaluations", "--lead-lags", "--notches", "--shared-filters",
        "--sensitivity", "--corner-sensitivity", "--complementary", "--control", "--singular-value",
        "--damping", "--standing-orbit", "--spinning-orbit", "--current", "--noise-current",
        "--stiffness", "--compliance"})
    law->excludes(command->get_option(of_search));
  AddGateOptions(*command, pid.gate);
  AddJsonOption(*command, pid.loop);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
