#pragma once
// A minimum of a cost without derivatives: covariance matrix adaptation (CMA-ES).
//
// Source    N. Hansen, The CMA Evolution Strategy: A Tutorial, arXiv:1604.00772 (2016): default
//           constants of its table 1, rank-one and rank-mu update, cumulative step length.
// Draws     common/random.hpp: the same seed gives the same points on every machine.
// Failure   none. A cost that is no number counts as worse than any other.
// Thread    that of the caller, and as many others as are asked for; allocates.

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace levitas::numerics {

struct EvolutionOptions {
  double first_step{0.3};
  std::size_t evaluations{400};
  std::size_t population{};  ///< 0: 4 + 3 ln(unknowns)
  std::uint64_t seed{1};
  /// That evaluate the points of a generation side by side, 0: as many as the machine has
  /// processors. The points and the answer are the same for every number.
  std::size_t threads{1};
};

struct EvolutionResult {
  Eigen::VectorXd best;
  double cost{};
  std::size_t evaluations{};
};

/// `cost(x)`, by any of the threads; for every evaluation `seen(evaluations, best cost)`, by the
/// caller's: false ends the search with the best so far. It is called when a generation is done.
[[nodiscard]] EvolutionResult Evolve(const Eigen::VectorXd& start,
                                     const std::function<double(const Eigen::VectorXd&)>& cost,
                                     const EvolutionOptions& options,
                                     const std::function<bool(std::size_t, double)>& seen);

}  // namespace levitas::numerics
