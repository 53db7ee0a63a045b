#pragma once
// Options and output that the nonlinear identification commands share: data, columns, the rows to
// fit and the rows to judge by, and the table of both kinds of prediction.
//
// Judging  `one step` predicts each sample from measured ones before it; `free run` starts the
//          model and never looks again. Only the second says whether a model can replace the rig.
// Failure  BadInput: data, columns or ranges that do not fit.

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/options/analysis_options.hpp"
#include "identification/nonlinear/lagged_model.hpp"

namespace CLI {
class App;
}

namespace levitas::cli {

struct SeriesOptions : AnalysisOptions {
  std::string data_path;
  identification::SeriesColumns columns;
  double rate_hz{};
  std::string train{":"};
  std::vector<std::string> tests;
  std::size_t skip{50};
  std::string unit;  ///< of the outputs, for print
  std::string svg_path;
};

void AddSeriesOptions(CLI::App& command, SeriesOptions& options);

/// The whole series; a session is read with its rig file.
[[nodiscard]] identification::Series LoadSeries(const SeriesOptions& options);

/// One range and what the model made of it.
struct Judged {
  std::string rows;
  identification::Series data;
  identification::Prediction one_step, free_run;
};

using Predict = std::function<identification::Prediction(const identification::Series&)>;

/// Training range first, then every --test.
[[nodiscard]] std::vector<Judged> Judge(const SeriesOptions& options,
                                        const identification::Series& all, const Predict& one_step,
                                        const Predict& free_run);

void PrintJudged(const SeriesOptions& options, const std::vector<Judged>& judged);
[[nodiscard]] nlohmann::ordered_json JudgedJson(const SeriesOptions& options,
                                                const std::vector<Judged>& judged);
/// Measured, free run and difference of the last range.
void DrawJudged(const SeriesOptions& options, const std::vector<Judged>& judged);

}  // namespace levitas::cli
