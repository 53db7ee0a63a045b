// amb trend: the condition of geared shafts over sessions.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "cli/commands/command.hpp"
#include "cli/commands/trend_text.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/options/svg_option.hpp"
#include "common/rotational_speed.hpp"
#include "rt/say.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/output_path.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrendHelp =
    "Sessions of one geared rig, the oldest first, each at least five repeats of all wheels long "
    "at "
    "a speed that all hold. From each the part that turns with a wheel but is neither its teeth's "
    "regular engagement nor what shafts do once, twice or three times a turn: a tooth that is "
    "unlike the others makes it. The first sessions (--baseline) count as healthy; five "
    "deviations above them in at least two lines is a rise. Sessions with another speed, law, "
    "rig "
    "(but for its effects), rig events, static load or level of the mesh lines are not compared; "
    "one that comes twice, or before an older one, is refused.\n"
    "  amb trend monday.lcm tuesday.lcm wednesday.lcm thursday.lcm --speed-rpm 1740";

struct TrendOptions : AnalysisOptions {
  std::vector<std::string> paths;
  std::optional<double> speed_rpm;
  std::size_t baseline{3};
  std::string svg_path;
};

/// What must be the same in all sessions. Of a file that is no session nothing is known.
struct Setting {
  bool known{};
  configuration::RigFile
      rig;  ///< without its effects: what has become of the rig is what is asked for
  std::string controller, events;
  std::int64_t start_utc_ns{};  ///< of a session made by import: of that

  [[nodiscard]] bool HasLaw() const noexcept { return !controller.empty(); }
};

/// A file of configuration without the line that names it.
std::string WithoutName(const std::string& text) {
  const std::size_t at = text.find("\nname:");
  if (at == std::string::npos) return text;
  const std::size_t end = text.find('\n', at + 1);
  return text.substr(0, at) + (end == std::string::npos ? "" : text.substr(end));
}

/// The events of a scenario, which loads and switches are among.
std::string EventsOf(const std::string& scenario) {
  const std::size_t at = scenario.find("\nrig_events:");
  return at == std::string::npos ? "" : scenario.substr(at);
}

struct Loaded {
  configuration::RigFile rig;
  Setting setting;
  session::Recording recording;
};

configuration::RigFile WithoutEffects(configuration::RigFile rig) {
  rig.plant.effects.clear();
  return rig;
}

/// That the rig of --rig is not the one that was recorded.
void WarnOfOtherRig(const std::string& path, const Setting& recorded,
                    const configuration::RigFile& rig) {
  const std::string difference =
      RigDifference(recorded.rig, WithoutEffects(rig), {"in the session", "in --rig"});
  if (difference.empty()) return;
  rt::Say(fmt::format("amb: warning: {} was recorded with another rig than --rig {} ({})",
                      rt::OneLine(path), rt::OneLine(rig.numbers.name), difference));
}

Loaded LoadOne(const std::string& path, const TrendOptions& options) {
  Loaded one;
  const bool rig_given = !options.rig_name.empty();
  if (rig_given) one.rig = LoadRig(options);
  if (session::IsSession(path)) {
    const session::SessionReader reader(path);
    const session::SessionHeader& header = reader.header();
    configuration::RigFile recorded = configuration::ParseRig(header.rig_yaml, path + " (header)");
    one.setting = {true, WithoutEffects(recorded), WithoutName(header.controller_yaml),
                   EventsOf(header.scenario_yaml), header.start_utc_ns};
    if (rig_given) {
      WarnOfOtherRig(path, one.setting, one.rig);
    } else {
      one.rig = std::move(recorded);
    }
  } else if (!rig_given) {
    throw Problem(ExitStatus::kUsage, path + " does not say of which rig it is: name it, --rig");
  }
  if (one.rig.plant.gears.empty()) {
    throw Problem(ExitStatus::kBadInput,
                  fmt::format("{}: rig {} has no gears, of whose condition this command speaks; "
                              "`amb compare` sets any sessions side by side",
                              path, one.rig.numbers.name));
  }
  one.recording = session::LoadRecording(path, one.rig);
  return one;
}

