#include "identification/modal/mode_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

/// Chance alone gives 8 entries F = 6 once in 1e12.
constexpr double kClear = 6.0;
constexpr double kStep = 0.001;
/// Half width of what is looked at around a frequency, and the least number of lines on either
/// side.
constexpr double kWidth = 0.04;
constexpr double kLeastLines = 8.0;
constexpr std::array kDampings{0.0007, 0.0015, 0.003, 0.006, 0.012, 0.025};
/// What suits this or more is no mode but a bend of the baseline.
constexpr double kBend = 0.02;
/// Repeats and is not linear.
constexpr double kFloor = 0.005;

struct Window {
  double centre_hz, half_hz;
  std::size_t first, last;
  [[nodiscard]] Index size() const { return static_cast<Index>(last - first); }
};

Complex Resonance(double f_hz, double damping, double line_hz) {
  return f_hz * f_hz / Complex(f_hz * f_hz - line_hz * line_hz, 2.0 * damping * f_hz * line_hz);
}

class Scan {
 public:
  explicit Scan(const FrequencyResponse& response) : r_(response) {
    const auto lines = static_cast<Index>(r_.frequency_hz.size());
    for (Index i = 0; i < r_.axes(); ++i) {
      for (Index j = i % 2; j < r_.axes(); j += 2) {
        Entry entry{Eigen::VectorXd(lines), Eigen::VectorXcd(lines)};
        for (Index n = 0; n < lines; ++n) {
          const auto k = static_cast<std::size_t>(n);
          entry.weight[n] = 1.0 / std::sqrt(r_.variance[k](i, j) +
                                            kFloor * kFloor * std::norm(r_.plant[k](i, j)));
          entry.data[n] = entry.weight[n] * r_.plant[k](i, j);
        }
        entries_.push_back(std::move(entry));
      }
    }
  }

  /// Best damping at a frequency, the modes `known` in the baseline.
  [[nodiscard]] ScannedMode At(double f_hz, const std::vector<ScannedMode>& known) const {
    const Window window = Around(f_hz);
    std::array<double, kDampings.size()> taken{};
    double left = 0.0;
    const auto entries = static_cast<double>(entries_.size());
    Index unknowns = 0;
    if (window.size() < static_cast<Index>(kLeastLines)) return {f_hz, 0.0, 0.0};
    for (const Entry& entry : entries_) {
      const auto begin = static_cast<Index>(window.first);
      const Eigen::VectorXd weight = entry.weight.segment(begin, window.size());
      Eigen::VectorXcd data = entry.data.segment(begin, window.size());
      const Eigen::MatrixXcd baseline = Baseline(window, weight, known);
      unknowns = baseline.cols();
      data -= baseline * (baseline.adjoint() * data);
      left += data.squaredNorm();
      for (std::size_t d = 0; d < kDampings.size(); ++d) {
        Eigen::VectorXcd mode = Column(window, weight, f_hz, kDampings[d]);
        const double before = mode.squaredNorm();
        mode -= baseline * (baseline.adjoint() * mode);
        const double own = mode.squaredNorm();
        if (own > 1e-6 * before) taken[d] += std::norm(mode.dot(data)) / own;
      }
    }
    const auto best = std::ranges::max_element(taken) - taken.begin();
    const double most = taken[static_cast<std::size_t>(best)];
    const double free = entries * static_cast<double>(window.size() - unknowns - 1);
    const double rest = free > 0.0 ? std::max(1.0, (left - most) / free) : 1.0;
    return {f_hz, kDampings[static_cast<std::size_t>(best)], most / entries / rest};
  }

 private:
  /// One response within a plane, over all lines, in units of its noise.
  struct Entry {
    Eigen::VectorXd weight;
    Eigen::VectorXcd data;
  };

