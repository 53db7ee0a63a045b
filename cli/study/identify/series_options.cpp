#include "cli/study/identify/series_options.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/options/rig_of_records.hpp"
#include "common/problem.hpp"
#include "report/svg/figure.hpp"
#include "session/log/output_path.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

/// Rows of a picture, at most: more than a screen has pixels says nothing.
constexpr Eigen::Index kPictureRows = 4000;
constexpr std::size_t kMostSkipped = 1'000'000'000;

/// Before anything is fitted: a range without a row that judges.
void RefuseShortRanges(const SeriesOptions& o, std::size_t rows) {
  const auto refuse = [&](const char* option, const std::string& text) {
    const RowRange range = ParseRange(text, rows);
    if (range.end - range.begin - 1 > o.skip) return;
    throw BadInput(fmt::format(
        "{} '{}': {} rows, of which --skip leaves out {}; allowed: two rows more than are left out",
        option, text, range.end - range.begin, o.skip));
  };
  refuse("--train", o.train);
  for (const std::string& text : o.tests) refuse("--test", text);
}

/// "0.5157 mV", or plain without a unit.
std::string WithUnit(double value, const std::string& unit) {
  if (unit.empty() || !(value > 0.0))
    return fmt::format("{:.4g}{}{}", value, unit.empty() ? "" : " ", unit);
  constexpr std::array<const char*, 5> kPrefix{"", "m", "u", "n", "p"};
  std::size_t step = 0;
  while (value < 1.0 && step + 1 < kPrefix.size()) {
    value *= 1000.0;
    ++step;
  }
  return fmt::format("{:.4f} {}{}", value, kPrefix[step], unit);
}

std::string Verdict(const Prediction& p, double rms, double fit, const std::string& unit) {
  if (p.diverged_at) return fmt::format("diverged at row {}", *p.diverged_at);
  return fmt::format("{:>12}  {:>7.2f} %", WithUnit(rms, unit), fit);
}

svg::Panel Traces(const Judged& j, Eigen::Index output, const std::string& unit) {
  const Eigen::Index rows = std::min(j.data.rows(), kPictureRows);
  const Eigen::Index from = j.data.rows() - rows;
  svg::Series measured{.name = "measured", .colour = "#999999"};
  svg::Series model{.name = "free run", .colour = svg::Colour(1), .width = 0.8};
  svg::Series error{.name = "difference", .colour = svg::Colour(2), .width = 0.8};
  for (Eigen::Index k = from; k < j.data.rows(); ++k) {
    const double t = static_cast<double>(k) * j.data.period_s;
    const double y = j.data.output(k, output);
    const double p = j.free_run.output(k, output);
    for (auto* s : {&measured, &model, &error}) s->x.push_back(t);
    measured.y.push_back(y);
    model.y.push_back(p);
    error.y.push_back(y - p);
  }
  return {.title = j.data.output_names[static_cast<std::size_t>(output)] + ", rows " + j.rows,
          .x_label = "time, s",
          .y_label = unit,
          .series = {measured, model, error}};
}

}  // namespace

void AddSeriesOptions(CLI::App& command, SeriesOptions& o) {
  command
      .add_option("DATA", o.data_path,
                  "CSV file (.csv, .csv.xz) with the columns named below, or a session, whose "
                  "signals are position_C, control_current_C and excitation_C of every channel C")
      ->required();
  AddRigOfRecordsOption(command, o);
  command.add_option("--input", o.columns.inputs, "Input columns")->delimiter(',')->required();
  command.add_option("--output", o.columns.outputs, "Output columns")->delimiter(',')->required();
  command.add_option("--rate-hz", o.rate_hz, "Sampling rate, when there is no column time_s")
      ->check(CLI::PositiveNumber);
  command.add_option("--train", o.train, "Rows that are fitted, FIRST:END")->capture_default_str();
  command.add_option("--test", o.tests, "Rows that only judge; may be given several times");
  command.add_option("--skip", o.skip, "Rows at the start of every range that do not judge")
      ->check(CLI::Range(std::size_t{0}, kMostSkipped))
      ->capture_default_str();
  command.add_option("--unit", o.unit, "Unit of the outputs, for print: V, m, A");
  command.add_option("--svg", o.svg_path, "Draw the last range into this file");
  AddJsonOption(command, o);
}

