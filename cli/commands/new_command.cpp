// amb new rig: a first rig file, controller and scenarios from the numbers known of a rotor.

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/speed_sweep.hpp"
#include "cli/commands/command.hpp"
#include "cli/json_file.hpp"
#include "cli/new_rig/ask.hpp"
#include "cli/new_rig/rig_sketch.hpp"
#include "cli/new_rig/start_law.hpp"
#include "cli/new_rig/strength.hpp"
#include "cli/new_rig/test_signal.hpp"
#include "cli/run/loop_warning.hpp"
#include "cli/text_file.hpp"
#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNewRigHelp =
    "Six numbers make a rig that runs: what is not said is asked for on a terminal. Everything "
    "else "
    "is assumed, and said to be in the file. The strength of a magnet is --ki-n-per-a, or "
    "--ks-n-per-m, or --turns with --pole-area-mm2 (poles at 22.5 degrees).\n"
    "  amb new rig spindle --mass-kg 8 --length-mm 600 --speed-rpm 12000 --gap-mm 0.4 --bias-a 2 "
    "--ki-n-per-a 60 --bearings-mm 120,460 --disc 585:1.5:180 --amplifier-hz 2000\n"
    "  amb run --rig spindle/spindle.yaml";

constexpr Question kMass{"--mass-kg", "mass of all that turns [kg]", 0.01, 50'000.0};
constexpr Question kLength{"--length-mm", "length of the rotor [mm]", 10.0, 20'000.0};
constexpr Question kSpeed{"--speed-rpm", "top speed [rpm]", 1.0, 300'000.0};
constexpr Question kGap{"--gap-mm", "air gap of the magnets, radial [mm]", 0.02, 10.0};
constexpr Question kBias{"--bias-a", "bias current [A]", 0.01, 100.0};
constexpr Question kForce{"--ki-n-per-a", "force per control current of one axis, ki [N/A]", 0.01,
                          1e5};
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct NewRigOptions {
  RigSketch sketch{.name = {},
                   .mass_kg = kNone,
                   .length_mm = kNone,
                   .max_speed_rpm = kNone,
                   .ki_n_per_a = kNone,
                   .gap_mm = kNone,
                   .bias_a = kNone,
                   .bearings_mm = {},
                   .discs = {}};
  double ks_n_per_m{kNone};
  double turns{kNone};
  double pole_area_mm2{kNone};
  std::vector<std::string> discs;
  std::string out;
  std::string json_path;
  bool overwrite{false};
};

struct NewRigFiles {
  fs::path rig, controller, scenario, identify;
};

NewRigFiles NewRigFilesOf(const NewRigOptions& options) {
  const fs::path folder = options.out.empty() ? options.sketch.name : options.out;
  const std::string& name = options.sketch.name;
  return {folder / (name + ".yaml"), folder / (name + "_controller.yaml"),
          folder / (name + "_scenario.yaml"), folder / (name + "_identify.yaml")};
}

void TakeStrength(NewRigOptions& options) {
  RigSketch& sketch = options.sketch;
  if (!std::isnan(options.ks_n_per_m)) {
    sketch.ki_n_per_a = options.ks_n_per_m * 1e-3 * sketch.gap_mm / sketch.bias_a;
  } else if (!std::isnan(options.turns)) {
    sketch.turns = options.turns;
    sketch.pole_area_mm2 = options.pole_area_mm2;
    const auto law =
        magnet::LawOfPoles(options.turns, 1e-6 * options.pole_area_mm2,
                           kHalfPoleAngleDeg * std::numbers::pi / 180.0, 1e-3 * sketch.gap_mm);
    sketch.ki_n_per_a =
        4.0 * law.force_constant_n_m2_per_a2 * sketch.bias_a / (law.gap_m * law.gap_m);
  }
}

/// What the strength was given by, as a person typed it.
std::string StrengthOption(const NewRigOptions& options) {
  if (!std::isnan(options.ks_n_per_m)) return fmt::format("--ks-n-per-m {:g}", options.ks_n_per_m);
  if (!std::isnan(options.turns)) {
    return fmt::format("--turns {:g} --pole-area-mm2 {:g}", options.turns, options.pole_area_mm2);
  }
  return fmt::format("--ki-n-per-a {:g}", options.sketch.ki_n_per_a);
}

/// Asks for what is missing; without a terminal that is a usage problem that names all of it.
void Complete(NewRigOptions& options) {
  RigSketch& sketch = options.sketch;
  const bool strength = !std::isnan(options.ks_n_per_m) || !std::isnan(options.turns);
  std::vector<std::pair<const Question*, double*>> asked{{&kMass, &sketch.mass_kg},
                                                         {&kLength, &sketch.length_mm},
                                                         {&kSpeed, &sketch.max_speed_rpm},
                                                         {&kGap, &sketch.gap_mm},
                                                         {&kBias, &sketch.bias_a}};
  if (!strength) asked.emplace_back(&kForce, &sketch.ki_n_per_a);
  std::string missing;
  for (const auto& [question, value] : asked) {
    if (std::isnan(*value)) missing += fmt::format(" {}", question->option);
  }
  if (!missing.empty() && (isatty(STDIN_FILENO) != 1 || isatty(STDERR_FILENO) != 1)) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("missing:{}. On a terminal they are asked for; see amb new rig --help",
                    missing));
  }
  for (const auto& [question, value] : asked) {
    if (std::isnan(*value)) *value = Ask(*question, stdin, stderr);
  }
  TakeStrength(options);
}

/// "585:1.5:180": place, mass, diameter.
SketchDisc ParseDisc(const std::string& text) {
  std::array<double, 3> values{};
  constexpr std::array<Question, 3> kParts{{{"--disc", "place", 0.0, 20'000.0},
                                            {"--disc", "mass", 1e-6, 50'000.0},
                                            {"--disc", "diameter", 0.1, 10'000.0}}};
  std::string rest = text;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto end = rest.find(':');
    if ((end == std::string::npos) != (i == 2)) {
      throw Problem(ExitStatus::kUsage,
                    fmt::format("--disc '{}': allowed Z_MM:MASS_KG:DIAMETER_MM", text));
    }
    const std::string why = WhyNoNumber(kParts[i], rest.substr(0, end), values[i]);
    if (!why.empty()) {
      throw Problem(ExitStatus::kUsage,
                    fmt::format("--disc '{}': {} {}", text, kParts[i].text, why));
    }
    rest = i < 2 ? rest.substr(end + 1) : std::string{};
  }
  return {values[0], values[1], values[2]};
}

void RefuseExisting(const NewRigOptions& options, const NewRigFiles& files) {
  for (const fs::path& path : {files.rig, files.controller, files.scenario, files.identify}) {
    std::error_code none;
    if (options.overwrite || !fs::exists(path, none)) continue;
    throw Problem(ExitStatus::kUsage,
                  fmt::format("{}: is there already; --overwrite replaces it", path.string()));
  }
}

/// Makes the folder and writes the four texts, which were read as any file of ours is.
void WriteFiles(const NewRigFiles& files, const std::array<std::string, 4>& texts) {
  std::error_code failed;
  fs::create_directories(files.rig.parent_path(), failed);
  if (failed) {
    throw BadInput(
        fmt::format("{}: cannot be made: {}", files.rig.parent_path().string(), failed.message()));
  }
  WriteTextFile(files.rig.string(), texts[0], Earlier::kReplaced);  // --overwrite said so
  WriteTextFile(files.controller.string(), texts[1], Earlier::kReplaced);
  WriteTextFile(files.scenario.string(), texts[2], Earlier::kReplaced);
  if (!texts[3].empty()) {
    WriteTextFile(files.identify.string(), texts[3], Earlier::kReplaced);
  }
}

/// Of a stable loop: how good it is.
std::string PeakText(const configuration::RigFile& rig, const law::LawConfig& law) {
  const auto sweep =
      analysis::SensitivityOverSpeed(rig.plant, law, rig.numbers.max_speed_rad_per_s);
  const analysis::SensitivityResult& worst = sweep.speeds[sweep.worst];
  const auto& axis = worst.axes[analysis::WorstAxis(worst)];
  return fmt::format(
      "the loop is stable; its largest |S| is {:.2f} at {:.0f} rpm, zone {} of ISO "
      "14839-3 (amb margins)",
      axis.peak, RadPerSToRpm(worst.speed_rad_per_s),
      worst.zone ? analysis::Name(*worst.zone) : "none");
}

/// What the loop is like, the test signals that it bears, and what to type.
void PrintWhatNext(const NewRigOptions& options, const configuration::RigFile& rig,
                   const NewRigFiles& files, const TestSignal& signal, const std::string& loop) {
  const std::string rig_file = files.rig.string();
  if (signal.amplitude_a == 0.0) {
    fmt::print(
        "no test signals: the first law does not hold the rotor\n{}\n"
        "next: check what says (assumed) in {}; a law that holds it: amb design pid --rig {} --out "
        "pid.yaml\n",
        loop, rig_file, rig_file);
    return;
  }
  fmt::print(
      "{}: test signals of {:.3g} A, {:.0f} s of the rig's time\n{}\n"
      "next: check what says (assumed) in {}; amb modes --rig {}; amb run --rig {}; a law with "
      "more margin: amb design pid --rig {} --out pid.yaml\n"
      "to measure modes, ki and ks: amb run --rig {} --scenario {} --record id.lcm, then amb "
      "identify modal id.lcm\n",
      files.identify.string(), signal.amplitude_a, DurationOf(options.sketch, rig, signal), loop,
      rig_file, rig_file, rig_file, rig_file, rig_file, files.identify.string());
}

/// What the options give, read back as any file of ours is.
struct DrawnRig {
  configuration::RigFile rig;
  law::LawConfig law;
  std::array<std::string, 4> texts;
  TestSignal signal;
  std::string unstable;  ///< what grows, in words; empty: nothing
};

DrawnRig Draw(const RigSketch& sketch, const NewRigFiles& files) {
  DrawnRig drawn;
  drawn.texts = {
      SketchRig(sketch, files.controller.filename().string(), files.scenario.filename().string()),
      {},
      SketchScenario(sketch),
      {}};
  drawn.rig = configuration::ParseRig(drawn.texts[0], files.rig.string());
  const configuration::RigFile& rig = drawn.rig;
  drawn.texts[1] = SketchController(sketch, ChooseStartLaw(sketch, rig));
  const auto controller =
      configuration::ParseController(drawn.texts[1], files.controller.string(), rig.numbers);
  drawn.law = controller.law;
  const auto scenario =
      configuration::ParseScenario(drawn.texts[2], files.scenario.string(), rig.numbers);
  drawn.unstable = UnstableLoop(rig, drawn.law, ScenarioSpeeds(scenario), files.rig.string(),
                                files.controller.string());
  if (drawn.unstable.empty()) {
    drawn.signal = TestSignalOf(rig, drawn.law);
    drawn.texts[3] = SketchIdentify(sketch, rig, drawn.signal);
    static_cast<void>(
        configuration::ParseScenario(drawn.texts[3], files.identify.string(), rig.numbers));
  }
  return drawn;
}

/// A refusal names keys of files that were never written: it must lead back to the options.
DrawnRig DrawOrTellOptions(const RigSketch& sketch, const NewRigFiles& files) {
  try {
    return Draw(sketch, files);
  } catch (const BadInput& problem) {
    throw BadInput(fmt::format(
        "the numbers given make a rig beyond what its files can hold, and no file is written. "
        "Change the options that these keys come from (amb new rig --help):\n{}",
        problem.what()));
  }
}

ExitStatus Make(NewRigOptions options) {
  for (const std::string& text : options.discs) options.sketch.discs.push_back(ParseDisc(text));
  session::CheckOutputPath(options.json_path, {});
  const NewRigFiles files = NewRigFilesOf(options);
  RefuseExisting(options, files);
  Complete(options);
  RefuseStrength(options.sketch, StrengthOption(options));
  const SketchNumbers numbers = NumbersOf(options.sketch);
  RefuseDiameter(options.sketch, numbers);
  RefuseOverload(options.sketch, numbers);
  const DrawnRig drawn = DrawOrTellOptions(options.sketch, files);
  WriteFiles(files, drawn.texts);
  fmt::print(
      "{}: rig {}, {:.6g} kg on {:.6g} mm, a shaft of {:.4g} mm; ki {:.4g} N/A, ks {:.4g} N/m\n",
      files.rig.string(), drawn.rig.numbers.name, options.sketch.mass_kg, options.sketch.length_mm,
      numbers.diameter_mm, options.sketch.ki_n_per_a, numbers.ks_n_per_m);
  fmt::print("{}", LoadsText(options.sketch, numbers));
  fmt::print("{}: a start for its law\n{}: lift, {:.6g} rpm, stop, land\n",
             files.controller.string(), files.scenario.string(), options.sketch.max_speed_rpm);
  PrintWhatNext(options, drawn.rig, files, drawn.signal,
                drawn.unstable.empty() ? PeakText(drawn.rig, drawn.law) : drawn.unstable);
  WriteJsonFile(options.json_path,
                {{"rig", files.rig.string()},
                 {"controller", files.controller.string()},
                 {"scenario", files.scenario.string()},
                 {"identify", drawn.texts[3].empty() ? "" : files.identify.string()},
                 {"excitation_a", drawn.signal.amplitude_a},
                 {"stable", drawn.unstable.empty()},
                 {"shaft_diameter_m", 1e-3 * numbers.diameter_mm},
                 {"centre_m", 1e-3 * numbers.centre_mm},
                 {"ki_n_per_a", options.sketch.ki_n_per_a},
                 {"ks_n_per_m", numbers.ks_n_per_m},
                 {"carried_kg", numbers.carried_kg}});
  return ExitStatus::kDone;
}

CLI::Option* AddNumber(CLI::App& command, const Question& question, double& value) {
  return command.add_option(question.option, value, question.text)
      ->check(CLI::Validator(
          [question](const std::string& text) {
            double ignored = 0.0;
            return WhyNoNumber(question, text, ignored);
          },
          ""));
}

void AddMagnet(CLI::App& command, NewRigOptions& o) {
  AddNumber(command, kGap, o.sketch.gap_mm);
  AddNumber(command, kBias, o.sketch.bias_a);
  auto* ki = AddNumber(command, kForce, o.sketch.ki_n_per_a);
  auto* ks = AddNumber(command,
                       {"--ks-n-per-m",
                        "instead of ki: negative stiffness of one axis, as a "
                        "positive number [N/m]; ki = ks gap / bias",
                        1.0, 1e10},
                       o.ks_n_per_m)
                 ->excludes(ki);
  auto* turns =
      AddNumber(command, {"--turns", "instead of ki: turns of one coil", 1.0, 10'000.0}, o.turns)
          ->excludes(ki)
          ->excludes(ks);
  auto* area =
      AddNumber(command, {"--pole-area-mm2", "with --turns: face of one pole [mm2]", 0.1, 1e6},
                o.pole_area_mm2)
          ->needs(turns);
  turns->needs(area);
}

void AddOptions(CLI::App& command, NewRigOptions& o) {
  command.add_option("NAME", o.sketch.name, "Of the rig: a-z, 0-9 and _")->required();
  AddNumber(command, kMass, o.sketch.mass_kg);
  AddNumber(command, kLength, o.sketch.length_mm);
  AddNumber(command, kSpeed, o.sketch.max_speed_rpm);
  AddMagnet(command, o);
  AddNumber(command, {"--rate-hz", "sampling rate [Hz]", 100.0, 100'000.0}, o.sketch.rate_hz)
      ->capture_default_str();
  AddNumber(command, {"--delay-samples", "from a reading to its current, in periods", 0.0, 10.0},
            o.sketch.delay_samples)
      ->capture_default_str();
  AddNumber(command, {"--amplifier-hz", "bandwidth of the current loop [Hz]", 10.0, 100'000.0},
            o.sketch.amplifier_hz)
      ->capture_default_str();
  command
      .add_option(
          "--bearings-mm", o.sketch.bearings_mm,
          "Places of the two magnets along the rotor, by a comma [mm]; default: 15 and 85 % "
          "of the length")
      ->delimiter(',')
      ->expected(2)
      ->check(CLI::Range(0.0, 20'000.0));
  command.add_option("--disc", o.discs,
                     "Wheel or disc on the shaft, Z_MM:MASS_KG:DIAMETER_MM; may be repeated");
  command.add_flag("--vertical", o.sketch.vertical, "The shaft stands: no weight on the magnets");
  command.add_option("--out", o.out, "Folder for the four files; default: NAME");
  command.add_flag("--overwrite", o.overwrite, "Replace files that are there already");
  command.add_option("--json", o.json_path, "Also write what was made to this file");
}

}  // namespace

void AddNewCommand(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("new", "Files to start with");
  command->require_subcommand(1);
  auto options = std::make_shared<NewRigOptions>();
  CLI::App* rig = command->add_subcommand(
      "rig", "A first rig file of your rotor, with controller and scenarios, from six numbers");
  rig->footer(kNewRigHelp);
  AddOptions(*rig, *options);
  rig->callback([options, &action] { action = [options] { return Make(*options); }; });
}

}  // namespace levitas::cli
