#include "identification/nonlinear/online_recursion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "identification/nonlinear/laguerre.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kLeastScale = 1e-300;  // of a signal that is 0: the next one that is not swells

constexpr Index kLooks = 10;  // in a window, whether the signals have swollen

/// Of a signal that never changed there is no scale.
bool Changes(const Eigen::VectorXd& lowest, const Eigen::VectorXd& highest) {
  return (highest - lowest).minCoeff() > 0.0;
}

}  // namespace

OnlineRecursion::OnlineRecursion(OnlineOptions options,
                                 std::function<void(const ConvergencePoint&)> on_point)
    : options_(std::move(options)), on_point_(std::move(on_point)) {
  if (options_.inputs < 1 || options_.outputs < 1 || options_.window_rows < 2 ||
      !(options_.period_s > 0.0)) {
    throw std::invalid_argument("OnlineRecursion: no inputs, outputs, period or window");
  }
  const auto sensors = static_cast<Index>(options_.model.sensors.size());
  if ((sensors > 0 && sensors != options_.outputs) ||
      (options_.model.products && options_.inputs != options_.outputs)) {
    throw std::invalid_argument("OnlineRecursion: sensors or products of other axes");
  }
  kept_.resize(static_cast<std::size_t>(options_.window_rows));
  const Eigen::VectorXd outputs = Eigen::VectorXd::Zero(options_.outputs);
  sums_ = {0, outputs, outputs, outputs, outputs, Eigen::VectorXd::Zero(options_.inputs), outputs};
}

void OnlineRecursion::Take(std::uint64_t cycle, const Eigen::VectorXd& u,
                           const Eigen::VectorXd& y) {
  if (!u.allFinite() || !y.allFinite()) return;  // its cycle number is then missing
  row_.cycle = cycle;
  row_.after_pause = std::exchange(paused_, false);
  row_.u = u;
  row_.y = y;
  if (recursion_) return Learn(row_);
  kept_[kept_rows_++] = row_;
  if (kept_rows_ == kept_.size()) BeginWithKept();
}

void OnlineRecursion::Finish() {
  if (!recursion_ && kept_rows_ > 1) BeginWithKept();
}

void OnlineRecursion::BeginWithKept() {
  Eigen::VectorXd u_square = Eigen::VectorXd::Zero(options_.inputs);
  Eigen::VectorXd y_square = Eigen::VectorXd::Zero(options_.outputs);
  Eigen::VectorXd u_low = kept_[0].u;
  Eigen::VectorXd u_high = u_low;
  Eigen::VectorXd y_low = kept_[0].y;
  Eigen::VectorXd y_high = y_low;
  for (std::size_t k = 0; k < kept_rows_; ++k) {
    const Row& row = kept_[k];
    u_square += row.u.cwiseAbs2();
    y_square += row.y.cwiseAbs2();
    u_low = u_low.cwiseMin(row.u);
    u_high = u_high.cwiseMax(row.u);
    y_low = y_low.cwiseMin(row.y);
    y_high = y_high.cwiseMax(row.y);
  }
  const std::size_t rows = std::exchange(kept_rows_, 0);
  if (!Changes(u_low, u_high) || !Changes(y_low, y_high)) return;
  const auto count = static_cast<double>(rows);
  Begin((u_square / count).cwiseSqrt(), (y_square / count).cwiseSqrt());
  for (std::size_t k = 0; k < rows; ++k) Learn(kept_[k]);
  kept_.clear();
  kept_.shrink_to_fit();
}

void OnlineRecursion::Begin(const Eigen::VectorXd& input_scale,
                            const Eigen::VectorXd& output_scale) {
  HammersteinWienerModel model{options_.inputs,
                               options_.outputs,
                               options_.model,
                               options_.period_s,
                               LaguerrePole(options_.model.bandwidth_hz, options_.period_s),
                               input_scale.cwiseMax(kLeastScale),
                               output_scale.cwiseMax(kLeastScale),
                               {}};
  model.theta = Eigen::MatrixXd::Zero(model.regressors(), model.outputs);
  memory_rows_ = MemoryRows(model);
  to_fill_ = memory_rows_;
  theta_before_ = model.theta;
  rows_since_begin_ = 0;
  rows_to_converge_.reset();
  ClearSums();
  recursion_.emplace(std::move(model), options_.model.start_variance);
}

// The rows of this window are lost with what was learnt before: those were other signals.
void OnlineRecursion::BeginAnew() {
  const HammersteinWienerModel& old = recursion_->model();
  const auto rows = static_cast<double>(sums_.rows);
  const Eigen::VectorXd u = (sums_.u_square / rows).cwiseSqrt().cwiseProduct(old.input_scale);
  const Eigen::VectorXd v = (sums_.v_square / rows).cwiseSqrt().cwiseProduct(old.output_scale);
  ++counts_.begun_anew;
  Begin(u, v);
}

void OnlineRecursion::CountGap(const Row& row) noexcept {
  if (!last_cycle_) return;
  if (row.after_pause) {
    ++counts_.pauses;
    return;
  }
  ++counts_.gaps;
  if (row.cycle > *last_cycle_) counts_.missing += row.cycle - *last_cycle_ - 1;
}