/// Stretches of one session with the condition of each.
using Held = std::vector<analysis::GearCondition>;

Held MeasureAll(const Loaded& one) {
  constexpr double kLeast_s = 0.2;
  Held found;
  for (const auto& held : analysis::HeldSpeeds(one.recording, kLeast_s)) {
    found.push_back(analysis::MeasureGears(one.recording, held, one.rig.plant));
  }
  return found;
}

/// The longest stretch at the speed; none where it is not held.
const analysis::GearCondition* At(const Held& held, double speed_rad_per_s) {
  const analysis::GearCondition* best = nullptr;
  for (const auto& at : held) {
    const bool same =
        std::abs(at.speed_rad_per_s - speed_rad_per_s) <= 0.005 * std::abs(speed_rad_per_s);
    if (same && (best == nullptr || at.repeats > best->repeats)) best = &at;
  }
  return best;
}

std::string SpeedsOf(const Held& held) {
  std::string text;
  for (const auto& at : held) {
    text += fmt::format("{}{:.0f}", text.empty() ? "" : ", ", RadPerSToRpm(at.speed_rad_per_s));
  }
  return text.empty() ? "none" : text + " rpm";
}

bool HoldsLongEnough(const Held& held, double speed_rad_per_s) {
  const auto* at = At(held, speed_rad_per_s);
  return at != nullptr && at->repeats >= analysis::kLeastRepeats;
}

/// The speed that was asked for, or the fastest that all sessions hold long enough.
double CommonSpeed(const std::vector<Held>& all, const TrendOptions& options) {
  const auto everywhere = [&](double speed) {
    return std::ranges::all_of(all, [speed](const Held& h) { return HoldsLongEnough(h, speed); });
  };
  if (options.speed_rpm) {
    const double speed = RpmToRadPerS(*options.speed_rpm);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (HoldsLongEnough(all[i], speed)) continue;
      throw Problem(ExitStatus::kBadInput,
                    fmt::format("{}: --speed-rpm {:g} is not held for {} repeats of all wheels "
                                "without a test signal; it holds {}",
                                options.paths[i], *options.speed_rpm, analysis::kLeastRepeats,
                                SpeedsOf(all[i])));
    }
    return speed;
  }
  double fastest = 0.0;
  for (const auto& candidate : all.front()) {
    const double speed = candidate.speed_rad_per_s;
    if (std::abs(speed) > std::abs(fastest) && everywhere(speed)) fastest = speed;
  }
  if (fastest != 0.0) return fastest;
  throw Problem(
      ExitStatus::kBadInput,
      fmt::format("no speed is held by all sessions for {} repeats of all wheels without a test "
                  "signal; {} holds {}; record all at one speed, for {} repeats and {} s",
                  analysis::kLeastRepeats, options.paths.front(), SpeedsOf(all.front()),
                  analysis::kLeastRepeats, analysis::kSettleAtSpeedS));
}

/// A trend of sessions out of order, or of one that counts twice, would say nothing or hide a rise.
void RefuseDisorder(const std::vector<std::string>& paths, const std::vector<Setting>& settings) {
  for (std::size_t i = 1; i < paths.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const bool timed = settings[i].HasLaw() && settings[k].HasLaw();
      std::error_code none;
      if (timed ? settings[i].start_utc_ns == settings[k].start_utc_ns
                : fs::equivalent(paths[i], paths[k], none)) {
        throw Problem(ExitStatus::kUsage, fmt::format("{} and {} are the same run; allowed: each "
                                                      "session once",
                                                      paths[k], paths[i]));
      }
      if (timed && settings[i].start_utc_ns < settings[k].start_utc_ns) {
        throw Problem(ExitStatus::kUsage,
                      fmt::format("{} was recorded before {}, which stands before it; allowed: "
                                  "the oldest session first",
                                  paths[i], paths[k]));
      }
    }
  }
}

