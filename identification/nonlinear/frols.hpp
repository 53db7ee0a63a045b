#pragma once
// Forward regression by orthogonal least squares: chooses few terms out of many, the one that
// explains most of what is left first.
//
// Equation  with candidates p_j orthogonalised against the chosen ones, the error reduction ratio
//           ERR_j = (w_j . y)^2 / ((w_j . w_j)(y . y)); the largest is taken, until `most_terms`
//           are chosen or the rest explains less than `least_ratio` (Chen, Billings & Luo 1989;
//           Billings 2013, ch. 3). Modified Gram-Schmidt, coefficients by back substitution.
// Collinear a candidate of which less than 1e-8 is left after orthogonalisation is not offered.
// Thread    any. Cost: rows x candidates per chosen term.

#include <Eigen/Core>
#include <vector>

namespace levitas::identification {

struct FrolsOptions {
  std::size_t most_terms{14};
  double least_ratio{0.0};                 ///< of y . y that a further term must explain
  std::vector<Eigen::Index> compulsory{};  ///< chosen first, whatever they explain
};

struct FrolsResult {
  std::vector<Eigen::Index> chosen;  ///< columns, in the order of choice
  std::vector<double> ratio;         ///< ERR of each
  Eigen::VectorXd theta;             ///< coefficient of each
};

[[nodiscard]] FrolsResult SelectTerms(Eigen::MatrixXd candidates, const Eigen::VectorXd& target,
                                      const FrolsOptions& options);

}  // namespace levitas::identification
