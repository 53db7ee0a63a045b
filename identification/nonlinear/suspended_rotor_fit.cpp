#include "identification/nonlinear/suspended_rotor_fit.hpp"

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "common/problem.hpp"
#include "numerics/minimum/levenberg_marquardt.hpp"

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

/// A model and its free run over the judged rows, in one column; empty when the run diverges.
struct ModelRun {
  SuspendedRotor model;
  Eigen::VectorXd readings;
};

/// The free run's squared error over the numbers of a model, for numerics::LevenbergMarquardt.
class FreeRunError {
 public:
  using Iterate = numerics::Iterate<ModelRun>;

  FreeRunError(const SuspendedRotor& start, const Series& series, const LoopAtRest& at_rest,
               Index skip, Free free)
      : start_(start),
        rows_(series.rows()),
        judged_(series.rows() - skip),
        at_rest_(at_rest),
        free_(free),
        measured_(series.output.bottomRows(judged_).reshaped()) {
    SuspendedRotor count = start;
    ForEachUnknown(count, start, free, [&](double&, double) { ++unknowns_; });
  }

  [[nodiscard]] Index unknowns() const noexcept { return unknowns_; }
  [[nodiscard]] double RmsM(const Iterate& at) const noexcept {
    return std::sqrt(at.cost / static_cast<double>(measured_.size()));
  }
  [[nodiscard]] Iterate At(SuspendedRotor model) const {
    Eigen::VectorXd readings = Readings(model);
    const double squares = readings.size() == 0 ? std::numeric_limits<double>::infinity()
                                                : (measured_ - readings).squaredNorm();
    return {{std::move(model), std::move(readings)}, squares};
  }
  [[nodiscard]] Iterate Step(const ModelRun& from, const Eigen::VectorXd& step) const {
    return At(Moved(from.model, step));
  }
  /// By forward differences; nothing when a neighbour diverges.
  [[nodiscard]] std::optional<numerics::NormalEquations> Linearise(const Iterate& at) const {
    Eigen::MatrixXd jacobian(measured_.size(), unknowns_);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(unknowns_);
    for (Index n = 0; n < unknowns_; ++n) {
      step[n] = kDifference;
      const Eigen::VectorXd neighbour = Readings(Moved(at.point.model, step));
      if (neighbour.size() == 0) return std::nullopt;
      jacobian.col(n) = (neighbour - at.point.readings) / kDifference;
      step[n] = 0.0;
    }
    numerics::NormalEquations equations{Eigen::MatrixXd::Zero(unknowns_, unknowns_),
                                        jacobian.transpose() * (at.point.readings - measured_)};
    equations.matrix.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
    return equations;
  }

 private:
  [[nodiscard]] SuspendedRotor Moved(const SuspendedRotor& from,
                                     const Eigen::VectorXd& step) const {
    SuspendedRotor moved = from;
    Index n = 0;
    ForEachUnknown(moved, start_, free_,
                   [&](double& value, double scale) { value += scale * step[n++]; });
    return moved;
  }
  [[nodiscard]] Eigen::VectorXd Readings(const SuspendedRotor& model) const {
    const Prediction run = RunFree(model, rows_, at_rest_());
    if (run.diverged_at) return {};
    return run.output.bottomRows(judged_).reshaped();
  }

  SuspendedRotor start_;
  Index rows_, judged_;
  const LoopAtRest& at_rest_;
  Free free_;
  Eigen::VectorXd measured_;
  Index unknowns_{};
};

/// The damping starts low because forces and gaps come from a design. At its least value a step is
/// Gauss-Newton's to nine digits; at its greatest value a step no longer moves the model.
numerics::LevenbergMarquardtOptions Options(int most_steps, double least_relative_gain) {
  return {.first_damping = 1e-4,
          .least_damping = 1e-9,
          .most_damping = 1e8,
          .most_steps = most_steps,
          .least_relative_gain = least_relative_gain};
}

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
    const FreeRunError error(trial, series, at_rest, skip, Free::kForces);
    const double rms_m = error.RmsM(error.At(trial));
    if (!(rms_m < least_m)) continue;
    least_m = rms_m;
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
  const SuspendedRotor scaled = Scaled(start, first, at_rest, skip);
  FreeRunError forces(scaled, first, at_rest, skip, Free::kForces);
  const SuspendedRotor from = numerics::LevenbergMarquardt(forces, forces.At(scaled),
                                                           Options(kMostOfForces, kEnoughOfForces))
                                  .at.point.model;
  FreeRunError all(from, series, at_rest, options.skip, Free::kAll);
  const RowRange judged{static_cast<std::size_t>(options.skip),
                        static_cast<std::size_t>(series.rows())};
  RefuseUnfit(Slice(series, judged), static_cast<std::size_t>(all.unknowns()));
  auto begin = all.At(from);
  SuspendedRotorFit fit{start, all.RmsM(begin), 0.0, all.unknowns(), 0};
  if (!std::isfinite(begin.cost)) {
    throw BadInput("the model that fits the first rows does not run free through all of them");
  }
  const auto found = numerics::LevenbergMarquardt(
      all, std::move(begin), Options(options.most_iterations, options.least_gain));
  fit.iterations = found.steps;
  fit.model = found.at.point.model;
  fit.rms_after_m = all.RmsM(found.at);
  return fit;
}

}  // namespace levitas::identification
