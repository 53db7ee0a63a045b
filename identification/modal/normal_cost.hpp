#pragma once
// All lines and the prior of the modal fit as one small cost function for Ceres: a solver that
// keeps the whole Jacobian (40 000 rows) spends most of its time on moving it.
//
// Equation  cost C = 1/2 (sum_k rho(|r_k|^2) + |(x - x_0)/prior|^2), its gradient g and its
//           Gauss-Newton matrix H are summed line by line (rho' weights a line); handed over are
//           residuals and Jacobian that have just these:
//             J = [L^T; 0],  r = [L^-1 g; sqrt(2 C - |L^-1 g|^2)],  H = L L^T,
//           so that |r|^2 = 2 C, J^T r = g, J^T J = H. The root is real because rho is concave.
// rho       the square itself, or soft L1, 2 b (sqrt(1 + s/b) - 1), with b the number of residuals
//           of a line: one sigma each is the bend (Triggs et al. 2000).
// Unknowns  the free ones only; the others stay as in `base`.
// Thread    Evaluate uses `threads` of its own, one evaluation at a time. Lifetime: frame, data and
//           start stay the caller's.

#include <ceres/cost_function.h>

#include <vector>

#include "identification/modal/line_residuals.hpp"

namespace levitas::identification {

class NormalCost : public ceres::CostFunction {
 public:
  NormalCost(const ModalStart& start, Eigen::VectorXd base, std::vector<Eigen::Index> free,
             std::vector<LineResiduals> lines, bool robust, int threads);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

  /// `base` with the free unknowns replaced.
  [[nodiscard]] Eigen::VectorXd Whole(const double* free) const;

 private:
  struct Sum {
    double twice_cost{};
    Eigen::VectorXd gradient;
    Eigen::MatrixXd matrix;  ///< lower triangle
  };
  void Add(const Physical& rig, std::size_t from, std::size_t to, bool derive, Sum& sum) const;
  [[nodiscard]] Sum Total(const Eigen::VectorXd& vector, bool derive) const;

  const ModalStart& start_;
  Eigen::VectorXd base_;
  std::vector<Eigen::Index> free_;
  std::vector<LineResiduals> lines_;
  bool robust_;
  int threads_;
};

}  // namespace levitas::identification
