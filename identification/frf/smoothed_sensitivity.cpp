#include "identification/frf/smoothed_sensitivity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;

constexpr std::array<std::size_t, 6> kHalfWidths{2, 3, 5, 8, 12, 18};
constexpr double kNoiseMoves = 4.0;

struct Estimate {
  Complex value;
  double variance{};
  std::size_t lines{};
};

/// The parabola through the lines `line - half` to `line + half`, at `line`.
Estimate FitAround(const FrequencyResponse& r, Eigen::Index axis, std::size_t line,
                   std::size_t half) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3cd right = Eigen::Vector3cd::Zero();
  const double width_hz = r.frequency_hz[line + half] - r.frequency_hz[line - half];
  for (std::size_t k = line - half; k <= line + half; ++k) {
    const double x = (r.frequency_hz[k] - r.frequency_hz[line]) / width_hz;
    const Eigen::Vector3d row(1.0, x, x * x);
    const double weight = 1.0 / r.own_variance[k][axis];
    normal += weight * row * row.transpose();
    right += weight * r.sensitivity[k](axis, axis) * row;
  }
  const Eigen::RowVector3d at_line = normal.inverse().row(0);
  return {(at_line * right).value(), at_line[0], 2 * half + 1};
}

bool AgreesWith(const Estimate& wide, const std::vector<Estimate>& narrower) {
  return std::ranges::all_of(narrower, [&](const Estimate& one) {
    return std::norm(wide.value - one.value) <= kNoiseMoves * (one.variance - wide.variance);
  });
}

bool HasVariance(const FrequencyResponse& r, Eigen::Index axis, std::size_t low, std::size_t high) {
  return std::all_of(r.own_variance.begin() + static_cast<std::ptrdiff_t>(low),
                     r.own_variance.begin() + static_cast<std::ptrdiff_t>(high) + 1,
                     [axis](const Eigen::VectorXd& one) { return one[axis] > 0.0; });
}

Estimate Widest(const FrequencyResponse& r, Eigen::Index axis, std::size_t line) {
  std::vector<Estimate> taken{{r.sensitivity[line](axis, axis), r.own_variance[line][axis], 1}};
  for (const std::size_t half : kHalfWidths) {
    if (half > line || line + half >= r.frequency_hz.size()) break;
    if (!HasVariance(r, axis, line - half, line + half)) break;
    const Estimate wider = FitAround(r, axis, line, half);
    if (!AgreesWith(wider, taken)) break;
    taken.push_back(wider);
  }
  return taken.back();
}

}  // namespace

std::vector<SmoothedLine> SmoothedSensitivity(const FrequencyResponse& response,
                                              Eigen::Index axis) {
  std::vector<SmoothedLine> lines;
  lines.reserve(response.frequency_hz.size());
  for (std::size_t k = 0; k < response.frequency_hz.size(); ++k) {
    const Estimate one = Widest(response, axis, k);
    lines.push_back({std::sqrt(std::max(0.0, std::norm(one.value) - one.variance)),
                     std::sqrt(one.variance), one.lines});
  }
  return lines;
}

}  // namespace levitas::identification
