#include "identification/modal/modal_fit.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "identification/modal/modal_response.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

enum class Kind { kLogMagnitude, kComplex };

/// Least relative noise of a log-magnitude: far from the optimum nothing is worth more.
constexpr double kLogFloor = 0.1;

/// One line of one response. Standing, only the entries within a plane are compared.
class LineCost : public ceres::CostFunction {
 public:
  LineCost(const ModalFrame& frame, const FrequencyResponse& data, std::size_t line, Kind kind,
           double floor)
      : frame_(frame), data_(data), line_(line), kind_(kind) {
    const double speed = std::abs(data.speed_rad_per_s) < 1.0 ? 0.0 : data.speed_rad_per_s;
    speed_rad_per_s_ = speed;
    for (Index j = 0; j < data.axes(); ++j) {
      for (Index i = 0; i < data.axes(); ++i) {
        if (speed == 0.0 && (i + j) % 2 != 0) continue;
        const auto value = data.plant[line](i, j);
        const double variance = 0.5 * data.variance[line](i, j);  // of each part
        const double sigma = kind == Kind::kComplex
                                 ? std::sqrt(variance + floor * floor * std::norm(value))
                                 : std::sqrt(variance / std::norm(value) + kLogFloor * kLogFloor);
        entries_.push_back({i + data.axes() * j, value, 1.0 / sigma});
      }
    }
    const auto per_entry = kind == Kind::kComplex ? 2U : 1U;
    set_num_residuals(static_cast<int>(per_entry * entries_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(frame.layout.size));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> vector(parameters[0], frame_.layout.size);
    const bool derive = jacobians != nullptr && jacobians[0] != nullptr;
    ResponseDerivative derivative;
    const Eigen::MatrixXcd model =
        ModalResponse(frame_, ToPhysical(frame_, vector), data_.frequency_hz[line_],
                      speed_rad_per_s_, derive ? &derivative : nullptr);
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> jacobian(
        derive ? jacobians[0] : nullptr, derive ? num_residuals() : 0,
        derive ? frame_.layout.size : 0);
    Index row = 0;
    for (const Entry& e : entries_) {
      const auto value = model.data()[e.at];
      if (kind_ == Kind::kComplex) {
        residuals[row] = e.weight * (value - e.data).real();
        residuals[row + 1] = e.weight * (value - e.data).imag();
        if (derive) {
          jacobian.row(row) = e.weight * derivative.row(e.at).real();
          jacobian.row(row + 1) = e.weight * derivative.row(e.at).imag();
        }
        row += 2;
      } else {
        residuals[row] = e.weight * std::log(std::abs(value) / std::abs(e.data));
        if (derive) jacobian.row(row) = e.weight * (derivative.row(e.at) / value).real();
        row += 1;
      }
    }
    return std::isfinite(model.cwiseAbs2().sum());
  }

 private:
  struct Entry {
    Index at;
    std::complex<double> data;
    double weight;
  };
  const ModalFrame& frame_;
  const FrequencyResponse& data_;
  std::size_t line_;
  Kind kind_;
  double speed_rad_per_s_{};
  std::vector<Entry> entries_;
};

class PriorCost : public ceres::CostFunction {
 public:
  explicit PriorCost(const ModalStart& start) : start_(start) {
    set_num_residuals(static_cast<int>(start.vector.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(start.vector.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Index n = start_.vector.size();
    const Eigen::Map<const Eigen::VectorXd> vector(parameters[0], n);
    Eigen::Map<Eigen::VectorXd>(residuals, n) =
        (vector - start_.vector).cwiseQuotient(start_.prior);
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::MatrixXd>(jacobians[0], n, n) =
          start_.prior.cwiseInverse().asDiagonal().toDenseMatrix();
    }
    return true;
  }

 private:
  const ModalStart& start_;
};

struct StageSetup {
  std::string name;
  std::vector<const FrequencyResponse*> data{};
  Kind kind{Kind::kComplex};
  bool robust{};
  bool rig_free{true};
  bool gyroscopic_free{};
  int iterations{60};
  std::size_t stride{1};  ///< every n-th line
};

std::vector<bool> FreeUnknowns(const ModalLayout& at, const ModalFitOptions& options,
                               const StageSetup& setup) {
  std::vector<bool> free(static_cast<std::size_t>(at.size), false);
  const auto set = [&free](Index from, Index count, bool value) {
    std::fill_n(free.begin() + from, count, value);
  };
  if (setup.rig_free) set(0, at.delay, true);
  set(at.delay, 1, setup.rig_free && options.fit_delay);
  set(at.amplifier, at.bearings, setup.rig_free && options.fit_amplifiers);
  set(at.sensor, at.bearings, setup.rig_free && options.fit_sensors);
  set(at.gyroscopic, at.size - at.gyroscopic, setup.gyroscopic_free);
  return free;
}

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// A rotor's drawing is rarely wrong by more, and bending modes are rarely closer.
constexpr double kNearMode = 0.25;

const ProposedMode* NearestMode(const std::vector<ProposedMode>& modes, double frequency_hz) {
  const auto distance = [&](const ProposedMode& m) {
    return std::abs(std::log(m.frequency_hz / frequency_hz));
  };
  const auto nearest = std::ranges::min_element(modes, {}, distance);
  return nearest != modes.end() && distance(*nearest) < kNearMode ? &*nearest : nullptr;
}

class Search {
 public:
  Search(const ModalStart& start, const ModalFitOptions& options, ModalFit& fit)
      : start_(start), options_(options), fit_(fit) {}

  void Run(const StageSetup& setup) {
    ceres::Problem problem;
    AddBlocks(setup, problem);
    const ModalLayout& at = start_.frame.layout;
    fit_.fitted = FreeUnknowns(at, options_, setup);
    std::vector<int> constant;
    for (std::size_t k = 0; k < fit_.fitted.size(); ++k) {
      if (!fit_.fitted[k]) constant.push_back(static_cast<int>(k));
    }
    if (!constant.empty()) {
      problem.SetManifold(fit_.vector.data(),
                          // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): the problem owns it
                          new ceres::SubsetManifold(static_cast<int>(at.size), constant));
    }
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = setup.iterations;
    solver.function_tolerance = setup.robust ? 1e-3 : 1e-6;
    solver.num_threads = options_.threads;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    fit_.stages.push_back({setup.name, summary.final_cost,
                           static_cast<int>(summary.iterations.size()) - 1,
                           summary.total_time_in_seconds});
    fit_.cost = summary.final_cost;
    fit_.converged = summary.termination_type == ceres::CONVERGENCE;
  }

  /// J^T J and the sum of squares of the data at the optimum.
  void Inform(const StageSetup& setup) {
    const Index n = start_.frame.layout.size;
    fit_.information = Eigen::MatrixXd::Zero(n, n);
    double squares = 0.0;
    fit_.residuals = 0;
    for (const FrequencyResponse* data : setup.data) {
      for (const std::size_t line : Lines(*data, 1)) {
        const LineCost cost(start_.frame, *data, line, Kind::kComplex, options_.floor);
        const Index rows = cost.num_residuals();
        Eigen::VectorXd residual(rows);
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(rows, n);
        const double* parameters = fit_.vector.data();
        double* jacobians = jacobian.data();
        (void)cost.Evaluate(&parameters, residual.data(), &jacobians);
        fit_.information.noalias() += jacobian.transpose() * jacobian;
        squares += residual.squaredNorm();
        fit_.residuals += static_cast<std::size_t>(rows);
      }
    }
    const auto unknowns = static_cast<double>(std::ranges::count(fit_.fitted, true));
    fit_.reduced_chi_square = squares / (static_cast<double>(fit_.residuals) - unknowns);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> Lines(const FrequencyResponse& data,
                                               std::size_t stride) const {
    std::vector<std::size_t> lines;
    for (std::size_t k = 0; k < data.frequency_hz.size(); k += stride) {
      const double f = data.frequency_hz[k];
      if (f >= options_.lowest_hz && f <= options_.highest_hz) lines.push_back(k);
    }
    return lines;
  }

  void AddBlocks(const StageSetup& setup, ceres::Problem& problem) {
    for (const FrequencyResponse* data : setup.data) {
      for (const std::size_t line : Lines(*data, setup.stride)) {
        auto cost =
            std::make_unique<LineCost>(start_.frame, *data, line, setup.kind, options_.floor);
        const int size = cost->num_residuals();
        // The loss acts on the block's sum of squares: scaled so that one sigma per residual is
        // the bend.
        auto loss = setup.robust ? std::make_unique<ceres::SoftLOneLoss>(std::sqrt(size)) : nullptr;
        problem.AddResidualBlock(cost.release(), loss.release(), fit_.vector.data());
      }
    }
    problem.AddResidualBlock(std::make_unique<PriorCost>(start_).release(), nullptr,
                             fit_.vector.data());
  }

  const ModalStart& start_;
  const ModalFitOptions& options_;
  ModalFit& fit_;
};

}  // namespace

ModalFit FitModal(const ModalStart& start, const Eigen::VectorXd& begin,
                  const std::vector<ProposedMode>& modes, const FrequencyResponse& standing,
                  const std::vector<FrequencyResponse>& spinning, const ModalFitOptions& options) {
  ModalFit fit;
  fit.vector = begin;
  const ModalLayout& at = start.frame.layout;
  ModalStart prior = start;
  for (Index i = 0; i < at.bending; ++i) {
    const double known_hz = std::exp(start.vector[at.frequency + i]) / kTwoPi;
    const ProposedMode* mode = NearestMode(modes, known_hz);
    if (mode == nullptr) continue;
    fit.vector[at.frequency + i] = std::log(kTwoPi * mode->frequency_hz);
    fit.vector[at.damping + i] = std::log(std::clamp(mode->damping_ratio, 5e-4, 0.01));
    prior.vector[at.frequency + i] = fit.vector[at.frequency + i];
  }
  Search search(prior, options, fit);
  search.Run({.name = "log magnitude, soft L1",
              .data = {&standing},
              .kind = Kind::kLogMagnitude,
              .robust = true,
              .iterations = 30,
              .stride = 2});
  search.Run({.name = "complex, soft L1", .data = {&standing}, .robust = true, .iterations = 30});
  StageSetup last{.name = "complex", .data = {&standing}};
  search.Run(last);
  if (!spinning.empty()) {
    StageSetup gyroscopic{.name = "gyroscopic matrix",
                          .rig_free = false,
                          .gyroscopic_free = true,
                          .iterations = 15,
                          .stride = 2};
    for (const auto& response : spinning) gyroscopic.data.push_back(&response);
    search.Run(gyroscopic);
    last.name = "all speeds together";
    last.gyroscopic_free = true;
    last.data.insert(last.data.end(), gyroscopic.data.begin(), gyroscopic.data.end());
    last.iterations = 8;
    search.Run(last);
  }
  search.Inform(last);
  return fit;
}

}  // namespace levitas::identification
