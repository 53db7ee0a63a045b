// H-infinity norms of drawn systems of four states against dense grids that know nothing of them:
// norm_campaign [SYSTEMS] [SEED], 100 000 by default. Exit status 1 when one is wrong.
//
// Wrong  a frequency at which the gain exceeds the upper bound, looked for on a grid of 200 points
//        over ten decades and of 40 about each pole, the best of which is refined; a lower bound
//        that is not the gain at its frequency; bounds that lie further apart than asked for.

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <vector>

#include "design/synthesis/hinf_norm.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "plants.hpp"

namespace levitas::synthesis {
namespace {

constexpr double kTolerance = 1e-4;
constexpr double kRounding = 1e-7;  ///< of a gain near a pole

using Four = Eigen::Matrix<std::complex<double>, 4, 4>;

double GainAt(const StateSpace& system, double rad_per_s) {
  Four pencil = -system.A.cast<std::complex<double>>();
  pencil.diagonal().array() += std::complex<double>(0.0, rad_per_s);
  const Eigen::Vector4cd state = pencil.partialPivLu().solve(system.B.cast<std::complex<double>>());
  return std::abs((system.C * state)(0) + system.D(0, 0));
}

std::vector<double> Grid(const StateSpace& system) {
  std::vector<double> at{0.0};
  for (int i = 0; i < 200; ++i) at.push_back(std::pow(10.0, -5.0 + i / 20.0));
  const Eigen::VectorXcd poles = system.A.eigenvalues();
  for (const auto& pole : poles) {
    const double width = std::abs(pole.real());
    for (int i = -20; i < 20; ++i) at.push_back(std::abs(std::abs(pole.imag()) + 0.2 * i * width));
  }
  std::sort(at.begin(), at.end());
  return at;
}

/// Largest gain on the grid, refined between the best point's neighbours.
double Largest(const StateSpace& system) {
  const std::vector<double> at = Grid(system);
  std::size_t best = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double gain = GainAt(system, at[i]);
    if (gain > largest) {
      largest = gain;
      best = i;
    }
  }
  double centre = at[best];
  double step = best + 1 < at.size() ? at[best + 1] - at[best] : at[best];
  if (best > 0) step = std::max(step, at[best] - at[best - 1]);
  for (int i = 0; i < 40; ++i, step *= 0.5) {
    for (const double other : {centre - step, centre + step}) {
      const double gain = GainAt(system, std::abs(other));
      if (gain > largest) {
        largest = gain;
        centre = std::abs(other);
      }
    }
  }
  return std::max(largest, std::abs(system.D(0, 0)));
}

bool IsRight(const StateSpace& system, const HinfNorm& norm, double largest) {
  const double at =
      std::isinf(norm.rad_per_s) ? std::abs(system.D(0, 0)) : GainAt(system, norm.rad_per_s);
  return largest <= norm.upper * (1.0 + kRounding) &&
         std::abs(at - norm.lower) <= kRounding * norm.lower &&
         norm.upper <= norm.lower * (1.0 + kTolerance + kRounding);
}

/// Stable, its slowest pole at 1e-4 to 1 from the axis.
StateSpace Drawn(Random& random) {
  StateSpace system{DrawMatrix(random, 4, 4), DrawMatrix(random, 4, 1), DrawMatrix(random, 1, 4),
                    DrawMatrix(random, 1, 1)};
  const double margin = std::pow(10.0, -4.0 * random.Uniform());
  system.A.diagonal().array() -= system.A.eigenvalues().real().maxCoeff() + margin;
  return system;
}

}  // namespace
}  // namespace levitas::synthesis

int main(int argc, char** argv) {
  using namespace levitas::synthesis;
  const long systems = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 100'000;
  const auto seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1ULL;
  levitas::Random random(seed);
  long wrong = 0;
  for (long i = 0; i < systems; ++i) {
    const StateSpace system = Drawn(random);
    const HinfNorm norm = NormOf(system, kTolerance);
    const double largest = Largest(system);
    if (IsRight(system, norm, largest)) continue;
    ++wrong;
    fmt::print("system {}: {} to {}, grid {}\n", i, norm.lower, norm.upper, largest);
  }
  fmt::print("{} of {} norms right\n", systems - wrong, systems);
  return wrong == 0 ? 0 : 1;
}
