#pragma once
// Fits the modal model to measured responses: nonlinear least squares in stages, each of which
// leads the next into its valley.
//
// Stages    1 frequencies and dampings of the stabilisation diagram replace the start's
//             (mode_support.hpp); where the pairing is open, candidates compete (modal_pairing.hpp)
//           2 approach: log-magnitude on few lines, soft-L1 loss, with poles held; between rounds
//             the free rotor's frequencies move until the poles in the magnets are the diagram's
//           3 complex, soft-L1, poles still held, so that none leaves its peak while the
//             deflections are wrong; 4 with poles free; modes that no pole shows are looked for
//             (PlaceOthers); then 5 plain complex: the maximum-likelihood fit
//           6 diagonal of the gyroscopic matrix from the whirl frequencies (whirl_start.hpp), then
//             all of it from data at speed, soft-L1 and plain; 7 everything together
// Residual  line_residuals.hpp: resonances and anti-resonances get the weight that the data's own
//           scatter gives them, nothing is chosen by hand. `floor` stands for what repeats and is
//           not linear beyond the magnets' law (working_gains.hpp).
// Prior     (theta - theta_rig)/prior for every unknown, see modal_parameters.hpp.
// Solver    Ceres, Levenberg-Marquardt, analytic derivatives.
// Thread    any; uses `threads` of its own. Failure: none thrown; `converged` says.

#include <string>
#include <vector>

#include "identification/frf/frequency_response.hpp"
#include "identification/modal/mode_support.hpp"

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
  Assigned assigned;  ///< the pairing that led lowest
  Eigen::VectorXd vector;
  std::vector<bool> fitted;  ///< per unknown
  std::vector<FitStage> stages;
  double cost{};
  std::size_t residuals{};  ///< real ones, prior not counted
  double reduced_chi_square{};
  Eigen::MatrixXd information;  ///< J^T J of the data alone at the optimum, all unknowns
  Eigen::MatrixXd scatter;      ///< of J^T r over neighbouring lines: `information`, were r noise
  bool converged{};
};

/// `standing` is needed; `spinning` may be empty, the gyroscopic matrix then stays the start's.
/// `begin` is where the search starts; `start` holds frame and prior.
[[nodiscard]] ModalFit FitModal(const ModalStart& start, const Eigen::VectorXd& begin,
                                const std::vector<Assigned>& candidates,
                                const FrequencyResponse& standing,
                                const std::vector<FrequencyResponse>& spinning,
                                const ModalFitOptions& options);

}  // namespace levitas::identification