void AddReasons(const std::vector<Setting>& settings, FollowedSessions& followed) {
  const auto label = [&](auto setting) {
    return followed.sessions[static_cast<std::size_t>(setting - settings.begin())].label;
  };
  const auto first = std::ranges::find_if(settings, &Setting::known);
  const auto first_law = std::ranges::find_if(settings, &Setting::HasLaw);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Setting& here = settings[i];
    const auto differs = [&](const std::string& what, const std::string& whose) {
      followed.reasons.push_back(
          fmt::format("session {}: its {} is not that of {}", i + 1, what, whose));
    };
    if (here.known) {
      const std::string rig = RigDifference(first->rig, here.rig, {"there", "here"});
      if (!rig.empty()) differs("rig (effects left out; " + rig + ")", label(first));
    }
    if (!here.HasLaw()) {
      followed.not_known.push_back(
          fmt::format("{} of {}", here.known ? "law and rig events" : "rig, law and rig events",
                      followed.sessions[i].path));
      continue;
    }
    if (here.controller != first_law->controller) differs("controller file", label(first_law));
    if (here.events != first_law->events) differs("list of rig events", label(first_law));
  }
}

FollowedSessions Follow(const TrendOptions& options) {
  std::map<std::string, int> stems;
  for (const std::string& path : options.paths) ++stems[fs::path(path).stem().string()];
  FollowedSessions followed;
  std::vector<Held> all;
  std::vector<Setting> settings;
  plant::PlantConfig rig;
  for (const std::string& path : options.paths) {
    const Loaded one = LoadOne(path, options);
    const std::string stem = fs::path(path).stem().string();
    followed.sessions.push_back({path, stems[stem] > 1 ? path : stem, {}});
    all.push_back(MeasureAll(one));
    settings.push_back(one.setting);
    if (!followed.rig.empty()) continue;
    followed.rig = one.rig.numbers.name;
    rig = one.rig.plant;
  }
  RefuseDisorder(options.paths, settings);
  followed.speed_rad_per_s = CommonSpeed(all, options);
  std::vector<analysis::GearCondition> conditions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto* at = At(all[i], followed.speed_rad_per_s);
    conditions.push_back(at == nullptr ? analysis::GearCondition{} : *at);
    followed.sessions[i].condition = conditions.back();
  }
  followed.rule.baseline = options.baseline;
  followed.rule.loaded = std::all_of(rig.gears.begin(), rig.gears.end(), [](const auto& pair) {
    return pair.driving_torque_n_m > 0.0;
  });
  AddReasons(settings, followed);
  for (auto& reason : analysis::Reasons(conditions, rig)) followed.reasons.push_back(reason);
  if (followed.reasons.empty()) {
    followed.trends = analysis::FollowCondition(conditions, followed.rule);
  }
  return followed;
}

ExitStatus Run(const TrendOptions& options) {
  for (const std::string& path : options.paths) {
    session::CheckOutputPath(options.json_path, path);
    session::CheckOutputPath(options.svg_path, path);
  }
  const FollowedSessions followed = Follow(options);
  fmt::print("{}", TrendText(followed));
  svg::Write(options.svg_path, TrendFigure(followed));
  WriteJsonFile(options.json_path, TrendJson(followed));
  return ExitStatus::kDone;
}

}  // namespace

void AddTrendCommand(CLI::App& app, Action& action) {
  auto options = std::make_shared<TrendOptions>();
  options->rig_name.clear();
  CLI::App* command = app.add_subcommand(
      "trend", "Sessions of a geared rig in order of time: whether a tooth has begun to fail");
  command->footer(kTrendHelp);
  command
      ->add_option("SESSION", options->paths,
                   "Sessions, CSV or MAT files (docs/formats.md), the oldest first")
      ->required();
  command->add_option("--rig", options->rig_name,
                      "Rig file or shipped name; default: the one in the session, so that a file "
                      "that is no session needs it");
  command
      ->add_option("--speed-rpm", options->speed_rpm,
                   "Speed of the first shaft [rpm]; default: the fastest that all sessions hold")
      ->check(CLI::Range(1.0, 1e6));
  command
      ->add_option("--baseline", options->baseline,
                   "How many of the first sessions count as healthy")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  AddSvgOption(*command, options->svg_path, "amplitude over sessions, a panel per wheel");
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
