// amb identify narx, amb identify narmax: black-box models of past inputs and outputs.

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/json_file.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/identify/series_options.hpp"
#include "cli/study/written_files.hpp"
#include "identification/nonlinear/narx.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

constexpr const char* kNarxHelp =
    "Terms are chosen by forward orthogonal least squares (error reduction ratio), coefficients "
    "fitted one step ahead. Such a model may predict well and still run free badly, or diverge: "
    "both are printed.\n"
    "  amb identify narx data.csv --input u --output y --rate-hz 1000 --train :8000 --test 8000:\n"
    "  amb identify narmax data.csv --input u --output y --rate-hz 1000 --terms 14 --error-lags 3";

struct NarxCommandOptions : SeriesOptions {
  NarxOptions model;
  Eigen::Index error_lags{3};
  bool with_errors{};
};

void PrintTerms(const NarxFit& fit) {
  const LaggedModel& model = fit.model;
  for (std::size_t o = 0; o < model.features.size(); ++o) {
    fmt::print("\noutput {}: {} terms\n{:<32}{:>14}{:>12}\n", o + 1, model.features[o].size(),
               "term (scaled)", "coefficient", "ERR %");
    for (std::size_t j = 0; j < model.features[o].size() && j < 40; ++j) {
      fmt::print("{:<32}{:>14.6g}{:>12}\n", FeatureName(model.layout, model.features[o][j]),
                 model.theta[o][static_cast<Eigen::Index>(j)],
                 j < fit.ratio[o].size() ? fmt::format("{:.3g}", 100.0 * fit.ratio[o][j]) : "");
    }
  }
}

ExitStatus Run(const NarxCommandOptions& given) {
  NarxOptions options = given.model;
  const Series all = LoadSeries(given);
  options.layout.inputs = all.inputs();
  options.layout.outputs = all.outputs();
  options.layout.error_lags = given.with_errors ? given.error_lags : 0;
  const auto began = std::chrono::steady_clock::now();
  const NarxFit fit =
      FitNarx(Slice(all, ParseRange(given.train, static_cast<std::size_t>(all.rows()))), options);
  const double time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print("{}: {} model, {} unknowns, {:.2f} s\n", given.data_path,
             given.with_errors ? "NARMAX" : "NARX", fit.model.unknowns(), time_s);
  const auto judged = Judge(
      given, all, [&](const Series& s) { return PredictOneStep(fit.model, s); },
      [&](const Series& s) { return SimulateFreeRun(fit.model, s); });
  PrintTerms(fit);
  PrintJudged(given, judged);
  DrawJudged(given, judged);
  nlohmann::ordered_json json{
      {"data", given.data_path}, {"unknowns", fit.model.unknowns()}, {"time_s", time_s}};
  for (std::size_t o = 0; o < fit.model.features.size(); ++o) {
    nlohmann::ordered_json terms;
    for (std::size_t j = 0; j < fit.model.features[o].size(); ++j) {
      terms.push_back({{"term", FeatureName(fit.model.layout, fit.model.features[o][j])},
                       {"coefficient", fit.model.theta[o][static_cast<Eigen::Index>(j)]}});
    }
    json["outputs"].push_back(terms);
  }
  json["judged"] = JudgedJson(given, judged);
  WriteJsonFile(given.json_path, json);
  TellWritten({given.svg_path, given.json_path});
  return ExitStatus::kDone;
}

void AddCommand(CLI::App& identify, Action& action, bool with_errors) {
  auto options = std::make_shared<NarxCommandOptions>();
  options->with_errors = with_errors;
  options->model.layout.output_lags = 4;
  options->model.layout.input_lags = 4;
  CLI::App* command = identify.add_subcommand(
      with_errors ? "narmax" : "narx",
      with_errors ? "Polynomial of past inputs, outputs and prediction errors"
                  : "Polynomial or network of past inputs and outputs");
  command->footer(kNarxHelp);
  AddSeriesOptions(*command, *options);
  NarxOptions& model = options->model;
  const auto lags = CLI::Range(1, 50);
  command->add_option("--output-lags", model.layout.output_lags, "Of every output")
      ->check(lags)
      ->capture_default_str();
  command->add_option("--input-lags", model.layout.input_lags, "Of every input")
      ->check(lags)
      ->capture_default_str();
  command->add_option("--input-delay", model.layout.input_delay, "First lag of the inputs")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--degree", model.degree, "Of the polynomial")
      ->check(CLI::Range(1, 5))
      ->capture_default_str();
  command->add_option("--terms", model.most_terms, "Chosen per output, at most")
      ->check(CLI::Range(1, 500))
      ->capture_default_str();
  if (with_errors) {
    command->add_option("--error-lags", options->error_lags, "Of every output's prediction error")
        ->check(lags)
        ->capture_default_str();
  } else {
    command
        ->add_option("--network", model.network_units,
                     "tanh units beside all linear terms; 0 = polynomial")
        ->check(CLI::Range(0, 500))
        ->capture_default_str();
    command->add_option("--seed", model.seed, "Of the network's directions")->capture_default_str();
  }
  command->callback([options, &action] { action = [options] { return Run(*options); }; });
}

}  // namespace

void AddIdentifyNarx(CLI::App& identify, Action& action) {
  AddCommand(identify, action, false);
  AddCommand(identify, action, true);
}

}  // namespace levitas::cli
