// amb identify hammerstein-wiener: static curves around linear dynamics, by a recursion.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/identify/hammerstein_wiener_options.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/identify/sensor_options.hpp"
#include "cli/study/identify/series_options.hpp"
#include "cli/study/written_files.hpp"
#include "identification/nonlinear/hammerstein_wiener.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kHammersteinWienerHelp =
    "Static curve of every input, linear dynamics of all inputs and outputs, known sensor "
    "characteristic y = x + a2 x^2 + a3 x^3; recursive extended least squares with a model of the "
    "coloured noise. --bandwidth-hz spreads the dynamics' memory over the time scale of the rig; "
    "0 takes plain lags.\n"
    "  amb identify hammerstein-wiener data.csv --input u1,u2 --output y1,y2 --train :80000\n"
    "      --test 80000:84000 --order 8 --bandwidth-hz 300 --sensor-a3 1e8,1e8";

struct CommandOptions : SeriesOptions {
  HammersteinWienerOptions model;
  SensorOptions sensors;
};

void PrintModel(const Series& all, const HammersteinWienerFit& fit) {
  fmt::print("{:<28}{:>12}   {}\n", "input", "scale", "curve h(u/scale), share it explains");
  const std::vector<InputCurve> curves = Curves(fit.model);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    std::string text = "u";
    for (Eigen::Index n = 1; n < curves[i].power.size(); ++n) {
      text += fmt::format(" {:+.4f} u^{}", curves[i].power[n], n + 1);
    }
    fmt::print("{:<28}{:>12.4g}   {} ({:.2f} %)\n", all.input_names[i],
               fit.model.input_scale[static_cast<Eigen::Index>(i)], text, 100.0 * curves[i].share);
  }
}

nlohmann::ordered_json CurvesJson(const HammersteinWienerModel& model) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const InputCurve& curve : Curves(model)) {
    nlohmann::ordered_json power;
    for (const double value : curve.power) power.push_back(value);
    list.push_back({{"power", power}, {"share", curve.share}});
  }
  return list;
}

ExitStatus Run(const CommandOptions& given) {
  const Series all = LoadSeries(given);
  HammersteinWienerOptions options = given.model;
  options.sensors = SensorsOf(given.sensors, all.outputs());
  const Series train = Slice(all, ParseRange(given.train, static_cast<std::size_t>(all.rows())));
  const auto began = std::chrono::steady_clock::now();
  const HammersteinWienerFit fit = FitHammersteinWiener(train, options);
  const double time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const double samples = static_cast<double>(train.rows()) * fit.passes;
  const auto unknowns = fit.model.theta.size();
  fmt::print(
      "{}: Hammerstein-Wiener model, {} unknowns, {} passes (last change {:.3g}), {:.2f} s, "
      "{:.1f} us per sample\n",
      given.data_path, unknowns, fit.passes, fit.change, time_s, 1e6 * time_s / samples);
  PrintModel(all, fit);
  const auto judged = Judge(
      given, all, [&](const Series& s) { return PredictOneStep(fit.model, s); },
      [&](const Series& s) { return SimulateFreeRun(fit.model, s); });
  PrintJudged(given, judged);
  DrawJudged(given, judged);
  nlohmann::ordered_json json{{"data", given.data_path},
                              {"unknowns", unknowns},
                              {"passes", fit.passes},
                              {"last_change", fit.change},
                              {"time_s", time_s},
                              {"curves", CurvesJson(fit.model)},
                              {"judged", JudgedJson(given, judged)}};
  WriteJsonFile(given.json_path, json);
  TellWritten({given.svg_path, given.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyHammersteinWiener(CLI::App& identify, Action& action) {
  auto options = std::make_shared<CommandOptions>();
  CLI::App* command = identify.add_subcommand(
      "hammerstein-wiener", "Static curves around linear dynamics, sample by sample");
  command->footer(kHammersteinWienerHelp);
  AddSeriesOptions(*command, *options);
  HammersteinWienerOptions& model = options->model;
  AddMemoryOptions(*command, model);
  command
      ->add_option("--input-lag-hz", model.input_lag_hz, "Of amplifiers, for --products; 0 = none")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--input-delay", model.input_delay, "Samples of delay, for --products")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  command->add_option("--passes", model.most_passes, "Over the data, at most")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  AddSensorOptions(*command, options->sensors);
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
