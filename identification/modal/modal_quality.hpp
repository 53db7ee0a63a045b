#pragma once
// How well a fitted model explains a response, in or out of the fit.
//
// Misfit    mean of |P_model - P_data|^2 / (var + (floor |P_data|)^2) over entries and lines: 1
//           when only noise is left.
// Fit       100 (1 - sqrt(sum |P_model - P_data|^2 / sum |P_data|^2)) over the same, every line and
//           entry in units of what it is allowed; the ceiling has the variance of the data in place
//           of the difference: no model can do better on these data.
// Thread    any.

#include <vector>

#include "identification/modal/modal_fit.hpp"

namespace levitas::identification {

/// The model on the lines of a response: what its experiments would have given, P = G Q^-1 with the
/// working gains of each.
[[nodiscard]] std::vector<Eigen::MatrixXcd> ModelOn(const ModalStart& start,
                                                    const Eigen::VectorXd& vector,
                                                    const FrequencyResponse& response);

[[nodiscard]] double Misfit(const FrequencyResponse& response,
                            const std::vector<Eigen::MatrixXcd>& model,
                            const ModalFitOptions& options);

/// The same per output.
[[nodiscard]] Eigen::VectorXd MisfitByChannel(const FrequencyResponse& response,
                                              const std::vector<Eigen::MatrixXcd>& model,
                                              const ModalFitOptions& options);

struct FitShare {
  double fit{}, ceiling{};
};
[[nodiscard]] FitShare FitOf(const FrequencyResponse& response,
                             const std::vector<Eigen::MatrixXcd>& model,
                             const ModalFitOptions& options);

/// Frequencies of the free rotor with the fitted gyroscopic matrix, signed by whirl, ascending.
[[nodiscard]] std::vector<double> WhirlFrequenciesHz(const Physical& rig, double speed_rad_per_s);

}  // namespace levitas::identification
