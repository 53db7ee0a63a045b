#pragma once
// Fits the modal model to measured responses: nonlinear least squares in stages, each of which
// leads the next into its valley.
//
// Stages    1 peak-picked frequencies and dampings replace the start's where one lies within 25 %
//             (stabilisation.hpp)
//           2 log-magnitude, soft-L1 loss, standing data: far from the optimum every resonance
//           pulls 3 complex residual, soft-L1, then 4 plain: the maximum-likelihood fit 5
//           gyroscopic matrix alone, from data at speed; 6 everything together
// Residual  (P - P_data)/sqrt(var + (floor |P_data|)^2) per entry and line: resonances and
//           anti-resonances get the weight that the data's own scatter gives them, nothing is
//           chosen by hand. `floor` stands for what repeats and is not linear.
// Prior     (theta - theta_rig)/prior for every unknown, see modal_parameters.hpp.
// Solver    Ceres, Levenberg-Marquardt, analytic derivatives.
// Thread    any; uses `threads` of its own. Failure: none thrown; `converged` says.

#include <string>
#include <vector>

#include "identification/frf/frequency_response.hpp"
#include "identification/modal/modal_parameters.hpp"
#include "identification/modal/stabilisation.hpp"

namespace levitas::identification {

struct ModalFitOptions {
  double lowest_hz{3.0};
  double highest_hz{1200.0};
  double floor{0.005};
  bool fit_amplifiers{false};
  bool fit_sensors{false};
  bool fit_delay{true};
  int threads{2};
};

struct FitStage {
  std::string name;
  double cost{};  ///< half the sum of squares, prior included
  int iterations{};
  double time_s{};
};

struct ModalFit {
  Eigen::VectorXd vector;
  std::vector<bool> fitted;  ///< per unknown
  std::vector<FitStage> stages;
  double cost{};
  std::size_t residuals{};  ///< real ones, prior not counted
  double reduced_chi_square{};
  Eigen::MatrixXd information;  ///< J^T J of the data alone at the optimum, all unknowns
  bool converged{};
};

/// `standing` is needed; `spinning` may be empty, the gyroscopic matrix then stays the start's.
/// `begin` is where the search starts; `start` holds frame and prior.
[[nodiscard]] ModalFit FitModal(const ModalStart& start, const Eigen::VectorXd& begin,
                                const std::vector<ProposedMode>& modes,
                                const FrequencyResponse& standing,
                                const std::vector<FrequencyResponse>& spinning,
                                const ModalFitOptions& options);

}  // namespace levitas::identification
