#include "identification/modal/modal_fit.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "identification/modal/line_cost.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

using Kind = LineKind;

/// Neighbouring lines whose misfit may have one cause, as the flank of a resonance.
constexpr std::size_t kCluster = 8;
constexpr int kPoleRounds = 8;
constexpr int kApproaches = 3;
/// ln of a damping that the diagram gives: it is taken from the same data, roughly.
constexpr double kDampingPrior = 0.5;

struct StageSetup {
  std::string name;
  std::vector<const FrequencyResponse*> data{};
  Kind kind{Kind::kComplex};
  bool robust{};
  bool rig_free{true};
  bool poles_free{true};
  bool gyroscopic_free{};
  int iterations{60};
  std::size_t stride{1};  ///< every n-th line
};

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

class Search {
 public:
  Search(const ModalStart& start, const Assigned& assigned, const ModalFitOptions& options,
         ModalFit& fit)
      : start_(start), assigned_(assigned), options_(options), fit_(fit) {}

  void Run(const StageSetup& setup) {
    ceres::Problem problem;
    AddBlocks(setup, problem);
    const ModalLayout& at = start_.frame.layout;
    fit_.fitted = FreeUnknowns(at, options_, setup, assigned_);
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

  /// J^T J, its likeness from the residuals and the sum of squares of the data at the optimum.
  void Inform(const StageSetup& setup) {
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
  const Assigned& assigned_;
  const ModalFitOptions& options_;
  ModalFit& fit_;
};

/// Moves the free rotor's frequencies until the poles in the magnets are those of the diagram: a
/// resonance that starts beside its peak is flattened by damping before it finds it.
void MeetPoles(const ModalFrame& frame, const Assigned& assigned, Eigen::VectorXd& vector) {
  const ModalLayout& at = frame.layout;
  for (int round = 0; round < kPoleRounds; ++round) {
    const Physical rig = ToPhysical(frame, vector);
    const auto support = SupportOf(rig, assigned);
    for (Index i = 0; i < at.bending; ++i) {
      const ModeSupport& mode = support[static_cast<std::size_t>(i)];
      if (mode.shown_hz <= 0.0) continue;
      if (mode.plant_hz <= 0.0) {  // the magnets pull the mode away altogether
        vector[at.frequency + i] += 0.1;
        continue;
      }
      const double off = mode.shown_hz * mode.shown_hz - mode.plant_hz * mode.plant_hz;
      const double hz = rig.frequency_rad_per_s[2 + i] / (2.0 * std::numbers::pi);
      const double lowest = 0.25 * mode.shown_hz * mode.shown_hz;
      vector[at.frequency + i] =
          std::log(2.0 * std::numbers::pi * std::sqrt(std::max(hz * hz + off, lowest)));
    }
  }
}

/// Alternately the poles and everything else, on few lines: leads a poor start into the valley.
void Approach(Search& search, const ModalStart& start, const Assigned& assigned,
              const FrequencyResponse& standing, ModalFit& fit) {
  for (int round = 0; round < kApproaches; ++round) {
    MeetPoles(start.frame, assigned, fit.vector);
    search.Run({.name = "log magnitude, poles held",
                .data = {&standing},
                .kind = Kind::kLogMagnitude,
                .robust = true,
                .poles_free = false,
                .iterations = 6,
                .stride = 8});
  }
  MeetPoles(start.frame, assigned, fit.vector);
}

/// Where the search begins with one pairing of modes, and its prior.
ModalStart Paired(const ModalStart& start, const Assigned& assigned, Eigen::VectorXd& vector) {
  const ModalLayout& at = start.frame.layout;
  ModalStart prior = start;
  for (Index i = 0; i < at.bending; ++i) {
    if (const auto& mode = assigned[static_cast<std::size_t>(i)]; mode) {
      vector[at.frequency + i] = std::log(2.0 * std::numbers::pi * mode->frequency_hz);
      vector[at.damping + i] = std::log(std::clamp(mode->damping_ratio, 5e-4, 0.01));
      prior.vector[at.frequency + i] = vector[at.frequency + i];
      prior.vector[at.damping + i] = vector[at.damping + i];
      prior.prior[at.damping + i] = kDampingPrior;
    } else {
      vector[at.frequency + i] = start.vector[at.frequency + i];
      vector[at.damping + i] = start.vector[at.damping + i];
    }
  }
  return prior;
}

/// The pairing whose approach ends lowest; its approach is kept in `fit`.
Assigned BestPairing(const ModalStart& start, const Eigen::VectorXd& begin,
                     const std::vector<Assigned>& candidates, const FrequencyResponse& standing,
                     const ModalFitOptions& options, ModalFit& fit) {
  std::optional<std::size_t> best;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    ModalFit one;
    one.vector = begin;
    const ModalStart prior = Paired(start, candidates[n], one.vector);
    Search search(prior, candidates[n], options, one);
    Approach(search, prior, candidates[n], standing, one);
    if (best && one.cost >= fit.cost) continue;
    best = n;
    fit = std::move(one);
  }
  return candidates[best.value()];
}

void FitSpinning(Search& search, const FrequencyResponse& standing,
                 const std::vector<FrequencyResponse>& spinning, StageSetup& last) {
  StageSetup gyroscopic{.name = "gyroscopic matrix",
                        .rig_free = false,
                        .gyroscopic_free = true,
                        .iterations = 15,
                        .stride = 2};
  for (const auto& response : spinning) gyroscopic.data.push_back(&response);
  search.Run(gyroscopic);
  last = {.name = "all speeds together",
          .data = {&standing},
          .gyroscopic_free = true,
          .iterations = 30};
  last.data.insert(last.data.end(), gyroscopic.data.begin(), gyroscopic.data.end());
  search.Run(last);
}

}  // namespace

ModalFit FitModal(const ModalStart& start, const Eigen::VectorXd& begin,
                  const std::vector<Assigned>& candidates, const FrequencyResponse& standing,
                  const std::vector<FrequencyResponse>& spinning, const ModalFitOptions& options) {
  ModalFit fit;
  fit.assigned = BestPairing(start, begin, candidates, standing, options, fit);
  Eigen::VectorXd unused = begin;
  const ModalStart prior = Paired(start, fit.assigned, unused);
  const Assigned assigned = fit.assigned;
  Search search(prior, assigned, options, fit);
  search.Run({.name = "log magnitude, soft L1",
              .data = {&standing},
              .kind = Kind::kLogMagnitude,
              .robust = true,
              .iterations = 30,
              .stride = 4});
  search.Run({.name = "complex, soft L1",
              .data = {&standing},
              .robust = true,
              .iterations = 40,
              .stride = 2});
  StageSetup last{.name = "complex", .data = {&standing}};
  search.Run(last);
  if (!spinning.empty()) FitSpinning(search, standing, spinning, last);
  search.Inform(last);
  return fit;
}

}  // namespace levitas::identification
