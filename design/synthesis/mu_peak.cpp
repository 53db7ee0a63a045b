#include "design/synthesis/mu_peak.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/problem.hpp"
#include "design/synthesis/hamiltonian.hpp"

namespace levitas::synthesis {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Interval {
  double first{}, last{};
};

/// M* D M + j (G M - M* G) - level^2 D as a quadratic form of [M; I].
Eigen::MatrixXcd FormOf(const MuScaling& scaling, double level) {
  const Eigen::Index p = scaling.rows.rows();
  const Eigen::Index m = scaling.columns.rows();
  const std::complex<double> j(0.0, 1.0);
  Eigen::MatrixXcd pi(p + m, p + m);
  pi.topLeftCorner(p, p) = scaling.rows;
  pi.bottomLeftCorner(m, p) = j * scaling.G;
  pi.topRightCorner(p, m) = -j * scaling.G.adjoint();
  pi.bottomRightCorner(m, m) = -level * level * scaling.columns;
  return pi;
}

class Search {
 public:
  Search(const StateSpace& system, const UncertaintyBlocks& blocks, const MuPeakOptions& options)
      : system_(system), blocks_(blocks), options_(options) {}

  /// Upper bound at one frequency; raises the peak.
  MuUpper Evaluate(double rad_per_s, bool real_scaling) {
    const Eigen::MatrixXcd M = Response(system_, rad_per_s);
    MuUpper upper = MuUpperBound(M, blocks_, real_scaling);
    // Real scalings are quicker to prove with; only above the level are better ones worth it.
    if (real_scaling && upper.value > level()) upper = MuUpperBound(M, blocks_, false);
    peak_.grid.push_back({rad_per_s, upper.value});
    if (upper.value > peak_.at_peak || peak_.grid.size() == 1) {
      peak_.at_peak = upper.value;
      peak_.rad_per_s = rad_per_s;
    }
    return upper;
  }

  [[nodiscard]] double level() const {
    return std::max(peak_.at_peak, 1e-12) * (1.0 + options_.tolerance);
  }

  /// The interval round `rad_per_s` for which the scaling proves the level.
  [[nodiscard]] Interval ProvenBy(const MuScaling& scaling, double rad_per_s) const {
    const Eigen::MatrixXcd pi = FormOf(scaling, level());
    const bool real = scaling.G.isZero(0.0) && scaling.rows.imag().isZero(0.0) &&
                      scaling.columns.imag().isZero(0.0);
    const auto crossings = real ? CrossingFrequencies(system_, Eigen::MatrixXd(pi.real()))
                                : CrossingFrequencies(system_, pi);
    if (!crossings) return {rad_per_s, rad_per_s};
    Interval out{0.0, kInfinite};
    for (const double crossing : *crossings) {
      if (crossing <= rad_per_s) out.first = std::max(out.first, crossing);
      if (crossing > rad_per_s) out.last = std::min(out.last, crossing);
    }
    return out;
  }

  /// Proves the level from zero to infinity.
  void Cover() {
    double proven = 0.0;  // everything below, itself excluded
    double reach = 1.0;   // how far ahead the last interval reached, as a ratio
    while (std::isfinite(proven)) {
      if (++peak_.intervals > options_.most_intervals)
        throw Problem(ExitStatus::kOther,
                      fmt::format("the proof of mu stops at {:.4g} Hz after {} intervals: ask for "
                                  "a wider tolerance",
                                  proven / (2.0 * std::numbers::pi), options_.most_intervals));
      double next = proven;
      // First a scaling from ahead, whose interval may reach back to what is proven; else here.
      for (const double ahead : {proven * std::sqrt(reach), proven}) {
        if (ahead == proven && next > proven) break;
        const Interval interval = ProvenBy(Evaluate(ahead, true).scaling, ahead);
        if (interval.first <= proven && interval.last > proven) next = interval.last;
      }
      if (!(next >
            proven))  // rounding at the edge of an interval: a step that no resonance fits in
        next = std::max(proven * (1.0 + 1e-9), 1e-9 * options_.first_rad_per_s);
      reach = proven > 0.0 ? std::clamp(next / proven, 1.0, 100.0) : 1.0;
      proven = next;
    }
  }

  [[nodiscard]] MuPeak Finish() {
    peak_.upper = level();
    peak_.lower = MuLowerBound(Response(system_, peak_.rad_per_s), blocks_);
    std::sort(peak_.grid.begin(), peak_.grid.end(),
              [](const MuPoint& a, const MuPoint& b) { return a.rad_per_s < b.rad_per_s; });
    return std::move(peak_);
  }

 private:
  const StateSpace& system_;
  const UncertaintyBlocks& blocks_;
  const MuPeakOptions& options_;
  MuPeak peak_;
};

}  // namespace

MuPeak PeakOfMu(const StateSpace& given, const UncertaintyBlocks& blocks,
                const MuPeakOptions& options) {
  CheckShapes(given);
  CheckBlocks(blocks, given.outputs(), given.inputs());
  const StateSpace system = Balanced(given);
  const Eigen::VectorXcd poles = Poles(system);
  if (poles.size() > 0 && !(poles.real().maxCoeff() < 0.0))
    throw Problem(ExitStatus::kOther, "an unstable model has no structured singular value");
  Search search(system, blocks, options);
  search.Evaluate(0.0, false);
  search.Evaluate(kInfinite, false);
  const double ratio = options.last_rad_per_s / options.first_rad_per_s;
  for (int i = 0; i < options.points; ++i)
    search.Evaluate(
        options.first_rad_per_s * std::pow(ratio, i / std::max(1.0, options.points - 1.0)), false);
  for (const auto& pole : poles)
    if (pole.imag() > 0.0 && -pole.real() < 0.3 * pole.imag()) search.Evaluate(pole.imag(), false);
  search.Cover();
  return search.Finish();
}

}  // namespace levitas::synthesis
