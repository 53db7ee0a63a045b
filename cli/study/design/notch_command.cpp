// amb design notch: a block of synchronous control for a controller file, with its T over speed.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "cli/json_file.hpp"
#include "cli/study/controller_output.hpp"
#include "cli/study/design/design_commands.hpp"
#include "cli/study/design/gate_options.hpp"
#include "cli/study/design/judged_law.hpp"
#include "cli/study/written_files.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/schema/unit.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
#include "design/drawn_rigs/rig_uncertainty.hpp"
#include "design/notch/notch_design.hpp"
#include "identification/frf/frequency_response.hpp"
#include "report/text/text_table.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

struct NotchOptions {
  AnalysisOptions loop;
  std::string name{"unbalance"};
  double order{1.0};
  std::string target{"current"};
  std::string direction{"all"};
  double from_rpm{}, to_rpm{};  ///< 0: a tenth of the rated speed, the rated speed
  double hysteresis_rpm{30.0};
  double time_constant_s{0.3};
  double largest_current_a{};  ///< 0: half of what the coils leave
  double most_growth{4.0};
  bool adaptive{};
  bool without_rotor{};
  std::vector<std::string> measured;
  std::string from{"tolerances"};
  std::size_t draws{20};
  std::uint64_t seed{1};
  std::string out_path;
};

/// As the file's reader takes it, so that what is written is the number that was given.
double SpeedOf(double rpm) {
  return *configuration::ToSi(fmt::format("{}", rpm), configuration::unit::kRpm);
}

/// Speeds between which no block could work.
void RefuseWindow(const synchronous::BlockConfig& block, const configuration::RigFile& rig) {
  if (!(block.from_rad_per_s > block.hysteresis_rad_per_s)) {
    throw Problem(
        ExitStatus::kUsage,
        "--from-rpm must be above --hysteresis-rpm: a block ends before the rotor stands");
  }
  if (!(block.to_rad_per_s > block.from_rad_per_s)) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("--to-rpm: found {:.6g}, must be above --from-rpm {:.6g}",
                    RadPerSToRpm(block.to_rad_per_s), RadPerSToRpm(block.from_rad_per_s)));
  }
  const double nyquist_rpm = RadPerSToRpm(std::numbers::pi / rig.numbers.period_s()) / block.order;
  if (RadPerSToRpm(block.to_rad_per_s + block.hysteresis_rad_per_s) >= nyquist_rpm) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("--to-rpm: order {:.6g} reaches half the sampling frequency at {:.0f} "
                    "rpm; choose a lower speed",
                    block.order, nyquist_rpm));
  }
}

design::NotchRequest RequestOf(const NotchOptions& options, const configuration::RigFile& rig) {
  design::NotchRequest request;
  synchronous::BlockConfig& block = request.block;
  const double rated = rig.numbers.max_speed_rad_per_s;
  if (!(rated > 0.0)) {
    throw BadInput(rig.numbers.name +
                   ": a rig that does not turn (run.max_speed_rpm 0) has nothing for a block of "
                   "synchronous control to take out");
  }
  block.name = options.name;
  block.order = options.order;
  block.target = options.target == "vibration" ? synchronous::Target::kVibration
                                               : synchronous::Target::kCurrent;
  block.time_constant_s = options.time_constant_s;
  block.from_rad_per_s = options.from_rpm > 0.0 ? SpeedOf(options.from_rpm) : 0.1 * rated;
  block.to_rad_per_s = options.to_rpm > 0.0 ? SpeedOf(options.to_rpm) : rated;
  block.hysteresis_rad_per_s = SpeedOf(options.hysteresis_rpm);
  block.adaptive = options.adaptive;
  request.most_growth = options.most_growth;
  if (options.without_rotor) request.knowledge = design::Knowledge::kBearings;
  const double limit_a = ControlLimitA(rig.numbers);
  block.largest_current_a =
      options.largest_current_a > 0.0 ? options.largest_current_a : 0.5 * limit_a;
  request.direction = options.direction == "forward"    ? design::Direction::kForward
                      : options.direction == "backward" ? design::Direction::kBackward
                                                        : design::Direction::kBoth;
  if (rig.numbers.axes() < 2 && request.direction != design::Direction::kBoth) {
    throw Problem(ExitStatus::kUsage, "--direction: the rig has one axis, which turns no way");
  }
  RefuseWindow(block, rig);
  return request;
}

