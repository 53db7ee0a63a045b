#include "cli/study/bench_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <nlohmann/json.hpp>

#include "benchmark/accuracy/drawn_rig.hpp"
#include "cli/study/bench_workers.hpp"
#include "common/problem.hpp"
#include "diagnosis/diagnose/diagnose_files.hpp"
#include "report/diagnosis/diagnosis_files.hpp"

namespace levitas::cli {
namespace {

constexpr double kForecastRunUpS = 3.0;

struct Forecasted {
  std::uint64_t seed{};
  diagnosis::DiagnosisReport report;
  std::string failure;  ///< why it is no trial
};

/// [%] of fit, beyond that of the rig file.
double GainOverFile(const Forecasted& o) {
  return o.report.validation.extended_percent - o.report.validation.nominal_percent;
}

diagnosis::DiagnosisReport TryForecast(const BenchOptions& options, const accuracy::TestRig& bench,
                                       std::uint64_t seed) {
  accuracy::TrialPlan plan;
  plan.seed = seed;
  plan.bits_per_axis = options.bits;
  plan.runup_s = kForecastRunUpS;
  const accuracy::Trial trial =
      options.shipped ? accuracy::MakeTrial(bench, plan) : accuracy::MakeDrawnTrial(bench, plan);
  diagnosis::Settings settings;
  settings.quick = options.quick;
  settings.judging = options.judging;
  return DiagnoseTrial(trial, settings, true);
}

void PrintBands(const diagnosis::ReportForecast& forecast) {
  for (const auto& band : forecast.by_speed) {
    fmt::print("       {:>5.0f} to {:>5.0f} rpm: residual {:.4g} to {:.4g} um, {:.4g} um{}\n",
               band.from_rpm, band.to_rpm, band.residual_um.low, band.residual_um.high,
               band.residual_um.measured, band.residual_um.covered ? "" : "   NOT COVERED");
  }
}

void PrintForecast(const BenchOptions& options, const Forecasted& o) {
  if (!o.failure.empty()) {
    fmt::print("{:>6} no trial: {}\n", o.seed, o.failure);
    return;
  }
  const diagnosis::ReportFit& fit = o.report.validation;
  const diagnosis::ReportForecast& forecast = *o.report.forecast;
  fmt::print("{:>6} {:<10}{:<22}{:>8.1f}{:>12.1f}{:>9.1f}   {:>6.1f} to {:>5.1f}{:>6.0f}{}{}\n",
             o.seed, diagnosis::Word(o.report.verdict),
             o.report.causes.empty() ? "" : o.report.causes.front().effect, fit.nominal_percent,
             fit.extended_percent, fit.ceiling_percent, forecast.fit_percent.low,
             forecast.fit_percent.high, 100.0 * forecast.better_than_file,
             GainOverFile(o) > 0.0 ? "" : "   file is better",
             forecast.fit_percent.covered ? "" : "   NOT COVERED");
  if (options.explain) PrintBands(forecast);
  static_cast<void>(std::fflush(stdout));
}

nlohmann::ordered_json JsonOf(const Forecasted& o) {
  nlohmann::ordered_json json{{"seed", o.seed}, {"failure", o.failure}};
  if (!o.failure.empty()) return json;
  json["verdict"] = diagnosis::Word(o.report.verdict);
  json["file_percent"] = o.report.validation.nominal_percent;
  json["model_percent"] = o.report.validation.extended_percent;
  json["ceiling_percent"] = o.report.validation.ceiling_percent;
  json["forecast"] = report::ForecastJson(*o.report.forecast);
  return json;
}

double MedianGain(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// Prints and returns what all trials say together.
nlohmann::ordered_json SumOfForecasts(const std::vector<Forecasted>& outcomes) {
  std::size_t covered = 0;
  std::size_t better = 0;
  std::size_t bands = 0;
  std::size_t bands_covered = 0;
  double expected = 0.0;
  std::vector<double> gains;
  for (const Forecasted& o : outcomes) {
    if (!o.failure.empty()) continue;
    const diagnosis::ReportForecast& forecast = *o.report.forecast;
    covered += forecast.fit_percent.covered ? 1U : 0U;
    gains.push_back(GainOverFile(o));
    better += gains.back() > 0.0 ? 1U : 0U;
    expected += forecast.better_than_file;
    for (const auto& band : forecast.by_speed) {
      ++bands;
      bands_covered += band.residual_um.covered ? 1U : 0U;
    }
  }
  fmt::print(
      "\nThe 90 % interval of the fit covers in {} of {} rigs, that of the residual in {} of {} "
      "bands of speed.\nThe model beats the file in {} of {} (expected from the fitted records: "
      "{:.1f}); median gain {:.1f} % of fit.\n",
      covered, gains.size(), bands_covered, bands, better, gains.size(), expected,
      MedianGain(gains));
  return {{"rigs", gains.size()},
          {"covered", covered},
          {"bands", bands},
          {"bands_covered", bands_covered},
          {"better_than_file", better},
          {"expected_better_than_file", expected},
          {"median_gain_percent", MedianGain(gains)}};
}

}  // namespace

nlohmann::ordered_json RunForecast(const BenchOptions& options, const accuracy::TestRig& bench) {
  std::vector<Forecasted> outcomes(static_cast<std::size_t>(options.forecast));
  std::mutex printing;
  fmt::print("{:>6} {:<32}{:>8}{:>12}{:>9}   {:<16}{}\n", "seed", "verdict", "file", "calibrated",
             "ceiling", "90 % interval", "chance to beat the file, %");
  ForEachTrial(outcomes.size(), options.jobs, [&](std::size_t i) {
    Forecasted& out = outcomes[i];
    out.seed = options.first + i;
    try {
      out.report = TryForecast(options, bench, out.seed);
    } catch (const Problem& problem) {  // a rig that does not levitate is no trial
      out.failure = problem.what();
    }
    const std::lock_guard lock(printing);
    PrintForecast(options, out);
  });
  nlohmann::ordered_json json = SumOfForecasts(outcomes);
  json["trials"] = nlohmann::ordered_json::array();
  for (const Forecasted& outcome : outcomes) json["trials"].push_back(JsonOf(outcome));
  return json;
}

}  // namespace levitas::cli
