#include "identification/nonlinear/suspended_rotor_fit.hpp"

#include <fmt/core.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/problem.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kDifference = 1e-5;  ///< of a number's scale
/// Of all forces: a magnet's ki is rarely off by more, and more of them only cost a run each.
constexpr std::array kFactors{1.0, 0.9, 0.8, 0.7, 1.1, 1.2};
constexpr Index kFirstRows = 12'000;  ///< of the first stages

enum class Free { kForces, kAll };

/// Every unknown and the size in which it is counted.
template <class Visit>
void ForEachUnknown(SuspendedRotor& model, const SuspendedRotor& start, Free free, Visit visit) {
  for (std::size_t p = 0; p < 2; ++p) {
    for (std::size_t r = 0; r < model.plane[p].size(); ++r) {
      RotorMode& mode = model.plane[p][r];
      const RotorMode& from = start.plane[p][r];
      for (double& in : mode.in) visit(in, from.in.cwiseAbs().maxCoeff());
      if (free == Free::kForces || !(from.frequency_hz > 0.0)) continue;
      visit(mode.frequency_hz, from.frequency_hz);
      visit(mode.damping_ratio, from.damping_ratio);
      for (Index b = 1; b < mode.out.size(); ++b) {
        visit(mode.out[b], from.out.cwiseAbs().maxCoeff());
      }
    }
  }
  for (std::size_t a = 0; a < model.axis.size(); ++a) {
    AxisForce& axis = model.axis[a];
    visit(axis.gap_m, start.axis[a].gap_m);
    if (free == Free::kForces) continue;
    visit(axis.amplifier_hz, start.axis[a].amplifier_hz);
    visit(axis.offset_a, axis.bias_a);
    visit(axis.imbalance, 1.0);
    for (double& c : axis.iron) visit(c, 1.0);
  }
}

class FreeRunFit {
 public:
  FreeRunFit(const SuspendedRotor& start, const Series& series, const LoopAtRest& at_rest,
             Index skip, Free free)
      : start_(start),
        rows_(series.rows()),
        judged_(series.rows() - skip),
        at_rest_(at_rest),
        free_(free),
        measured_(series.output.bottomRows(judged_).reshaped()) {
    SuspendedRotor count = start;
    ForEachUnknown(count, start, free, [&](double&, double) { ++unknowns_; });
    Accept(start, Readings(start));
  }

  [[nodiscard]] bool runs() const noexcept { return readings_.size() > 0; }
  [[nodiscard]] const SuspendedRotor& model() const noexcept { return model_; }
  [[nodiscard]] Index unknowns() const noexcept { return unknowns_; }
  [[nodiscard]] double rms_m() const noexcept {
    return std::sqrt(squares_ / static_cast<double>(measured_.size()));
  }

  /// One step of Levenberg-Marquardt; the share of the squares it took away, 0 when none helps.
  double Step() {
    Eigen::MatrixXd jacobian(measured_.size(), unknowns_);
    if (!Differentiate(jacobian)) return 0.0;
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
    const Eigen::VectorXd right = jacobian.transpose() * (measured_ - readings_);
    constexpr double kMost = 1e8;
    constexpr double kLeast = 1e-9;
    for (; damping_ < kMost; damping_ *= 10.0) {
      Eigen::MatrixXd system = normal.selfadjointView<Eigen::Lower>();
      system.diagonal() *= 1.0 + damping_;
      const SuspendedRotor trial = Moved(system.ldlt().solve(right));
      const double before = squares_;
      if (!Accept(trial, Readings(trial))) continue;
      damping_ = std::max(kLeast, 0.1 * damping_);
      return 1.0 - squares_ / before;
    }
    return 0.0;
  }

