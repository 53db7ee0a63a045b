// amb replay: proves that a session repeats bit for bit, or shows what another controller would
// have commanded, or publishes it again over LCM.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands/command.hpp"
#include "cli/commands/replay_publisher.hpp"
#include "cli/commands/session_text.hpp"
#include "cli/commands/what_if_csv.hpp"
#include "cli/json_file.hpp"
#include "configuration/rig_file.hpp"
#include "rt/say.hpp"
#include "session/log/output_path.hpp"
#include "session/replay/replay.hpp"
#include "session/replay/what_if.hpp"

namespace levitas::cli {
namespace {

using Document = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

struct ReplayOptions {
  std::string session_path;
  std::string controller_name;
  std::string csv_path;
  std::string json_path;
  bool publish{};
  PublishOptions publishing;
};

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// How long the run took when it was recorded.
double RunSeconds(std::uint64_t cycles, const session::SessionHeader& header) {
  return static_cast<double>(cycles) * static_cast<double>(header.period_ns) * 1e-9;
}

void Print(const session::ReplayReport& report, double run_s, double took_s) {
  fmt::print(
      "{} cycles reproduced, every output bit ({:.3f} s of run in {:.3f} s: {:.0f} x real "
      "time)\n",
      report.reproduced, run_s, took_s, run_s / took_s);
  if (report.difference) {
    fmt::print("Cycle {} DIFFERS: {}: recorded {}, computed {}. The replay stops there.\n",
               report.different_cycle, report.difference->field, report.difference->recorded,
               report.difference->computed);
  }
  if (report.gap_cycle) {
    fmt::print(
        "Cycle {} is missing: the replay ends before it, for the controller's memory behind "
        "a gap is not known. {} records behind it were not judged.\n",
        *report.gap_cycle, report.behind_gap);
  }
}

ExitStatus Reproduce(const ReplayOptions& options) {
  session::SessionReader reader(options.session_path);
  fmt::print("{}\n", Describe(options.session_path, reader.header()));
  const auto config = session::RecordedConfig(reader.header(), options.session_path);
  const auto start = Clock::now();
  const session::ReplayReport report = session::Replay(reader, config, options.session_path);
  const double took_s = SecondsSince(start);
  const double run_s = RunSeconds(report.reproduced, reader.header());
  Print(report, run_s, took_s);
  PrintDamage(reader.damage());
  Document json{{"session", options.session_path},        {"identical", report.identical()},
                {"cycles_reproduced", report.reproduced}, {"run_s", run_s},
                {"times_real_time", run_s / took_s},      {"events", reader.events().size()},
                {"damage", DamageJson(reader.damage())}};
  if (report.difference) {
    json["difference"] = {{"cycle", report.different_cycle},
                          {"field", report.difference->field},
                          {"recorded", report.difference->recorded},
                          {"computed", report.difference->computed}};
  }
  if (report.gap_cycle) {
    json["gap"] = {{"cycle", *report.gap_cycle}, {"records_behind", report.behind_gap}};
  }
  WriteJsonFile(options.json_path, json);
  return report.identical() ? ExitStatus::kDone : ExitStatus::kOther;
}

void Print(const session::WhatIfReport& report) {
  fmt::print(
      "{} of {} cycles compared (both with energised coils); difference = other - recorded\n",
      report.compared, report.cycles);
  fmt::print("{:<10}{:>16}{:>14}{:>14}{:>14}{:>10}\n", "channel", "recorded rms A", "mean A",
             "rms A", "largest A", "at s");
  for (const auto& channel : report.channels) {
    fmt::print("{:<10}{:>16.6f}{:>14.6f}{:>14.6f}{:>14.6f}{:>10.4f}\n", channel.channel,
               channel.recorded_rms_a, channel.mean_a, channel.rms_a, channel.max_a,
               channel.max_time_s);
  }
  if (report.mode_differs > 0) fmt::print("modes differ in {} cycles\n", report.mode_differs);
  if (report.fault != Fault::kNone) {
    fmt::print("this controller would have tripped in cycle {}: {}\n", report.fault_cycle,
               Name(report.fault));
  }
}

Document WhatIfJson(const ReplayOptions& options, const session::WhatIfReport& report) {
  Document json{{"session", options.session_path},
                {"controller", options.controller_name},
                {"cycles", report.cycles},
                {"compared", report.compared},
                {"first_compared_cycle", report.first_compared_cycle},
                {"mode_differs", report.mode_differs},
                {"fault", std::string(Name(report.fault))},
                {"channels", Document::array()}};
  if (report.fault != Fault::kNone) json["fault_cycle"] = report.fault_cycle;
  for (const auto& channel : report.channels) {
    json["channels"].push_back({{"channel", channel.channel},
                                {"recorded_rms_a", channel.recorded_rms_a},
                                {"difference_mean_a", channel.mean_a},
                                {"difference_rms_a", channel.rms_a},
                                {"difference_max_a", channel.max_a},
                                {"difference_max_time_s", channel.max_time_s}});
  }
  return json;
}

ExitStatus Compare(const ReplayOptions& options) {
  session::SessionReader reader(options.session_path);
  fmt::print("{}\n", Describe(options.session_path, reader.header()));
  const std::string controller = configuration::FindConfig(options.controller_name, "controllers");
  const auto config = session::OtherConfig(reader.header(), options.session_path, controller);
  fmt::print("What {} would have commanded while the rotor moved as recorded:\n",
             rt::OneLine(controller));
  WhatIfCsv csv(options.csv_path, reader.header());
  const session::WhatIfReport report =
      session::WhatIf(reader, config, options.session_path,
                      [&csv](const auto& record, const auto& other) { csv.Add(record, other); });
  Print(report);
  PrintDamage(reader.damage());
  if (report.compared == 0) {
    throw BadInput(
        fmt::format("{}: in no cycle were both controllers levitating, nothing to "
                    "compare",
                    options.session_path));
  }
  csv.Finish();
  WriteJsonFile(options.json_path, WhatIfJson(options, report));
  return ExitStatus::kDone;
}

ExitStatus Republish(const ReplayOptions& options) {
  session::SessionReader reader(options.session_path);
  fmt::print(
      "{}\nPublishing on {} at {} x the recorded pace; a live controller or rig must not run "
      "on the same ports.\n",
      Describe(options.session_path, reader.header()), options.publishing.port,
      options.publishing.speed);
  std::fflush(stdout);
  const PublishReport report = Publish(reader, options.publishing);
  fmt::print("{} cycles and {} events published, {} messages failed\n", report.cycles,
             report.events, report.failed);
  if (report.gaps > 0) {
    fmt::print("{} gaps of more than {} s were shortened to that\n", report.gaps,
               kLongestWait.count());
  }
  PrintDamage(reader.damage());
  WriteJsonFile(options.json_path, {{"session", options.session_path},
                                    {"cycles", report.cycles},
                                    {"events", report.events},
                                    {"failed", report.failed},
                                    {"gaps", report.gaps},
                                    {"damage", DamageJson(reader.damage())}});
  return report.failed == 0 ? ExitStatus::kDone : ExitStatus::kOther;
}

ExitStatus Run(const ReplayOptions& options) {
  for (const std::string& path : {options.csv_path, options.json_path}) {
    session::CheckOutputPath(path, options.session_path);
  }
  if (options.publish) return Republish(options);
  return options.controller_name.empty() ? Reproduce(options) : Compare(options);
}

}  // namespace

void AddReplayCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay",
      "Repeats a session bit for bit; or another controller on it; or publishes it again");
  command->add_option("SESSION", options->session_path, "Session to replay")->required();
  CLI::Option* controller =
      command->add_option("--controller", options->controller_name,
                          "What this controller would have commanded instead");
  command->add_option("--csv", options->csv_path, "Recorded and other currents, cycle by cycle")
      ->needs(controller);
  CLI::Option* publish =
      command
          ->add_flag("--publish", options->publish,
                     "Publish over LCM at the recorded pace; in a gap 2 s are waited at most")
          ->excludes(controller);
  command->add_option("--speed", options->publishing.speed, "Factor on the recorded pace")
      ->needs(publish)
      ->check(CLI::Range(1e-3, 1e3));
  command->add_option("--port", options->publishing.port, "lcm or lcm:URL")->needs(publish);
  command
      ->add_option("--key", options->publishing.key,
                   "File with the key of those who may speak on that network (amb key)")
      ->needs(publish);
  command->add_option("--json", options->json_path, "Write the result as JSON");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
