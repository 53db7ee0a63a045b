#include "design/synthesis/magnitude_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::synthesis {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// Integral of ln coth(v/2) from 0 to u >= 0.
double IntegralOfLogCoth(double u) {
  constexpr double kSmall = 0.05;  // u^3/36 is neglected
  if (u < kSmall) return u > 0.0 ? u * (1.0 - std::log(0.5 * u)) : 0.0;
  double sum = 0.0;
  for (int k = 1; k < 200; k += 2) sum += 2.0 * (1.0 - std::exp(-k * u)) / (k * k);
  return sum;
}

/// Bode's relation on the given grid.
VectorXd MinimumPhase(const VectorXd& log_w, const VectorXd& log_magnitude) {
  VectorXd phase = VectorXd::Zero(log_w.size());
  for (Index at = 0; at < log_w.size(); ++at)
    for (Index i = 0; i + 1 < log_w.size(); ++i) {
      const double from = log_w(i) - log_w(at);
      const double to = log_w(i + 1) - log_w(at);
      const double slope = (log_magnitude(i + 1) - log_magnitude(i)) / (to - from);
      const double area = std::copysign(IntegralOfLogCoth(std::abs(to)), to) -
                          std::copysign(IntegralOfLogCoth(std::abs(from)), from);
      phase(at) += slope * area / std::numbers::pi;
    }
  return phase;
}

/// Roots mirrored into the left half plane as quadratics s^2 + c1 s + c0, one real left over.
struct Roots {
  std::vector<Eigen::Vector2d> quadratics;  ///< c0, c1
  std::optional<double> single;             ///< s + single
};

Roots Mirrored(const Eigen::VectorXcd& roots, double smallest) {
  constexpr double kDamping = 0.02;  // a scaling with a sharper peak would follow noise of the grid
  Roots out;
  std::vector<double> reals;
  for (const auto& root : roots) {
    const double size = std::max(std::abs(root), smallest);
    const double damping = std::max(std::abs(root.real()) / size, kDamping);
    if (root.imag() > 0.0) out.quadratics.emplace_back(size * size, 2.0 * damping * size);
    if (root.imag() == 0.0) reals.push_back(size);
  }
  std::sort(reals.begin(), reals.end());
  while (reals.size() >= 2) {
    const double a = reals.back();
    const double b = reals[reals.size() - 2];
    out.quadratics.emplace_back(a * b, a + b);
    reals.resize(reals.size() - 2);
  }
  if (!reals.empty()) out.single = reals.front();
  std::sort(out.quadratics.begin(), out.quadratics.end(),
            [](const auto& a, const auto& b) { return a(0) < b(0); });
  return out;
}

/// gain prod (s - zeros)/(s - poles) as sections.
StateSpace Cascade(const Roots& zeros, const Roots& poles, double gain) {
  StateSpace out = Gain(MatrixXd::Constant(1, 1, gain));
  for (std::size_t i = 0; i < poles.quadratics.size(); ++i) {
    const Eigen::Vector2d& z = zeros.quadratics[i];
    const Eigen::Vector2d& p = poles.quadratics[i];
    const double w = std::sqrt(p(0));  // states scaled by the section's frequency
    StateSpace section = Gain(MatrixXd::Ones(1, 1));
    section.A = Eigen::Matrix2d{{0.0, w}, {-w, -p(1)}};
    section.B = Eigen::Vector2d(0.0, 1.0);
    section.C = Eigen::RowVector2d((z(0) - p(0)) / w, z(1) - p(1));
    out = Series(out, section);
  }
  if (poles.single && zeros.single) {
    StateSpace section = Gain(MatrixXd::Ones(1, 1));
    section.A = MatrixXd::Constant(1, 1, -*poles.single);
    section.B = MatrixXd::Ones(1, 1);
    section.C = MatrixXd::Constant(1, 1, *zeros.single - *poles.single);
    out = Series(out, section);
  }
  return out;
}

/// Numerator a0 + sum a_k/(s + p_k) and denominator 1 + sum c_k/(s + p_k).
struct Fraction {
  VectorXd poles, a, c;
  double a0{};
};