 private:
  [[nodiscard]] SuspendedRotor Moved(const Eigen::VectorXd& step) const {
    SuspendedRotor moved = model_;
    Index n = 0;
    ForEachUnknown(moved, start_, free_,
                   [&](double& value, double scale) { value += scale * step[n++]; });
    return moved;
  }
  /// Of the judged rows, in one column; empty when the run diverges.
  [[nodiscard]] Eigen::VectorXd Readings(const SuspendedRotor& model) const {
    const Prediction run = RunFree(model, rows_, at_rest_());
    if (run.diverged_at) return {};
    return run.output.bottomRows(judged_).reshaped();
  }
  bool Accept(const SuspendedRotor& model, Eigen::VectorXd readings) {
    if (readings.size() == 0) return false;
    const double squares = (measured_ - readings).squaredNorm();
    if (runs() && !(squares < squares_)) return false;
    model_ = model;
    readings_ = std::move(readings);
    squares_ = squares;
    return true;
  }
  /// False when a neighbour diverges.
  bool Differentiate(Eigen::MatrixXd& jacobian) const {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(unknowns_);
    for (Index n = 0; n < unknowns_; ++n) {
      step[n] = kDifference;
      const Eigen::VectorXd beside = Readings(Moved(step));
      if (beside.size() == 0) return false;
      jacobian.col(n) = (beside - readings_) / kDifference;
      step[n] = 0.0;
    }
    return true;
  }

  SuspendedRotor start_;
  Index rows_, judged_;
  const LoopAtRest& at_rest_;
  Free free_;
  Eigen::VectorXd measured_;
  Index unknowns_{};
  SuspendedRotor model_;
  Eigen::VectorXd readings_;
  double squares_{};
  double damping_{1e-4};
};

/// The start with all forces times what fits best.
SuspendedRotor Scaled(const SuspendedRotor& start, const Series& series, const LoopAtRest& at_rest,
                      Index skip) {
  SuspendedRotor best = start;
  double least_m = std::numeric_limits<double>::infinity();
  for (const double factor : kFactors) {
    SuspendedRotor trial = start;
    for (auto& plane : trial.plane) {
      for (RotorMode& mode : plane) mode.in *= factor;
    }
    const FreeRunFit fit(trial, series, at_rest, skip, Free::kForces);
    if (!fit.runs() || !(fit.rms_m() < least_m)) continue;
    least_m = fit.rms_m();
    best = trial;
  }
  if (!std::isfinite(least_m)) {
    throw BadInput(
        "the model does not run free in this loop with the forces of the rig file, nor with 0.7 to "
        "1.2 times them: rig file, controller and signs must be those of the record");
  }
  return best;
}

}  // namespace

SuspendedRotorFit FitSuspendedRotor(const SuspendedRotor& start, const Series& series,
                                    const LoopAtRest& at_rest,
                                    const SuspendedRotorOptions& options) {
  constexpr double kEnoughOfForces = 0.01;
  constexpr int kMostOfForces = 10;
  if (series.rows() <= options.skip) {
    throw BadInput(
        fmt::format("{} rows to fit, of which {} are skipped", series.rows(), options.skip));
  }
  const auto head = static_cast<std::size_t>(std::min(series.rows(), kFirstRows));
  const Series first = Slice(series, {0, head});
  const Index skip = std::min(options.skip, static_cast<Index>(head) / 2);
  FreeRunFit forces(Scaled(start, first, at_rest, skip), first, at_rest, skip, Free::kForces);
  for (int n = 0; n < kMostOfForces && forces.Step() > kEnoughOfForces; ++n) {
  }
  const SuspendedRotor from = forces.model();
  FreeRunFit all(from, series, at_rest, options.skip, Free::kAll);
  const RowRange judged{static_cast<std::size_t>(options.skip),
                        static_cast<std::size_t>(series.rows())};
  RefuseUnfit(Slice(series, judged), static_cast<std::size_t>(all.unknowns()));
  SuspendedRotorFit fit{start, all.rms_m(), 0.0, all.unknowns(), 0};
  if (!all.runs()) {
    throw BadInput("the model that fits the first rows does not run free through all of them");
  }
  while (fit.iterations < options.most_iterations) {
    ++fit.iterations;
    if (all.Step() < options.least_gain) break;
  }
  fit.model = all.model();
  fit.rms_after_m = all.rms_m();
  return fit;
}

}  // namespace levitas::identification
