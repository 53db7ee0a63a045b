#include "cli/study/identify/live_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "identification/live/convergence_message.hpp"
#include "report/text/text_table.hpp"

namespace levitas::cli {
namespace {

using namespace identification;

double TimeOf(const LiveIdentification& live, std::uint64_t cycle) {
  return static_cast<double>(cycle) * live.rig()->numbers.period_s();
}

/// Coefficients c2, c3 .. [1/A, 1/A^2 ..] of an axis' curve i + c2 i^2 + c3 i^3 ...
std::vector<double> Coefficients(const HammersteinWienerModel& model, const InputCurve& curve,
                                 Eigen::Index input) {
  std::vector<double> found;
  for (Eigen::Index n = 1; n < curve.power.size(); ++n) {
    found.push_back(curve.power[n] / std::pow(model.input_scale[input], static_cast<double>(n)));
  }
  return found;
}

std::string CsvHead(const LiveIdentification& live) {
  std::string text = "time_s,cycle,rows,largest_change";
  const auto& axes = live.rig()->numbers.channels;
  for (const std::string& axis : axes) text += fmt::format(",error_{}_m", axis);
  for (const std::string& axis : axes) text += fmt::format(",fit_{}_percent", axis);
  const int degree = live.recursion()->model()->options.degree;
  for (const std::string& axis : axes) {
    for (int n = 2; n <= degree; ++n) {
      text += fmt::format(",curve{}_{}_1_per_a{}", n, axis, n > 2 ? std::to_string(n - 1) : "");
    }
  }
  return text + ",gaps,missing_rows,pauses,begun_anew,converged\n";
}

std::string CsvLine(const LiveIdentification& live, const ConvergencePoint& point) {
  std::string text = fmt::format("{:.6f},{},{},{}", TimeOf(live, point.cycle), point.cycle,
                                 point.rows, point.change);
  for (const double error_m : point.error_rms) text += fmt::format(",{}", error_m);
  for (const double percent : point.fit_percent) text += fmt::format(",{}", percent);
  const HammersteinWienerModel& model = *live.recursion()->model();
  Eigen::Index input = 0;
  for (const InputCurve& curve : Curves(model)) {
    for (const double value : Coefficients(model, curve, input)) text += fmt::format(",{}", value);
    ++input;
  }
  const RowCounts& counts = live.recursion()->counts();
  fmt::format_to(std::back_inserter(text), ",{},{},{},{},{}\n", counts.gaps, counts.missing,
                 counts.pauses, counts.begun_anew, point.converged ? 1 : 0);
  return text;
}

std::string GapsText(const RowCounts& counts) {
  if (counts.gaps == 0) return "none";
  return fmt::format("{} ({} rows)", counts.gaps, counts.missing);
}

nlohmann::ordered_json PointJson(const LiveIdentification& live, const ConvergencePoint& point) {
  return {{"time_s", TimeOf(live, point.cycle)},
          {"rows", point.rows},
          {"largest_change_percent", 100.0 * point.change},
          {"error_rms_m", std::vector<double>(point.error_rms.begin(), point.error_rms.end())},
          {"fit_percent", std::vector<double>(point.fit_percent.begin(), point.fit_percent.end())},
          {"converged", point.converged}};
}

/// The newest point, axis by axis, and the curves that the parameters make now.
void PrintAxes(const LiveIdentification& live) {
  const HammersteinWienerModel& model = *live.recursion()->model();
  const auto& newest = live.recursion()->newest();
  const std::vector<InputCurve> curves = Curves(model);
  report::TextTable table;
  table.Add({"axis", "error um", "fit %", "curve of the current, i in A", "share %"});
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    std::string curve = "i";
    int power = 2;
    for (const double value : Coefficients(model, curves[i], axis)) {
      curve += fmt::format(" {:+.4f} i^{}", value, power++);
    }
    table.Add({live.rig()->numbers.channels[i],
               newest ? fmt::format("{:.4f}", 1e6 * newest->error_rms[axis]) : "-",
               newest ? fmt::format("{:.2f}", newest->fit_percent[axis]) : "-", curve,
               fmt::format("{:.2f}", 100.0 * curves[i].share)});
  }
  fmt::print("{}", table.Text());
}

}  // namespace

struct LiveReport::Impl {
  std::optional<OutputFile> record;
  std::uint64_t told_gaps{}, told_anew{};
  bool head_printed{false};
  nlohmann::ordered_json points = nlohmann::ordered_json::array();
};

LiveReport::LiveReport(const std::string& record_path) : impl_(std::make_unique<Impl>()) {
  if (!record_path.empty()) impl_->record.emplace(record_path);
}

LiveReport::~LiveReport() = default;

void LiveReport::TellRun(const LiveIdentification& live) const {
  const RigNumbers& rig = live.rig()->numbers;
  fmt::print("{}: {} axes, {:g} kHz\n", rig.name, rig.axes(), 1e-3 / rig.period_s());
  static_cast<void>(std::fflush(stdout));
}