Series LoadSeries(const SeriesOptions& o) {
  for (const std::string& path : {o.svg_path, o.json_path}) {
    session::CheckOutputPath(path, o.data_path);
  }
  if (!o.svg_path.empty() && o.svg_path == o.json_path) {
    throw Problem(ExitStatus::kUsage,
                  fmt::format("--svg and --json: both '{}'; give each a file", o.svg_path));
  }
  const bool csv = o.data_path.ends_with(".csv") || o.data_path.ends_with(".csv.xz");
  Series series =
      csv ? ReadSeries(o.data_path, o.columns, o.rate_hz > 0.0 ? 1.0 / o.rate_hz : 0.0)
          : SeriesOf(session::LoadRecording(o.data_path, LoadRigOfRecords(o, {o.data_path})),
                     o.columns);
  RefuseShortRanges(o, static_cast<std::size_t>(series.rows()));
  return series;
}

std::vector<Judged> Judge(const SeriesOptions& o, const Series& all, const Predict& one_step,
                          const Predict& free_run) {
  std::vector<std::string> ranges{o.train};
  ranges.insert(ranges.end(), o.tests.begin(), o.tests.end());
  std::vector<Judged> judged;
  judged.reserve(ranges.size());
  for (const std::string& text : ranges) {
    const RowRange range = ParseRange(text, static_cast<std::size_t>(all.rows()));
    Series part = Slice(all, range);
    Prediction one = one_step(part);
    Prediction free = free_run(part);
    judged.push_back({text, std::move(part), std::move(one), std::move(free)});
  }
  return judged;
}

void PrintJudged(const SeriesOptions& o, const std::vector<Judged>& judged) {
  const auto skip = static_cast<Eigen::Index>(o.skip);
  fmt::print("\n{:<10}{:<16}{:<18}{:>24}   {:>24}\n", "", "rows", "output",
             "one step ahead rms, fit", "free run rms, fit");
  for (const Judged& j : judged) {
    const auto rms1 = RmsError(j.data.output, j.one_step.output, skip);
    const auto fit1 = FitPercent(j.data.output, j.one_step.output, skip);
    const auto rms = RmsError(j.data.output, j.free_run.output, skip);
    const auto fit = FitPercent(j.data.output, j.free_run.output, skip);
    for (Eigen::Index i = 0; i < j.data.outputs(); ++i) {
      fmt::print("{:<10}{:<16}{:<18}{:>24}   {:>24}\n", &j == &judged.front() ? "fitted" : "test",
                 j.rows, j.data.output_names[static_cast<std::size_t>(i)],
                 Verdict(j.one_step, rms1[i], fit1[i], o.unit),
                 Verdict(j.free_run, rms[i], fit[i], o.unit));
    }
    if (j.data.outputs() > 1) {
      fmt::print("{:<44}{:>22.2f} %   {:>22.2f} %\n", "          mean", fit1.mean(),
                 j.free_run.diverged_at ? std::nan("") : fit.mean());
    }
  }
}

nlohmann::ordered_json JudgedJson(const SeriesOptions& o, const std::vector<Judged>& judged) {
  const auto skip = static_cast<Eigen::Index>(o.skip);
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Judged& j : judged) {
    const auto entry = [&](const Prediction& p) {
      const auto rms = RmsError(j.data.output, p.output, skip);
      const auto fit = FitPercent(j.data.output, p.output, skip);
      nlohmann::ordered_json json{{"diverged", p.diverged_at.has_value()}};
      for (Eigen::Index i = 0; i < j.data.outputs(); ++i) {
        json["rms"].push_back(rms[i]);
        json["fit_percent"].push_back(fit[i]);
      }
      return json;
    };
    list.push_back({{"rows", j.rows},
                    {"fitted", &j == &judged.front()},
                    {"outputs", j.data.output_names},
                    {"one_step", entry(j.one_step)},
                    {"free_run", entry(j.free_run)}});
  }
  return list;
}

void DrawJudged(const SeriesOptions& o, const std::vector<Judged>& judged) {
  if (o.svg_path.empty()) return;
  svg::Figure figure{.panel_width = 900, .panel_height = 260};
  for (Eigen::Index i = 0; i < judged.back().data.outputs(); ++i) {
    figure.panels.push_back(Traces(judged.back(), i, o.unit));
  }
  svg::Write(o.svg_path, figure);
}

}  // namespace levitas::cli
