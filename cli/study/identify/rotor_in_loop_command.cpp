// amb identify rotor-in-loop: force of current and position, rotor and sensors, fitted to the free
// run of the closed loop.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/options/rig_of_records.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/identify/sensor_options.hpp"
#include "cli/study/written_files.hpp"
#include "common/problem.hpp"
#include "identification/nonlinear/loop_record.hpp"
#include "identification/nonlinear/suspended_rotor_fit.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace identification;
using Index = Eigen::Index;

constexpr const char* kRotorInLoopHelp =
    "From a session in which all axes of a standing rotor are excited at once. The model runs free "
    "from the first excited row, the rig's controller closes its loop, and it sees nothing but the "
    "excitation; rows that are not fitted judge it. The rig file gives the start: magnets, "
    "amplifiers and modes; sensors must be at the magnets.\n"
    "  amb run --rig turbomolecular_pump --scenario turbomolecular_pump_identify --record "
    "pump.lcm\n"
    "  amb identify rotor-in-loop pump.lcm --rig turbomolecular_pump";

struct CommandOptions : AnalysisOptions {
  std::string data_path;
  SensorOptions sensors;
  Index fitted{40'000};
  Index skip{5000};
  Index iron{3};
};

void PrintFit(const char* rows, const Series& series, const Eigen::MatrixXd& run, Index from,
              Index count, nlohmann::ordered_json& json) {
  const Eigen::MatrixXd measured = series.output.middleRows(from, count);
  const Eigen::MatrixXd predicted = run.middleRows(from, count);
  const Eigen::VectorXd fit = FitPercent(measured, predicted, 0);
  const Eigen::VectorXd rms_m = RmsError(measured, predicted, 0);
  for (Index i = 0; i < fit.size(); ++i) {
    fmt::print("{:<10}{:<18}{:<12}{:>12.4f} um{:>12.2f} %\n", rows,
               fmt::format("{}:{}", from, from + count),
               series.output_names[static_cast<std::size_t>(i)], 1e6 * rms_m[i], fit[i]);
    json[rows]["rms_m"].push_back(rms_m[i]);
    json[rows]["fit_percent"].push_back(fit[i]);
  }
}

void PrintModel(const SuspendedRotor& model, const Series& series, nlohmann::ordered_json& json) {
  fmt::print("\n{:<12}{:>14}{:>10}{:>12}{:>12}   {}\n", "axis", "amplifier Hz", "gap um",
             "offset A", "imbalance", "iron a1 ..");
  for (std::size_t a = 0; a < model.axis.size(); ++a) {
    const AxisForce& axis = model.axis[a];
    fmt::print("{:<12}{:>14.1f}{:>10.2f}{:>12.5f}{:>12.5f}  ", series.output_names[a],
               axis.amplifier_hz, 1e6 * axis.gap_m, axis.offset_a, axis.imbalance);
    for (const double value : axis.iron) fmt::print(" {:.4f}", value);
    fmt::print("\n");
    json["axes"].push_back({{"channel", series.output_names[a]},
                            {"amplifier_hz", axis.amplifier_hz},
                            {"gap_m", axis.gap_m},
                            {"offset_a", axis.offset_a},
                            {"imbalance", axis.imbalance},
                            {"iron", std::vector<double>(axis.iron.begin(), axis.iron.end())}});
  }
  for (std::size_t p = 0; p < 2; ++p) {
    for (const RotorMode& mode : model.plane[p]) {
      if (!(mode.frequency_hz > 0.0)) continue;
      const char* plane = p == 0 ? "x" : "y";
      fmt::print("bending mode in {}: {:.2f} Hz, damping ratio {:.5f}\n", plane, mode.frequency_hz,
                 mode.damping_ratio);
      json["modes"].push_back({{"plane", plane},
                               {"frequency_hz", mode.frequency_hz},
                               {"damping_ratio", mode.damping_ratio}});
    }
  }
}

ExitStatus Run(const CommandOptions& given) {
  session::CheckOutputPath(given.json_path, given.data_path);
  const configuration::RigFile rig = LoadRigOfRecords(given, {given.data_path});
  const configuration::ControllerFile controller = LoadController(given, rig).file;
  SuspendedRotor start = DesignOf(plant::Reduce(rig.plant), given.iron);
  const auto sensors = SensorsOf(given.sensors, start.axes());
  if (!sensors.empty()) start.sensor = sensors;
  LoopRecord record = ReadLoopRecord(given.data_path, rig);
  const Index rows = record.series.rows();
  const Index fitted = std::min(given.fitted, rows);
  if (!controller.law.schedule.empty()) {
    throw BadInput(controller.name +
                   ": a law over speed; this identification runs one law for the whole record: "
                   "give --controller the law of the record's speed");
  }
  const KnownLoop loop(controller.law, rig.numbers, std::move(record.excitation));
  const auto began = std::chrono::steady_clock::now();
  const SuspendedRotorFit fit =
      FitSuspendedRotor(start, Slice(record.series, {0, static_cast<std::size_t>(fitted)}),
                        [&] { return loop.AtRest(); }, {.skip = given.skip});
  const double time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print("{}: {} unknowns, {} iterations, {:.1f} s; {} rows from the first excited one\n\n",
             given.data_path, fit.unknowns, fit.iterations, time_s, rows);
  nlohmann::ordered_json json{{"data", given.data_path},
                              {"unknowns", fit.unknowns},
                              {"iterations", fit.iterations},
                              {"time_s", time_s}};
  fmt::print("{:<10}{:<18}{:<12}{:>15}{:>14}\n", "", "rows", "output", "free run rms", "fit");
  const Prediction run = RunFree(fit.model, rows, loop.AtRest());
  PrintFit("fitted", record.series, run.output, given.skip, fitted - given.skip, json);
  if (rows > fitted) PrintFit("test", record.series, run.output, fitted, rows - fitted, json);
  PrintModel(fit.model, record.series, json);
  WriteJsonFile(given.json_path, json);
  TellWritten({given.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyRotorInLoop(CLI::App& identify, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = identify.add_subcommand(
      "rotor-in-loop", "Force of current and position, rotor and sensors, in the known loop");
  command->footer(kRotorInLoopHelp);
  command->add_option("SESSION", options->data_path, "A recorded session")->required();
  AddRigOfRecordsOption(*command, *options);
  AddControllerOption(*command, *options);
  command->add_option("--fitted", options->fitted, "Rows that are fitted; those behind them judge")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--skip", options->skip, "Rows until a free run has forgotten its start")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--iron", options->iron, "Coefficients of the curve of the magnets' iron")
      ->check(CLI::Range(0, 6))
      ->capture_default_str();
  AddSensorOptions(*command, options->sensors);
  AddJsonOption(*command, *options);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