  [[nodiscard]] Window Around(double f_hz) const {
    const auto& lines = r_.frequency_hz;
    const double spacing = (lines.back() - lines.front()) / static_cast<double>(lines.size() - 1);
    const double half = std::max(kWidth * f_hz, kLeastLines * spacing);
    const auto first = std::ranges::lower_bound(lines, f_hz - half) - lines.begin();
    const auto last = std::ranges::upper_bound(lines, f_hz + half) - lines.begin();
    return {f_hz, half, static_cast<std::size_t>(first), static_cast<std::size_t>(last)};
  }

  [[nodiscard]] Eigen::VectorXcd Column(const Window& window, const Eigen::VectorXd& weight,
                                        double f_hz, double damping) const {
    Eigen::VectorXcd column(window.size());
    for (Index n = 0; n < window.size(); ++n) {
      const double line = r_.frequency_hz[window.first + static_cast<std::size_t>(n)];
      column[n] = weight[n] * Resonance(f_hz, damping, line);
    }
    return column;
  }

  /// Orthonormal columns: the polynomial and the known modes within twice the window.
  [[nodiscard]] Eigen::MatrixXcd Baseline(const Window& window, const Eigen::VectorXd& weight,
                                          const std::vector<ScannedMode>& known) const {
    std::vector<Eigen::VectorXcd> columns(3, Eigen::VectorXcd(window.size()));
    for (Index n = 0; n < window.size(); ++n) {
      const double line = r_.frequency_hz[window.first + static_cast<std::size_t>(n)];
      const double x = (line - window.centre_hz) / window.half_hz;
      columns[0][n] = weight[n];
      columns[1][n] = weight[n] * x;
      columns[2][n] = weight[n] * x * x;
    }
    for (const ScannedMode& mode : known) {
      const double away = std::abs(mode.frequency_hz - window.centre_hz) / window.half_hz;
      if (away > 6.0) continue;
      // Its square, thrice: frequency and damping are coarse, and differ between the planes.
      Eigen::VectorXcd column = Column(window, weight, mode.frequency_hz, mode.damping_ratio);
      const Eigen::VectorXcd shape = column.cwiseQuotient(weight);
      for (int power = 0; power < (away > 2.0 ? 1 : 3); ++power) {
        columns.push_back(column);
        column = column.cwiseProduct(shape);
      }
    }
    Eigen::MatrixXcd baseline(window.size(), static_cast<Index>(columns.size()));
    Index count = 0;
    for (Eigen::VectorXcd& column : columns) {
      const double before = column.norm();
      for (int twice = 0; twice < 2; ++twice) {
        column -= baseline.leftCols(count) * (baseline.leftCols(count).adjoint() * column);
      }
      if (column.norm() < 1e-6 * before) continue;
      baseline.col(count++) = column.normalized();
    }
    return baseline.leftCols(count);
  }

  const FrequencyResponse& r_;
  std::vector<Entry> entries_;
};

bool Near(const ScannedMode& one, const ScannedMode& other) {
  return std::abs(one.frequency_hz / other.frequency_hz - 1.0) < kSameMode;
}

}  // namespace

std::vector<ScannedMode> ScanModes(const FrequencyResponse& response, double lowest_hz,
                                   double highest_hz) {
  const Scan scan(response);
  std::vector<ScannedMode> all;
  for (double f = lowest_hz; f < highest_hz; f *= 1.0 + kStep) all.push_back(scan.At(f, {}));
  std::ranges::sort(all, std::ranges::greater{}, &ScannedMode::evidence);
  std::vector<ScannedMode> modes;
  std::vector<ScannedMode> looked_at;
  for (const ScannedMode& candidate : all) {
    if (candidate.evidence < kClear) break;
    if (candidate.damping_ratio > kBend) continue;
    const auto near = [&candidate](const ScannedMode& other) { return Near(candidate, other); };
    if (std::ranges::any_of(looked_at, near)) continue;
    looked_at.push_back(candidate);
    const ScannedMode again = scan.At(candidate.frequency_hz, modes);
    if (again.evidence > kClear && again.damping_ratio < kBend) modes.push_back(again);
  }
  std::ranges::sort(modes, {}, &ScannedMode::frequency_hz);
  return modes;
}

}  // namespace levitas::identification
