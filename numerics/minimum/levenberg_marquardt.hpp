#pragma once
// Levenberg-Marquardt: a minimum of a sum of squares, found from normal equations and steps.
//
// Method    (J'J + damping diag(J'J)) step = -J'r (Marquardt 1963, J. SIAM 11, 431). A step that
//           lowers the cost is taken and the damping reduced; any other is refused, also one whose
//           cost is infinite or not a number, and repeated with more damping.
// Problem   a type with
//             std::optional<NormalEquations> Linearise(const Iterate<Point>&);
//             Iterate<Point> Step(const Point& from, const Eigen::VectorXd& step);
//           Linearise gives nothing where the cost has no derivative: the search ends there. Step
//           gives the point reached and its cost; it may shorten a step to stay within bounds,
//           whose gradient Linearise then sets to zero. Priors are residuals like any other.
// Units     those of the problem; the damping is relative to the diagonal, so that the scale of an
//           unknown does not matter.
// Thread    that of the caller; allocates. Failure: none; `end` says why the search ended. A start
//           of infinite cost is returned as it is.
// Not done  covariances (the caller has the normal equations), robust losses, bounds.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace levitas::numerics {

/// The cost about a point: cost(p + d) = cost(p) + 2 gradient'd + d' matrix d.
struct NormalEquations {
  Eigen::MatrixXd matrix;    ///< J'J; only its lower triangle is read
  Eigen::VectorXd gradient;  ///< J'r, half the derivative of the sum of squares
};

template <class Point>
struct Iterate {
  Point point;
  double cost{};  ///< sum of squares; infinite where the model cannot be run
};

struct LevenbergMarquardtOptions {
  double first_damping{1e-3};
  double lowered_by{0.1};                             ///< factor after a step that was taken
  double raised_by{10.0};                             ///< factor after one that was refused
  double least_damping{0.0};                          ///< after a step that was taken
  double least_raised{0.0};                           ///< after a step that was refused
  double most_damping{1e12};                          ///< from there on no step helps
  int most_refused{std::numeric_limits<int>::max()};  ///< in a row; then no step helps
  int most_steps{std::numeric_limits<int>::max()};    ///< that are taken
  int most_trials{std::numeric_limits<int>::max()};   ///< taken or refused
  // The minimum is reached with a step that gains less than the larger of the first two, or where
  // an undamped step would gain less than the third.
  double least_gain{0.0};
  double least_relative_gain{0.0};  ///< of the cost before the step
  double least_predicted_gain{0.0};
};

enum class SearchEnd : std::uint8_t {
  kConverged,    ///< by one of the three gains
  kNoStepHelps,  ///< at any damping that is allowed: also a minimum
  kMostSteps,    ///< the limit of steps or trials came first
  kNotLinear,    ///< Linearise gave nothing
  kInfiniteStart
};

template <class Point>
struct Minimum {
  Iterate<Point> at;
  int steps{};  ///< taken
  SearchEnd end{SearchEnd::kInfiniteStart};
};

/// Of (matrix + damping diag(matrix)) step = -gradient.
[[nodiscard]] Eigen::VectorXd DampedStep(const NormalEquations& equations, double damping);
/// What the cost loses by the undamped step where the residuals are linear.
[[nodiscard]] double PredictedGain(const NormalEquations& equations);

/// The damping between the steps, and how many in a row were refused.
class Damping {
 public:
  explicit Damping(const LevenbergMarquardtOptions& options)
      : options_(options), value_(options.first_damping) {}

  void Accept() noexcept;
  void Refuse() noexcept;
  [[nodiscard]] double value() const noexcept { return value_; }
  /// False: no step helps from here.
  [[nodiscard]] bool MayStep() const noexcept;

 private:
  const LevenbergMarquardtOptions& options_;
  double value_;
  int refused_{0};
};

template <class Problem, class Point>
[[nodiscard]] Minimum<Point> LevenbergMarquardt(Problem& problem, Iterate<Point> start,
                                                const LevenbergMarquardtOptions& options) {
  Minimum<Point> found{std::move(start)};
  if (!std::isfinite(found.at.cost)) return found;
  Damping damping(options);
  std::optional<NormalEquations> equations;
  for (int trials = 0;; ++trials) {
    found.end = SearchEnd::kMostSteps;
    if (found.steps >= options.most_steps || trials >= options.most_trials) return found;
    if (!equations) {
      equations = problem.Linearise(std::as_const(found.at));
      found.end = SearchEnd::kNotLinear;
      if (!equations) return found;
      found.end = SearchEnd::kConverged;
      if (options.least_predicted_gain > 0.0 &&
          PredictedGain(*equations) < options.least_predicted_gain) {
        return found;
      }
    }
    found.end = SearchEnd::kNoStepHelps;
    if (!damping.MayStep()) return found;
    Iterate<Point> next =
        problem.Step(std::as_const(found.at.point), DampedStep(*equations, damping.value()));
    if (!(next.cost < found.at.cost)) {
      damping.Refuse();
      continue;
    }
    damping.Accept();
    ++found.steps;
    const double before = std::exchange(found.at, std::move(next)).cost;
    found.end = SearchEnd::kConverged;
    const double least = std::max(options.least_gain, options.least_relative_gain * before);
    if (before - found.at.cost < least) return found;
    equations.reset();
  }
}

}  // namespace levitas::numerics