void LiveReport::Add(const LiveIdentification& live, const ConvergencePoint& point) {
  const RowCounts& counts = live.recursion()->counts();
  if (!impl_->head_printed) {
    fmt::print("{:>9}{:>10}{:>10}{:>11}{:>8}  {}\n", "run time", "rows", "change", "error", "fit",
               "parameter that changed most");
    if (impl_->record) impl_->record->Write(CsvHead(live));
  }
  impl_->head_printed = true;
  if (counts.begun_anew > impl_->told_anew) {
    fmt::print(
        "scales and recursion began anew: the signals became {:g} times larger, or the parameters "
        "had no bounds\n",
        OnlineRecursion::kSwell);
  }
  if (counts.gaps > impl_->told_gaps) {
    fmt::print("gap: {} so far, {} rows missing; the past of the signals was cleared\n",
               counts.gaps, counts.missing);
  }
  impl_->told_anew = counts.begun_anew;
  impl_->told_gaps = counts.gaps;
  fmt::print("{:>7.1f} s{:>10}{:>8.2f} %{:>8.3f} um{:>6.1f} %  {}{}\n", TimeOf(live, point.cycle),
             point.rows, 100.0 * point.change, 1e6 * point.error_rms.maxCoeff(),
             point.fit_percent.minCoeff(), ChangedName(live, point),
             point.converged ? "   converged" : "");
  static_cast<void>(std::fflush(stdout));
  impl_->points.push_back(PointJson(live, point));
  if (!impl_->record) return;
  impl_->record->Write(CsvLine(live, point));
  impl_->record->Flush();
}

void LiveReport::Finish(const LiveIdentification& live, double busy_s) {
  const OnlineRecursion& recursion = *live.recursion();
  const HammersteinWienerModel& model = *recursion.model();
  const RowCounts& counts = recursion.counts();
  const auto learnt = static_cast<double>(counts.learnt);
  fmt::print(
      "\n{} parameters ({} regressors for each of {} axes), {} rows learnt, cycles {} to {}\n",
      model.theta.size(), model.theta.rows(), model.outputs, counts.learnt,
      recursion.first_cycle().value_or(0), recursion.last_cycle().value_or(0));
  fmt::print("gaps: {}; pauses: {}; rows that only filled the past: {}; begun anew: {}\n",
             GapsText(counts), counts.pauses, counts.filled, counts.begun_anew);
  fmt::print("processor time: {:.2f} s, {:.0f} rows a second of it; the loop makes {:.0f}\n",
             busy_s, busy_s > 0.0 ? learnt / busy_s : 0.0, 1.0 / live.rig()->numbers.period_s());
  PrintAxes(live);
  const double tolerance_percent = 100.0 * model.options.tolerance;
  if (const auto rows = recursion.rows_to_converge()) {
    fmt::print("converged after {} rows: no parameter changed by more than {:g} % in a second\n",
               *rows, tolerance_percent);
  } else {
    fmt::print("not converged: a parameter still changes by more than {:g} % in a second\n",
               tolerance_percent);
  }
  if (!impl_->record) return;
  if (!impl_->head_printed) impl_->record->Write(CsvHead(live));
  impl_->record->Commit();
}

nlohmann::ordered_json LiveReport::Json(const LiveIdentification& live, double busy_s) const {
  const OnlineRecursion& recursion = *live.recursion();
  const HammersteinWienerModel& model = *recursion.model();
  const RowCounts& counts = recursion.counts();
  nlohmann::ordered_json theta = nlohmann::ordered_json::array();
  for (Eigen::Index k = 0; k < model.theta.rows(); ++k) {
    theta.push_back(std::vector<double>(model.theta.row(k).begin(), model.theta.row(k).end()));
  }
  nlohmann::ordered_json curves;
  const std::vector<InputCurve> found = Curves(model);
  for (std::size_t i = 0; i < found.size(); ++i) {
    curves[live.rig()->numbers.channels[i]] = {
        {"power", std::vector<double>(found[i].power.begin(), found[i].power.end())},
        {"share", found[i].share}};
  }
  const auto rows_to_converge = recursion.rows_to_converge();
  return {
      {"rig", live.rig()->numbers.name},
      {"channels", live.rig()->numbers.channels},
      {"regressors", model.theta.rows()},
      {"unknowns", model.theta.size()},
      {"first_cycle", recursion.first_cycle().value_or(0)},
      {"last_cycle", recursion.last_cycle().value_or(0)},
      {"rows", counts.learnt},
      {"filling_rows", counts.filled},
      {"gaps", counts.gaps},
      {"missing_rows", counts.missing},
      {"pauses", counts.pauses},
      {"begun_anew", counts.begun_anew},
      {"converged", recursion.newest() && recursion.newest()->converged},
      {"rows_to_converge",
       rows_to_converge ? nlohmann::ordered_json(*rows_to_converge) : nlohmann::ordered_json()},
      {"computing_s", busy_s},
      {"rows_per_computing_s", busy_s > 0.0 ? static_cast<double>(counts.learnt) / busy_s : 0.0},
      {"points", impl_->points},
      {"curves", curves},
      {"input_scale_a", std::vector<double>(model.input_scale.begin(), model.input_scale.end())},
      {"output_scale_m", std::vector<double>(model.output_scale.begin(), model.output_scale.end())},
      {"parameters", theta}};
}

}  // namespace levitas::cli