void Print(const design::NotchFigures& figures, bool vibration) {
  report::TextTable table;
  table.Add({"rpm", "decay", "of drawn", "|z| of all", vibration ? "condition" : "growth",
             vibration ? "current A" : "orbit um", ""});
  const std::size_t step = std::max<std::size_t>(1, figures.speeds.size() / 12);
  bool refused = false;
  for (std::size_t i = 0; i < figures.speeds.size(); ++i) {
    const design::SpeedFigures& at = figures.speeds[i];
    const bool edge = refused == at.allowed();
    refused = !at.allowed();
    if (!edge && i % step != 0 && i + 1 != figures.speeds.size()) continue;
    const double size = vibration ? at.current_a : 1e6 * at.orbit_m;
    table.Add({fmt::format("{:.0f}", RadPerSToRpm(at.speed_rad_per_s)),
               fmt::format("{:.3f}", at.slowest_decay), fmt::format("{:.3f}", at.worst_decay),
               fmt::format("{:.6f}", at.largest_pole_modulus),
               fmt::format("{:.2f}", vibration ? at.condition : at.growth),
               size > 0.0 ? fmt::format("{:.3g}", size) : "", at.allowed() ? "" : "REFUSED"});
  }
  fmt::print("{}", table.Text());
  fmt::print(
      "decay: slowest of the block, 1 as its time constant says, below 0 it grows; |z|: largest of "
      "the whole sampled loop, drawn rigs included; {}\n",
      vibration ? "condition: of the answer; current: what the rig file's unbalance needs"
                : "growth: of the orbit at most; orbit: what the rig file's unbalance leaves");
  if (figures.not_held > 0) {
    fmt::print("{} of {} drawn rigs are not held by the law alone somewhere: not counted there\n",
               figures.not_held, figures.rigs);
  }
}

nlohmann::ordered_json Json(const synchronous::BlockConfig& block,
                            const design::NotchFigures& figures) {
  nlohmann::ordered_json json;
  json["name"] = block.name;
  json["order"] = block.order;
  json["target"] = block.target == synchronous::Target::kVibration ? "vibration" : "current";
  json["time_constant_s"] = block.time_constant_s;
  json["from_rpm"] = RadPerSToRpm(block.from_rad_per_s);
  json["to_rpm"] = RadPerSToRpm(block.to_rad_per_s);
  json["table_speeds"] = block.inverse.size();
  json["allowed"] = figures.allowed();
  json["refused"] = figures.RefusedSpeeds();
  json["drawn_rigs"] = figures.rigs;
  json["drawn_rigs_not_held"] = figures.not_held;
  for (const design::SpeedFigures& at : figures.speeds) {
    json["speeds"].push_back({{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)},
                              {"slowest_decay", at.slowest_decay},
                              {"slowest_decay_of_drawn", at.worst_decay},
                              {"largest_pole_modulus", at.largest_pole_modulus},
                              {"growth", at.growth},
                              {"condition", at.condition},
                              {"orbit_m", at.orbit_m},
                              {"orbit_alone_m", at.orbit_alone_m},
                              {"current_a", at.current_a},
                              {"allowed", at.allowed()},
                              {"refused", at.refused}});
  }
  return json;
}

std::string JudgedWith(const NotchOptions& options) {
  if (options.measured.empty()) {
    return fmt::format("{} drawn rigs of seed {}", options.draws, options.seed);
  }
  return fmt::format("what {} measured", fmt::join(options.measured, ", "));
}