Fraction FitFraction(const VectorXd& w, const Eigen::VectorXcd& target, const VectorXd& weights,
                     Index order) {
  constexpr int kIterations = 15;
  const Index points = w.size();
  Fraction out;
  out.poles.resize(order);
  const double first = std::log(w(0));
  const double last = std::log(w(points - 1));
  for (Index k = 0; k < order; ++k)
    out.poles(k) = std::exp(first + (last - first) * (static_cast<double>(k) + 0.5) /
                                        static_cast<double>(order));
  out.c = VectorXd::Zero(order);
  Eigen::MatrixXcd basis(points, order);
  for (Index i = 0; i < points; ++i)
    for (Index k = 0; k < order; ++k) basis(i, k) = out.poles(k) / Complex(out.poles(k), w(i));
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    const Eigen::VectorXcd denominator = Eigen::VectorXcd::Ones(points) + basis * out.c;
    MatrixXd rows(2 * points, 2 * order + 1);
    VectorXd right(2 * points);
    for (Index i = 0; i < points; ++i) {
      // Relative error: divided by the target as well.
      const Complex weight = weights(i) / (target(i) * denominator(i));
      Eigen::RowVectorXcd row(2 * order + 1);
      row << weight, weight * basis.row(i), -weight * target(i) * basis.row(i);
      rows.row(2 * i) = row.real();
      rows.row(2 * i + 1) = row.imag();
      const Complex side = weight * target(i);
      right(2 * i) = side.real();
      right(2 * i + 1) = side.imag();
    }
    const VectorXd x = rows.colPivHouseholderQr().solve(right);
    out.a0 = x(0);
    out.a = x.segment(1, order);
    out.c = x.tail(order);
  }
  return out;
}

}  // namespace

StateSpace Inverse(const StateSpace& system) {
  const MatrixXd inverse = system.D.inverse();
  return {system.A - system.B * inverse * system.C, system.B * inverse, -inverse * system.C,
          inverse};
}

MagnitudeFit FitMagnitude(const VectorXd& w, const VectorXd& magnitudes, const VectorXd& weights,
                          int order) {
  if (w.size() < 3 || magnitudes.size() != w.size() || weights.size() != w.size() ||
      !(magnitudes.minCoeff() > 0.0) || !(w.minCoeff() > 0.0) || order < 0)
    throw std::invalid_argument("a fit of magnitudes needs three or more positive ones");
  const VectorXd log_magnitude = magnitudes.array().log();
  const double share = weights.sum();
  MagnitudeFit out{Gain(MatrixXd::Constant(1, 1, std::exp(log_magnitude.dot(weights) / share))),
                   INFINITY};
  if (order > 0) {
    const VectorXd phase = MinimumPhase(w.array().log(), log_magnitude);
    Eigen::VectorXcd target(w.size());
    for (Index i = 0; i < w.size(); ++i) target(i) = std::polar(magnitudes(i), phase(i));
    const Fraction fit = FitFraction(w, target, weights, order);
    if (!(std::abs(fit.a0) > 0.0) || !std::isfinite(fit.a0)) return out;
    // Zeros of 1 + sum c_k p_k/(s + p_k) are eigenvalues of diag(-p) - 1 (c p)'.
    const MatrixXd lag = (-fit.poles).asDiagonal();
    const VectorXd one = VectorXd::Ones(order);
    const VectorXd above = fit.a.cwiseProduct(fit.poles) / fit.a0;
    const VectorXd below = fit.c.cwiseProduct(fit.poles);
    const double smallest = 0.1 * w(0);
    const Roots zeros = Mirrored(numerics::EigenvaluesOf(lag - one * above.transpose()), smallest);
    const Roots poles = Mirrored(numerics::EigenvaluesOf(lag - one * below.transpose()), smallest);
    out.system = Cascade(zeros, poles, std::abs(fit.a0));
  }
  out.log_error = 0.0;
  for (Index i = 0; i < w.size(); ++i) {
    const double gain = std::abs(Response(out.system, w(i))(0, 0));
    out.log_error = std::max(out.log_error, weights(i) * std::abs(std::log(gain / magnitudes(i))));
  }
  if (!std::isfinite(out.log_error)) out.log_error = INFINITY;
  return out;
}

MagnitudeFit FitMagnitudeUpTo(const VectorXd& w, const VectorXd& magnitudes,
                              const VectorXd& weights, int largest_order, double allowed) {
  MagnitudeFit best = FitMagnitude(w, magnitudes, weights, 0);
  for (int order = 1; order <= largest_order && best.log_error > allowed; ++order) {
    MagnitudeFit next = FitMagnitude(w, magnitudes, weights, order);
    if (next.log_error < best.log_error) best = std::move(next);
  }
  return best;
}

}  // namespace levitas::synthesis
