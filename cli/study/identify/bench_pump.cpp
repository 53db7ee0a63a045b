// amb bench pump: models of the levitated pump, compared with each other and with the noise floor.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmark/accuracy/identification/pump_trial.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "cli/study/identify/geared_commands.hpp"
#include "cli/text_file.hpp"

namespace levitas::cli {
namespace {

constexpr const char* kBenchPumpHelp =
    "The turbomolecular pump under the excitation of Chiu (2022), its magnets saturating and its "
    "sensors curved (the sensors' curve is known, as in the paper); fit in % on 4000 rows that "
    "were not fitted. A free run sees nothing but the excitation, the known controllers close its "
    "loop. The first ceiling counts the noise of the readings; the second, which no model can "
    "exceed, also what that noise does in the loop: it is the simulator itself without noise.\n"
    "Example: amb bench pump --noise-seed 7 --excitation-seed 7\n"
    "         amb bench pump --inputs test_signals --fit-free-run 60   (the paper's table)\n"
    "         amb bench pump --knee-a 0 --a2 0 --a3 0    (the pump as shipped)";

/// Chiu (2022), table 1: UX, UY, LX, LY.
struct Published {
  const char* model;
  std::array<double, 4> fit;
};
constexpr std::array<Published, 3> kPublished{{{"Hammerstein-Wiener", {92.11, 93.38, 91.51, 95.99}},
                                               {"NARX", {87.63, 88.88, 85.57, 91.34}},
                                               {"NARMAX", {75.91, 77.88, 78.32, 75.54}}}};

struct PumpOptions {
  accuracy::PumpPlan plan{
      .knee_a = 3.0, .a2_1_per_m = 1000.0, .a3_1_per_m2 = 1e7, .horizons = {5, 10, 20}};
  Eigen::Index iron{3};
  std::string inputs{"commanded"};
  std::string csv_path;
  std::string json_path;
};

/// The record that all models see, for programs of others.
void WriteCsv(const std::string& path, const accuracy::PumpTrial& trial) {
  if (path.empty()) return;
  const identification::Series& series = trial.series();
  std::string text = "time_s";
  for (const char* name : {"position_{}_m", "control_current_{}_a", "excitation_{}_m"}) {
    for (const std::string& channel : series.output_names) {
      text += ',';
      text += fmt::format(fmt::runtime(name), channel);
    }
  }
  text += "\n";
  for (Eigen::Index k = 0; k < series.rows(); ++k) {
    text += fmt::format("{:.6f}", static_cast<double>(k) * series.period_s);
    for (const auto* values : {&series.output, &series.input, &trial.excitation_m()}) {
      for (Eigen::Index i = 0; i < values->cols(); ++i) text += fmt::format(",{}", (*values)(k, i));
    }
    text += "\n";
  }
  WriteTextFile(path, text);
}

void Print(nlohmann::ordered_json& json, const std::string& name, const Eigen::VectorXd& fit,
           double time_s = 0.0) {
  fmt::print("{:<42}", name);
  for (const double percent : fit) fmt::print("{:>8.2f}", percent);
  fmt::print("{:>9.2f}", fit.mean());
  if (time_s > 0.0) fmt::print("{:>9.1f}", time_s);
  fmt::print("\n");
  static_cast<void>(std::fflush(stdout));
  json[name] = std::vector<double>(fit.data(), fit.data() + fit.size());
}

void Print(nlohmann::ordered_json& json, const accuracy::PumpScore& score,
           const std::vector<Eigen::Index>& horizons) {
  if (score.one_step.size() > 0) Print(json, score.model + ", one step", score.one_step);
  for (std::size_t n = 0; n < score.ahead.size(); ++n) {
    Print(json, fmt::format("{}, {} steps ahead", score.model, horizons[n]), score.ahead[n]);
  }
  if (score.diverged) {
    fmt::print("{:<42}{:>32}{:>9}{:>9.1f}\n", score.model + ", free run", "diverges", "",
               score.time_s);
    json[score.model + ", free run"] = "diverges";
    return;
  }
  Print(json, score.model + ", free run", score.free_run, score.time_s);
}

/// Models in the loop of the known controllers, near the ceiling.
void CompareInLoop(const PumpOptions& options, const accuracy::PumpTrial& trial,
                   const Eigen::VectorXd& ceiling, nlohmann::ordered_json& json) {
  const std::vector<Eigen::Index>& horizons = options.plan.horizons;
  const accuracy::PumpScore rotor = trial.SuspendedRotor(options.iron);
  Print(json, rotor, horizons);
  Print(json, "  below the ceiling", ceiling - rotor.free_run);
  if (options.iron > 0) {
    accuracy::PumpScore straight = trial.SuspendedRotor(0);
    straight.model = "  with straight iron";
    Print(json, straight, horizons);
  }
  const accuracy::PumpScore products = trial.HammersteinWiener(true);
  Print(json, products, horizons);
  Print(json, "  below the ceiling, products", ceiling - products.free_run);
}

ExitStatus Run(const PumpOptions& given) {
  PumpOptions options = given;
  const bool test_signals = options.inputs == "test_signals";
  options.plan.inputs =
      test_signals ? accuracy::PumpInputs::kTestSignals : accuracy::PumpInputs::kCommanded;
  if (options.plan.free_run_steps > 0 && !test_signals) {
    throw Problem(ExitStatus::kUsage,
                  "--fit-free-run: with commanded currents as inputs the models describe a rotor "
                  "without its loop, whose free run leaves all bounds; allowed with --inputs "
                  "test_signals");
  }
  const accuracy::PumpTrial trial(options.plan);
  WriteCsv(options.csv_path, trial);
  nlohmann::ordered_json json;
  fmt::print("{:<42}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}\n", "fit in %", "ux", "uy", "lx", "ly", "mean",
             "fit, s");
  const Eigen::VectorXd ceiling = trial.Ceiling();
  Print(json, "ceiling: noise of the readings", trial.CeilingOfReadings());
  Print(json, "ceiling: and what it does in the loop", ceiling);
  Print(json, "the rig again with other noise", trial.Repeated(options.plan.noise_seed + 1));
  if (!test_signals) CompareInLoop(options, trial, ceiling, json);
  for (const auto& score : {trial.HammersteinWiener(false), trial.Narx(), trial.Narmax()}) {
    Print(json, score, options.plan.horizons);
  }
  fmt::print("published, Chiu (2022), on its own rig:\n");
  for (const Published& row : kPublished) {
    Print(json, std::string("  ") + row.model, Eigen::Map<const Eigen::Vector4d>(row.fit.data()));
  }
  WriteJsonFile(options.json_path, json);
  return ExitStatus::kDone;
}

/// By which the pump differs from the one shipped.
void AddPumpOptions(CLI::App& command, accuracy::PumpPlan& plan) {
  command.add_option("--knee-a", plan.knee_a, "Coil current at which the iron bends; 0 = straight")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command.add_option("--knee-exponent", plan.knee_exponent, "Sharpness of the bend")
      ->check(CLI::Range(1.0, 20.0))
      ->capture_default_str();
  command.add_option("--a2", plan.a2_1_per_m, "Sensor y + a2 y^2 + a3 y^3 [1/m]; signs alternate")
      ->check(CLI::Range(-1e4, 1e4))
      ->capture_default_str();
  command.add_option("--a3", plan.a3_1_per_m2, "The same [1/m^2]")
      ->check(CLI::Range(-1e8, 1e8))
      ->capture_default_str();
}

void AddPumpModelOptions(CLI::App& command, PumpOptions& options) {
  accuracy::PumpPlan& plan = options.plan;
  command.add_option("--iron", options.iron, "Coefficients of the iron's curve")
      ->check(CLI::Range(0, 6))
      ->capture_default_str();
  command
      .add_option("--inputs", options.inputs,
                  "Of the models: the commanded currents, or what the controllers make of the test "
                  "signals alone, as the paper says")
      ->check(CLI::IsMember({"commanded", "test_signals"}))
      ->capture_default_str();
  command
      .add_option(
          "--horizon-rows", plan.horizons,
          "Also predict so many rows ahead of the last reading, several separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(1, 4000))
      ->capture_default_str();
  command
      .add_option("--fit-free-run", plan.free_run_steps,
                  "NARX and NARMAX by the error of their free run, in so many steps of the search; "
                  "0 = one step ahead only. With --inputs test_signals")
      ->check(CLI::Range(0, 2000))
      ->capture_default_str();
  command
      .add_option("--free-run-rows", plan.free_run_rows,
                  "That --fit-free-run looks at: the last of the fitted ones")
      ->check(CLI::Range(2000, 75'000))
      ->capture_default_str();
}

}  // namespace

void AddBenchPump(CLI::App& bench, Action& action) {
  auto options = std::make_shared<PumpOptions>();
  CLI::App* command = bench.add_subcommand("pump", "Nonlinear models of the levitated pump");
  command->footer(kBenchPumpHelp);
  accuracy::PumpPlan& plan = options->plan;
  AddPumpOptions(*command, plan);
  command->add_option("--amplitude", plan.amplitude, "Of the scenario's excitation")
      ->check(CLI::Range(0.01, 3.0))
      ->capture_default_str();
  command->add_option("--fitted", plan.fitted, "Rows that are fitted, of 50 us")
      ->check(CLI::Range(8000, 75'000))
      ->capture_default_str();
  AddPumpModelOptions(*command, *options);
  command->add_option("--noise-seed", plan.noise_seed, "Of the sensors")->capture_default_str();
  command
      ->add_option("--excitation-seed", plan.excitation_seed,
                   "Other amplitudes of its bits; 0 = those of the scenario")
      ->check(CLI::Range(0, 1'000'000))
      ->capture_default_str();
  command->add_option("--csv", options->csv_path, "Write the record into this file");
  command->add_option("--json", options->json_path, "Write all figures into this file");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
