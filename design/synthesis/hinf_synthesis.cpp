#include "design/synthesis/hinf_synthesis.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "common/problem.hpp"
#include "design/synthesis/central_controller.hpp"
#include "design/synthesis/hinf_norm.hpp"

namespace levitas::synthesis {

namespace {

/// gamma of the closed loop by the independent check; nothing when it is refused.
std::optional<double> CheckedNorm(const GeneralisedPlant& plant, const StateSpace& controller,
                                  double gamma) {
  if (!controller.A.allFinite() || !controller.B.allFinite() || !controller.C.allFinite() ||
      !controller.D.allFinite())
    return std::nullopt;
  const StateSpace loop = LowerFeedback(plant.system, controller);
  if (!IsStable(Balanced(loop))) return std::nullopt;
  const HinfNorm norm = NormOf(loop);
  // The bracket of the norm is 1e-4 wide.
  if (!(norm.upper <= gamma * (1.0 + 2e-4))) return std::nullopt;
  return norm.upper;
}

/// Smallest gamma for which the conditions hold, within the tolerance; the Riccati conditions are
/// monotone in gamma.
double SmallestGamma(const NormalPlant& plant, const HinfOptions& options) {
  Solved solved;
  double low = DirectLimit(plant);
  double high = std::max(options.first_gamma, low * (1.0 + options.tolerance));
  for (Verdict verdict = Solve(plant, high, solved); verdict != Verdict::kSolved;
       verdict = Solve(plant, high, solved)) {
    low = high;
    high *= 4.0;
    if (high > options.largest_gamma)
      throw Problem(ExitStatus::kOther,
                    fmt::format("no controller keeps the weighted gain below {:g}: {}",
                                options.largest_gamma, TextOf(verdict)));
  }
  const double smallest = 1e-9 * high;  // a plant whose error can be made to vanish
  while (high - low > options.tolerance * high && high > smallest) {
    const double middle = low > 0.01 * high ? std::sqrt(low * high) : std::max(0.1 * high, low);
    (Solve(plant, middle, solved) == Verdict::kSolved ? high : low) = middle;
  }
  return high;
}

}  // namespace

std::optional<StateSpace> CentralController(const GeneralisedPlant& plant, double gamma,
                                            std::string* reason) {
  CheckSolvable(plant);
  const NormalPlant normal = Normalise(plant);
  Solved solved;
  const Verdict verdict = Solve(normal, gamma, solved);
  if (reason != nullptr) *reason = TextOf(verdict);
  if (verdict != Verdict::kSolved) return std::nullopt;
  return Controller(normal, solved, gamma);
}

HinfController Synthesise(const GeneralisedPlant& plant, const HinfOptions& options) {
  // Multiples of the smallest gamma: rounding that spoils a controller at the limit is gone a few
  // percent above it; a plant that needs twice the limit is beyond the method's digits.
  constexpr std::array kRaised{1.0, 1.01, 1.03, 1.1, 1.3, 2.0};
  CheckSolvable(plant);
  const NormalPlant normal = Normalise(plant);
  const double limit = SmallestGamma(normal, options);
  for (const double raised : kRaised) {
    const double gamma = limit * options.relaxation * raised;
    Solved solved;
    if (Solve(normal, gamma, solved) != Verdict::kSolved) continue;
    StateSpace controller = Controller(normal, solved, gamma);
    if (const auto norm = CheckedNorm(plant, controller, gamma))
      return {std::move(controller), *norm, limit};
  }
  throw Problem(ExitStatus::kOther,
                fmt::format("a gain of {:.4g} seems possible, but no controller computed for it "
                            "passes the check of its closed loop: scale inputs and outputs to like "
                            "size, or give undamped modes some damping",
                            limit));
}

}  // namespace levitas::synthesis
