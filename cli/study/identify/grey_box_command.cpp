// amb identify grey-box: an oscillator with a curved spring from one input and one output.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/identify/series_options.hpp"
#include "cli/study/written_files.hpp"
#include "identification/nonlinear/grey_box.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kGreyBoxHelp =
    "m y'' + d y' + k(y) = g u with a polynomial spring k, fitted so that its free run follows the "
    "data: least squares on one step, then Levenberg-Marquardt on the simulation. --degree 1 is "
    "the linear oscillator to compare with.\n"
    "  amb identify grey-box data.csv --input V1 --output V2 --rate-hz 610.35 --unit V\n"
    "      --train 40650:105712 --test 100:40575 --degree 3";

struct GreyBoxOptions : SeriesOptions {
  OscillatorOptions model;
};

void Print(const GreyBoxOptions& options, const Oscillator& o, double time_s) {
  const LaggedModel& model = o.fit.model;
  fmt::print(
      "{}: oscillator of order {}, spring of degree {}, {} unknowns, {} iterations, {:.2f} s{}\n",
      options.data_path, options.model.order, options.model.degree, model.unknowns(),
      o.fit.iterations, time_s, o.fit.converged ? "" : " (stopped at its iteration limit)");
  fmt::print("natural frequency {:.3f} Hz, damping ratio {:.4f} (linear part)\n", o.frequency_hz,
             o.damping_ratio);
  fmt::print("static spring: input = {:.4g}", o.spring[0]);
  for (Eigen::Index n = 1; n < o.spring.size(); ++n) fmt::print(" {:+.4g} y^{}", o.spring[n], n);
  fmt::print("\n\n{:<20}{:>14}{:>14}\n", "term (scaled)", "coefficient", "+- 2 sigma");
  for (std::size_t j = 0; j < model.features[0].size(); ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    fmt::print("{:<20}{:>14.6g}{:>14.2g}\n", FeatureName(model.layout, model.features[0][j]),
               model.theta[0][at], 2.0 * o.fit.deviation[at]);
  }
}

ExitStatus Run(const GreyBoxOptions& options) {
  const Series all = LoadSeries(options);
  if (all.inputs() != 1 || all.outputs() != 1) {
    throw Problem(ExitStatus::kUsage, "grey-box takes one --input and one --output");
  }
  const auto began = std::chrono::steady_clock::now();
  const Oscillator oscillator = FitOscillator(
      Slice(all, ParseRange(options.train, static_cast<std::size_t>(all.rows()))), options.model);
  const double time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const LaggedModel& model = oscillator.fit.model;
  const auto judged = Judge(
      options, all, [&](const Series& s) { return PredictOneStep(model, s); },
      [&](const Series& s) { return SimulateFreeRun(model, s); });
  Print(options, oscillator, time_s);
  PrintJudged(options, judged);
  DrawJudged(options, judged);
  nlohmann::ordered_json json{{"data", options.data_path},
                              {"unknowns", model.unknowns()},
                              {"time_s", time_s},
                              {"natural_frequency_hz", oscillator.frequency_hz},
                              {"damping_ratio", oscillator.damping_ratio}};
  for (const double value : oscillator.spring) json["spring"].push_back(value);
  json["judged"] = JudgedJson(options, judged);
  WriteJsonFile(options.json_path, json);
  TellWritten({options.svg_path, options.json_path});
  return ExitStatus::kDone;
}

}  // namespace

void AddIdentifyGreyBox(CLI::App& identify, Action& action) {
  auto options = std::make_shared<GreyBoxOptions>();
  CLI::App* command =
      identify.add_subcommand("grey-box", "An oscillator with a curved spring, one axis");
  command->footer(kGreyBoxHelp);
  AddSeriesOptions(*command, *options);
  command->add_option("--order", options->model.order, "Of the linear part")
      ->check(CLI::Range(2, 6))
      ->capture_default_str();
  command->add_option("--degree", options->model.degree, "Of the spring; 1 = linear")
      ->check(CLI::Range(1, 7))
      ->capture_default_str();
  command->add_flag("--rate", options->model.rate, "The spring's force may depend on the rate too");
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace levitas::cli
