#include "tests/unit/rotor/support_conditions.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "numerics/dense/eigenvalues.hpp"

namespace levitas::rotor {

Supported Hold(const FiniteElementModel& model, const std::vector<int>& held) {
  std::vector<int> free;
  for (int i = 0; i < static_cast<int>(model.mass.rows()); ++i) {
    if (std::find(held.begin(), held.end(), i) == held.end()) free.push_back(i);
  }
  return {model.mass(free, free), model.gyroscopic(free, free), model.stiffness(free, free)};
}

Supported PinnedAtBothEnds(const FiniteElementModel& model) {
  return Hold(model, {0, static_cast<int>(model.mass.rows()) - 2});
}

Supported ClampedAtTheDriveEnd(const FiniteElementModel& model) { return Hold(model, {0, 1}); }

std::vector<double> Whirl(const Supported& shaft, double speed_rad_per_s) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> still(shaft.stiffness,
                                                                        shaft.mass);
  const Eigen::VectorXd w = still.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  const Eigen::Index n = w.size();
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  companion.topRightCorner(n, n) = w.asDiagonal();
  companion.bottomLeftCorner(n, n) = w.asDiagonal();
  companion.bottomRightCorner(n, n) =
      speed_rad_per_s * still.eigenvectors().transpose() * shaft.gyroscopic * still.eigenvectors();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> turning(companion, Eigen::EigenvaluesOnly);
  return {turning.eigenvalues().begin(), turning.eigenvalues().end()};
}

std::vector<double> Forward(const Supported& shaft, double speed_rad_per_s) {
  auto all = Whirl(shaft, speed_rad_per_s);
  all.erase(all.begin(), std::upper_bound(all.begin(), all.end(), 0.0));
  return all;
}

std::vector<double> Backward(const Supported& shaft, double speed_rad_per_s) {
  return Forward(shaft, -speed_rad_per_s);  // w(-W) = -w(W): the equation above
}

}  // namespace levitas::rotor