/// In place of the block of its name, else behind the others.
void Put(synchronous::SynchronousConfig& control, const synchronous::BlockConfig& block) {
  const auto same = std::ranges::find(control.blocks, block.name, &synchronous::BlockConfig::name);
  if (same != control.blocks.end()) {
    *same = block;
    return;
  }
  if (control.blocks.size() == synchronous::kMaxBlocks) {
    throw BadInput(
        fmt::format("the controller has {} synchronous blocks already, allowed {}: "
                    "take one's --name to replace it",
                    control.blocks.size(), synchronous::kMaxBlocks));
  }
  control.blocks.push_back(block);
}

/// Beside the others of the file.
void RefuseSharedWork(const synchronous::SynchronousConfig& control,
                      const synchronous::BlockConfig& block) {
  for (const synchronous::BlockConfig& other : control.blocks) {
    if (other.name == block.name || !synchronous::ShareWork(other, block)) continue;
    throw BadInput(fmt::format(
        "block {} of the controller has the same order and acts from {:.0f} to {:.0f} rpm, "
        "hysteresis {:.0f} rpm: leave a gap between the two windows, or take its --name",
        other.name, RadPerSToRpm(other.from_rad_per_s), RadPerSToRpm(other.to_rad_per_s),
        RadPerSToRpm(other.hysteresis_rad_per_s)));
  }
}

/// Frequency responses of the records, by rising speed.
std::vector<design::MeasuredPlant> MeasuredOf(const NotchOptions& options,
                                              const configuration::RigFile& rig) {
  std::vector<design::MeasuredPlant> all;
  const double delay_s = rig.plant.delay_samples * rig.numbers.period_s();
  for (const std::string& path : options.measured) {
    for (auto& r : identification::EstimateResponses(session::LoadRecording(path, rig), delay_s)) {
      all.push_back({r.speed_rad_per_s, std::move(r.frequency_hz), std::move(r.plant)});
    }
  }
  std::ranges::sort(all, {}, &design::MeasuredPlant::speed_rad_per_s);
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].speed_rad_per_s - all[i - 1].speed_rad_per_s > RpmToRadPerS(1.0)) continue;
    throw BadInput(fmt::format("--measured: two responses at {:.0f} rpm; give one for each speed",
                               RadPerSToRpm(all[i].speed_rad_per_s)));
  }
  return all;
}

void PrintBlock(const design::NotchRequest& request, const std::string& target) {
  const synchronous::BlockConfig& block = request.block;
  fmt::print("block {}: order {:.6g}, target {}, {:.0f} to {:.0f} rpm, T at {} speeds\n",
             block.name, block.order, target, RadPerSToRpm(block.from_rad_per_s),
             RadPerSToRpm(block.to_rad_per_s), block.inverse.size());
  for (const design::MeasuredPlant& record : request.measured) {
    fmt::print(
        "T is of the answer measured at {:.0f} rpm, {:.2f} to {:.0f} Hz, and judged with it\n",
        RadPerSToRpm(record.speed_rad_per_s), record.frequency_hz.front(),
        record.frequency_hz.back());
  }
}

void RefuseUnlessAllowed(const design::NotchFigures& figures) {
  if (figures.allowed()) return;
  throw Problem(
      ExitStatus::kOther,
      fmt::format("refused at {}; allowed {}; nothing was written. Choose --from-rpm and --to-rpm "
                  "without the speeds refused; blocks of several windows stand in one file, by "
                  "--name",
                  figures.RefusedSpeeds(), figures.AllowedSpeeds()));
}

