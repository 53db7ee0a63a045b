#pragma once
// The unknowns of the joint fit as one vector, each in units of its value at the start, and what
// holds them.
//
// Order     ks, ki of pinion and gear, k_m, c_m, both run-outs, every transmission error (complex:
//           two), then corrections of known numbers. Thread any, pure.

#include "identification/geared/full_spectrum.hpp"

namespace levitas::identification {

class JointUnknowns {
 public:
  JointUnknowns(const GearedKnown& known, const GearedParameters& start);

  /// The linear steps' answer; then the same with the tilt inertias off by 1.5 `uncertainty` either
  /// way: a tilt's resonance may lie on the other side of a line.
  [[nodiscard]] std::vector<Eigen::VectorXd> starts() const;
  [[nodiscard]] GearedParameters At(const Eigen::VectorXd& x) const;
  /// Prior knowledge besides the lines, as residuals in standard deviations, and their derivative.
  [[nodiscard]] Eigen::VectorXd Held(const Eigen::VectorXd& x) const { return hold_ * x; }
  [[nodiscard]] const Eigen::MatrixXd& HeldBy() const noexcept { return hold_; }
  /// Values and standard deviations into `p`.
  void Take(const Eigen::VectorXd& x, const Eigen::VectorXd& sigma, GearedParameters& p) const;

 private:
  [[nodiscard]] Eigen::Index corrections() const;

  GearedKnown known_;
  GearedParameters base_;
  Eigen::VectorXd scale_;  ///< of all but the corrections
  Eigen::VectorXd start_;
  Eigen::MatrixXd hold_;
};

}  // namespace levitas::identification
