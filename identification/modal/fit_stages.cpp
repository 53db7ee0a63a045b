#include "identification/modal/fit_stages.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>

#include "identification/modal/normal_cost.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;
using Kind = LineKind;

/// Neighbouring lines whose misfit may have one cause, as the flank of a resonance.
constexpr std::size_t kCluster = 24;

std::vector<bool> FreeUnknowns(const ModalLayout& at, const ModalFitOptions& options,
                               const StageSetup& setup, const Assigned& assigned) {
  std::vector<bool> free(static_cast<std::size_t>(at.size), false);
  const auto set = [&free](Index from, Index count, bool value) {
    std::fill_n(free.begin() + from, count, value);
  };
  if (setup.rig_free) set(0, at.delay, true);
  for (Index i = 0; i < at.bending; ++i) {
    const bool shown =
        setup.rig_free && setup.poles_free && assigned[static_cast<std::size_t>(i)].has_value();
    set(at.frequency + i, 1, shown);
    set(at.damping + i, 1, shown);
  }
  set(at.delay, 1, setup.rig_free && options.fit_delay);
  set(at.amplifier, at.bearings, setup.rig_free && options.fit_amplifiers);
  set(at.sensor, at.bearings, setup.rig_free && options.fit_sensors);
  set(at.gyroscopic, at.size - at.gyroscopic, setup.gyroscopic_free);
  return free;
}

std::vector<Index> Indices(const std::vector<bool>& chosen) {
  std::vector<Index> indices;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (chosen[k]) indices.push_back(static_cast<Index>(k));
  }
  return indices;
}

}  // namespace

void Search::Run(const StageSetup& setup) {
  fit_.fitted = FreeUnknowns(start_.frame.layout, options_, setup, assigned_);
  const std::vector<Index> free = Indices(fit_.fitted);
  Eigen::VectorXd unknowns = fit_.vector(free);
  auto cost = std::make_unique<NormalCost>(start_, fit_.vector, free, AllLines(setup), setup.robust,
                                           options_.threads);
  const NormalCost& all = *cost;
  ceres::Problem problem;
  problem.AddResidualBlock(cost.release(), nullptr, unknowns.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = setup.iterations;
  solver.function_tolerance = setup.robust ? 1e-3 : 1e-6;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  fit_.vector = all.Whole(unknowns.data());
  fit_.stages.push_back({setup.name, summary.final_cost,
                         static_cast<int>(summary.iterations.size()) - 1,
                         summary.total_time_in_seconds});
  fit_.cost = summary.final_cost;
  fit_.converged = summary.termination_type == ceres::CONVERGENCE;
}

double Search::CostAt(const Eigen::VectorXd& vector, const StageSetup& setup) const {
  const NormalCost cost(start_, vector, {0}, AllLines(setup), setup.robust, options_.threads);
  const double* first = vector.data();
  std::array<double, 2> residuals{};
  if (!cost.Evaluate(&first, residuals.data(), nullptr)) {
    return std::numeric_limits<double>::infinity();
  }
  return 0.5 * (residuals[0] * residuals[0] + residuals[1] * residuals[1]);
}

void Search::Inform(const StageSetup& setup) {
  const Index n = start_.frame.layout.size;
  fit_.information = Eigen::MatrixXd::Zero(n, n);
  fit_.scatter = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(n);
  std::size_t in_cluster = 0;
  const auto close = [&] {
    fit_.scatter.noalias() += pull * pull.transpose();
    pull.setZero();
    in_cluster = 0;
  };
  double squares = 0.0;
  fit_.residuals = 0;
  const Physical rig = ToPhysical(start_.frame, fit_.vector);
  const std::vector<Index> all = Indices(std::vector<bool>(fit_.fitted.size(), true));
  ResponseDerivative workspace;
  for (const FitData* data : setup.data) {
    for (const std::size_t line : Lines(data->response, 1)) {
      const LineResiduals one = Residuals(*data, line, Kind::kComplex);
      const Index rows = one.rows();
      Eigen::VectorXd residual(rows);
      const std::span<double> to(residual.data(), static_cast<std::size_t>(rows));
      RowMajor jacobian(rows, n);
      one.Evaluate(rig, all, workspace, to, jacobian);
      fit_.information.noalias() += jacobian.transpose() * jacobian;
      pull.noalias() += jacobian.transpose() * residual;
      if (++in_cluster == kCluster) close();
      squares += residual.squaredNorm();
      fit_.residuals += static_cast<std::size_t>(rows);
    }
    close();
  }
  const auto unknowns = static_cast<double>(std::ranges::count(fit_.fitted, true));
  fit_.reduced_chi_square = squares / (static_cast<double>(fit_.residuals) - unknowns);
}

std::vector<std::size_t> Search::Lines(const FrequencyResponse& data, std::size_t stride) const {
  std::vector<std::size_t> lines;
  for (std::size_t k = 0; k < data.frequency_hz.size(); k += stride) {
    const double f = data.frequency_hz[k];
    if (f >= options_.lowest_hz && f <= options_.highest_hz) lines.push_back(k);
  }
  return lines;
}

LineResiduals Search::Residuals(const FitData& data, std::size_t line, Kind kind) const {
  return {start_.frame, data.response, data.gains, line, kind, options_.floor};
}

std::vector<LineResiduals> Search::AllLines(const StageSetup& setup) const {
  std::vector<LineResiduals> all;
  for (const FitData* data : setup.data) {
    for (const std::size_t line : Lines(data->response, setup.stride)) {
      if (setup.marks != nullptr) {
        all.emplace_back(start_.frame, data->response, data->gains, line, (*setup.marks)[line]);
      } else {
        all.push_back(Residuals(*data, line, setup.kind));
      }
    }
  }
  return all;
}

}  // namespace levitas::identification