ExitStatus Run(const NotchOptions& options) {
  for (const std::string& path : {options.out_path, options.loop.json_path}) {
    session::CheckOutputPath(path, {});
  }
  const auto [rig, controller, delay] = LoadLoop(options.loop);
  design::NotchRequest request = RequestOf(options, rig);
  configuration::ControllerFile file = controller.file;
  RefuseSharedWork(file.synchronous, request.block);
  request.measured = MeasuredOf(options, rig);
  request.block = design::WithInverse(rig, file.law, request);
  const synchronous::BlockConfig& block = request.block;
  Put(file.synchronous, block);
  fmt::print("rig {}, controller {}\n{}", rig.numbers.name, ControllerText(controller), delay);
  PrintBlock(request, options.target);
  std::vector<configuration::RigFile> drawn;
  if (request.measured.empty()) {
    drawn =
        uncertainty::DrawRigs(rig, ParametersOf(rig, options.from), options.draws, options.seed);
  }
  const auto figures = design::JudgeNotch(rig, drawn, file.law, request);
  Print(figures, block.target == synchronous::Target::kVibration);
  WriteJsonFile(options.loop.json_path, Json(block, figures));
  RefuseUnlessAllowed(figures);
  if (!options.out_path.empty()) {
    WriteControllerFile(options.out_path,
                        fmt::format("# amb design notch: block {} accepted at every speed of its "
                                    "window, with {}\n",
                                    block.name, JudgedWith(options)),
                        file, rig.numbers);
  }
  TellWritten({options.out_path, options.loop.json_path});
  return ExitStatus::kDone;
}

/// What the block is.
void AddBlockOptions(CLI::App* command, const std::shared_ptr<NotchOptions>& options) {
  command->add_option("--name", options->name, "Of the block; one of this name is replaced")
      ->capture_default_str();
  command->add_option("--order", options->order, "Multiple of the shaft's angle")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command
      ->add_option("--target", options->target,
                   "What goes to zero: current (the rotor turns about its axis of inertia) or "
                   "vibration (about its centre)")
      ->check(CLI::IsMember({"current", "vibration"}))
      ->capture_default_str();
  command->add_option("--direction", options->direction, "What turns with the shaft, against it")
      ->check(CLI::IsMember({"all", "forward", "backward"}))
      ->capture_default_str();
  command->add_option("--from-rpm", options->from_rpm, "Acts from here; default: rated speed/10")
      ->check(CLI::Range(0.001, 1e6));
  command->add_option("--to-rpm", options->to_rpm, "To here; default: the rated speed")
      ->check(CLI::Range(0.001, 1e6));
  command->add_option("--hysteresis-rpm", options->hysteresis_rpm, "Beyond the window it ends")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--time-constant-s", options->time_constant_s, "Of what is left")
      ->check(CLI::Range(0.001, 100.0))
      ->capture_default_str();
  command
      ->add_option("--largest-current-a", options->largest_current_a,
                   "With --target vibration: beyond it the block ends; default: half of what the "
                   "coils leave")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--most-growth", options->most_growth,
                   "With --target current: the orbit may grow so many times at most")
      ->check(CLI::Range(1.0, 1000.0))
      ->capture_default_str();
  command->add_flag("--adaptive", options->adaptive, "T is corrected while the block runs");
}

}  // namespace

void AddDesignNotch(CLI::App& design, Action& action) {
  auto options = std::make_shared<NotchOptions>();
  CLI::App* command = design.add_subcommand(
      "notch", "Synchronous control for a controller: what turns, out of currents or positions");
  command->footer(
      "  amb design notch --target current --from-rpm 1500 --out quiet.yaml\n"
      "  amb run --controller quiet.yaml --scenario run_up_6000");
  AddRigOption(*command, options->loop);
  AddControllerOption(*command, options->loop);
  AddPortOption(*command, options->loop);
  AddBlockOptions(command, options);
  command->add_flag(
      "--without-rotor", options->without_rotor,
      "T from law, amplifier, sensor and delay alone: slower, and stable on any rotor "
      "of masses, springs and dampers with its sensors at the magnets, where the law "
      "damps");
  command
      ->add_option("--measured", options->measured,
                   "T from sessions in which each axis was excited (amb identify frf reads the "
                   "same), one for each speed, instead of the rig file's")
      ->excludes("--without-rotor");
  AddUncertaintyOption(*command, options->from);
  command->add_option("--draws", options->draws, "Rigs drawn for the judgement")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Of the draws")->capture_default_str();
  command->add_option("--out", options->out_path, "Controller file to write");
  AddJsonOption(*command, options->loop);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
