#include "identification/modal/modal_quality.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "identification/modal/working_gains.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::identification {

std::vector<Eigen::MatrixXcd> ModelOn(const ModalStart& start, const Eigen::VectorXd& vector,
                                      const FrequencyResponse& response) {
  const Physical rig = ToPhysical(start.frame, vector);
  const double speed = std::abs(response.speed_rad_per_s) < 1.0 ? 0.0 : response.speed_rad_per_s;
  std::vector<Eigen::MatrixXcd> lines;
  lines.reserve(response.frequency_hz.size());
  const WorkingGains gains = WorkingGainsOf(start.frame, response);
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const Eigen::MatrixXcd& currents = response.currents[k];
    lines.push_back(
        ExperimentResponse(start.frame, rig, response.frequency_hz[k], speed, gains, currents) *
        currents.inverse());
  }
  return lines;
}

Eigen::VectorXd MisfitByChannel(const FrequencyResponse& response,
                                const std::vector<Eigen::MatrixXcd>& model,
                                const ModalFitOptions& options) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(response.axes());
  double count = 0.0;
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const double f = response.frequency_hz[k];
    if (f < options.lowest_hz || f > options.highest_hz) continue;
    const Eigen::ArrayXXd allowed =
        response.variance[k].array() +
        options.floor * options.floor * response.plant[k].cwiseAbs2().array();
    sum += ((response.plant[k] - model[k]).cwiseAbs2().array() / allowed).rowwise().sum().matrix();
    count += static_cast<double>(model[k].cols());
  }
  if (count > 0.0) sum /= count;
  return sum;
}

double Misfit(const FrequencyResponse& response, const std::vector<Eigen::MatrixXcd>& model,
              const ModalFitOptions& options) {
  return MisfitByChannel(response, model, options).mean();
}

FitShare FitOf(const FrequencyResponse& response, const std::vector<Eigen::MatrixXcd>& model,
               const ModalFitOptions& options) {
  double left = 0.0;
  double noise = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const double f = response.frequency_hz[k];
    if (f < options.lowest_hz || f > options.highest_hz) continue;
    const Eigen::ArrayXXd size = response.plant[k].cwiseAbs2().array();
    const Eigen::ArrayXXd allowed =
        response.variance[k].array() + options.floor * options.floor * size;
    left += ((response.plant[k] - model[k]).cwiseAbs2().array() / allowed).sum();
    noise += (response.variance[k].array() / allowed).sum();
    all += (size / allowed).sum();
  }
  if (all <= 0.0) return {};
  return {100.0 * (1.0 - std::sqrt(left / all)), 100.0 * (1.0 - std::sqrt(noise / all))};
}

std::vector<double> WhirlFrequenciesHz(const Physical& rig, double speed_rad_per_s) {
  // u e^{jlt}: l^2 u = w^2 u + l W G u, as a symmetric problem, docs/derivations.md (9).
  const Eigen::Index n = rig.frequency_rad_per_s.size();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n) = rig.frequency_rad_per_s.asDiagonal();
  companion.bottomLeftCorner(n, n) = rig.frequency_rad_per_s.asDiagonal();
  companion.bottomRightCorner(n, n) = speed_rad_per_s * rig.gyroscopic;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(companion, Eigen::EigenvaluesOnly);
  std::vector<double> frequencies;
  for (Eigen::Index i = 0; i < 2 * n; ++i) {
    const double f = solver.eigenvalues()[i] / (2.0 * std::numbers::pi);
    // Rigid translation and the conical mode are no bending modes.
    if (std::abs(f) > 0.5 * rig.frequency_rad_per_s[2] / (2.0 * std::numbers::pi)) {
      frequencies.push_back(f);
    }
  }
  return frequencies;
}

}  // namespace levitas::identification