void OnlineRecursion::Learn(const Row& row) {
  if (!last_cycle_ || row.cycle != *last_cycle_ + 1) {
    CountGap(row);
    recursion_->Restart();
    to_fill_ = memory_rows_;
  }
  if (!first_cycle_) first_cycle_ = row.cycle;
  last_cycle_ = row.cycle;
  if (to_fill_ > 0) {
    --to_fill_;
    ++counts_.filled;
    recursion_->Fill(row.u, row.y);
    return;
  }
  Add(row.u, recursion_->Step(row.u, row.y));
  ++counts_.learnt;
  ++rows_since_begin_;
  if (sums_.rows == options_.window_rows) return Close();
  const Index part = std::max<Index>(1, options_.window_rows / kLooks);
  if (sums_.rows % part == 0 && Swollen()) BeginAnew();
}

void OnlineRecursion::Add(const Eigen::VectorXd& u, const Eigen::VectorXd& error) noexcept {
  const HammersteinWienerModel& model = recursion_->model();
  const Eigen::VectorXd& v = recursion_->straightened();
  if (sums_.rows == 0) sums_.origin = v;
  ++sums_.rows;
  sums_.shifted += v - sums_.origin;
  sums_.shifted_square += (v - sums_.origin).cwiseAbs2();
  sums_.v_square += v.cwiseAbs2();
  sums_.u_square += u.cwiseQuotient(model.input_scale).cwiseAbs2();
  sums_.error_square += error.cwiseAbs2();
}

void OnlineRecursion::ClearSums() noexcept {
  sums_.rows = 0;
  for (auto* sum : {&sums_.shifted, &sums_.shifted_square, &sums_.error_square, &sums_.u_square,
                    &sums_.v_square}) {
    sum->setZero();
  }
}

bool OnlineRecursion::Swollen() const noexcept {
  const double most = kSwell * kSwell * static_cast<double>(sums_.rows);
  return sums_.u_square.maxCoeff() > most || sums_.v_square.maxCoeff() > most;
}

ConvergencePoint OnlineRecursion::Point() const {
  const HammersteinWienerModel& model = recursion_->model();
  ConvergencePoint point{};
  point.cycle = last_cycle_.value_or(0);
  point.rows = rows_since_begin_;
  for (Index o = 0; o < model.outputs; ++o) {
    const double largest = model.theta.col(o).cwiseAbs().maxCoeff();
    Index which = 0;
    const double step = (model.theta.col(o) - theta_before_.col(o)).cwiseAbs().maxCoeff(&which);
    const double change = step / std::max(largest, std::numeric_limits<double>::min());
    if (change <= point.change) continue;
    point.change = change;
    point.regressor = which;
    point.output = o;
  }
  const auto rows = static_cast<double>(sums_.rows);
  const Eigen::ArrayXd deviation =
      (sums_.shifted_square - sums_.shifted.cwiseAbs2() / rows).cwiseMax(0.0).array();
  const Eigen::ArrayXd error = sums_.error_square.array();
  point.error_rms = (error / rows).sqrt() * model.output_scale.array();
  point.fit_percent = (deviation > 0.0).select(100.0 * (1.0 - (error / deviation).sqrt()), 0.0);
  point.converged =
      point.change <= options_.model.tolerance &&
      point.rows >= kRowsPerRegressor * static_cast<std::uint64_t>(model.theta.rows());
  return point;
}

void OnlineRecursion::Close() {
  if (Swollen() || !recursion_->model().theta.allFinite()) return BeginAnew();
  newest_ = Point();
  if (newest_->converged && !rows_to_converge_) rows_to_converge_ = newest_->rows;
  theta_before_ = recursion_->model().theta;
  ClearSums();
  if (on_point_) on_point_(*newest_);
}

std::string RegressorName(const HammersteinWienerModel& model, Index regressor,
                          const std::vector<std::string>& axes) {
  constexpr std::array<const char*, kProducts> kNames{"i^2 v", "i v^2", "v^3", "i^3"};
  const auto axis = [&](Index i) { return axes[static_cast<std::size_t>(i)]; };
  const Index order = model.options.order;
  const Index bank = regressor / order;
  const Index section = regressor % order + 1;
  const Index powers = model.inputs * model.options.degree;
  const Index products = model.options.products ? model.inputs * kProducts : 0;
  if (bank < model.outputs) return fmt::format("position {}, section {}", axis(bank), section);
  if (const Index at = bank - model.outputs; at < powers) {
    const Index power = at % model.options.degree + 1;
    return fmt::format("current {}{}, section {}", axis(at / model.options.degree),
                       power > 1 ? fmt::format("^{}", power) : "", section);
  }
  if (const Index at = bank - model.outputs - powers; at < products) {
    return fmt::format("{} of {}, section {}", kNames[static_cast<std::size_t>(at % kProducts)],
                       axis(at / kProducts), section);
  }
  const Index noise = regressor - (model.outputs + powers + products) * order;
  if (noise >= model.outputs * model.options.noise_order) return "constant";
  return fmt::format("error of {}, section {}", axis(noise / model.options.noise_order),
                     noise % model.options.noise_order + 1);
}

}  // namespace levitas::identification
