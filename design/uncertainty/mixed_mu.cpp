#include "design/uncertainty/mixed_mu.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "design/uncertainty/balance.hpp"

namespace levitas::uncertainty {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// l and g one after the other, g in units of the squared bound at the start.
struct Bound {
  const MatrixXcd& m;
  Index perturbations;
  double size;

  struct Value {
    double largest{};  ///< eigenvalue of H
    double smooth{};
    VectorXd gradient;
  };

  [[nodiscard]] Value At(const VectorXd& x, double sharpness) const {
    const Index n = m.rows();
    VectorXd l = VectorXd::Zero(n);
    VectorXd g = VectorXd::Zero(n);
    l.head(perturbations) = x.head(perturbations);
    g.head(perturbations) = size * x.tail(perturbations);
    const MatrixXcd scaled =
        l.array().exp().matrix().asDiagonal() * m * (-l).array().exp().matrix().asDiagonal();
    const MatrixXcd turned = Complex(0.0, 1.0) * (g.asDiagonal() * scaled).eval();
    const MatrixXcd form = scaled.adjoint() * scaled + turned + turned.adjoint();
    const Eigen::SelfAdjointEigenSolver<MatrixXcd> solver(form);
    const VectorXd& values = solver.eigenvalues();
    Value out;
    out.largest = values[n - 1];
    const double t = sharpness / size;
    const VectorXd weight = ((values.array() - out.largest) * t).exp();
    out.smooth = out.largest + std::log(weight.sum()) / t;
    out.gradient = VectorXd::Zero(2 * perturbations);
    for (Index k = 0; k < n; ++k) {
      const double share = weight[k] / weight.sum();
      if (share < 1e-6) continue;
      AddGradient(scaled, g, solver.eigenvectors().col(k), share, out.gradient);
    }
    return out;
  }

  /// Derivatives of v* H v, v an eigenvector.
  void AddGradient(const MatrixXcd& scaled, const VectorXd& g, const VectorXcd& v, double share,
                   VectorXd& gradient) const {
    const VectorXcd y = scaled * v;
    const VectorXcd back = scaled.adjoint() * y;
    const VectorXcd turned_back = scaled.adjoint() * (g.asDiagonal() * v).eval();
    for (Index i = 0; i < perturbations; ++i) {
      const Complex by_d = std::conj(y[i]) * y[i] - std::conj(back[i]) * v[i];
      const Complex by_g = g[i] * std::conj(v[i]) * y[i] - std::conj(turned_back[i]) * v[i];
      gradient[i] += share * 2.0 * (by_d.real() - by_g.imag());
      gradient[perturbations + i] += share * size * -2.0 * (std::conj(v[i]) * y[i]).imag();
    }
  }
};

/// BFGS with halving; the least eigenvalue seen. Ends at `enough`.
double Descend(const Bound& bound, double sharpness, double enough, VectorXd& x) {
  constexpr int kSteps = 60;
  constexpr double kLess = 1e-5;  // of a step's gain: not worth another
  auto now = bound.At(x, sharpness);
  double least = now.largest;
  VectorXd best = x;
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(x.size(), x.size()) / bound.size;
  for (int step = 0; step < kSteps && least > enough; ++step) {
    VectorXd direction = -inverse * now.gradient;
    if (!(direction.dot(now.gradient) < 0.0)) {
      inverse.setIdentity();
      inverse /= bound.size;
      direction = -inverse * now.gradient;
    }
    double length = std::min(1.0, 1.0 / std::max(direction.cwiseAbs().maxCoeff(), 1e-300));
    auto next = bound.At(x + length * direction, sharpness);
    while (!(next.smooth < now.smooth) && length > 1e-6) {
      length *= 0.4;
      next = bound.At(x + length * direction, sharpness);
    }
    if (!(next.smooth < now.smooth)) break;
    const VectorXd s = length * direction;
    const VectorXd d = next.gradient - now.gradient;
    const double curvature = s.dot(d);
    if (curvature > 1e-12 * s.norm() * d.norm()) {
      const VectorXd hd = inverse * d;
      inverse += (1.0 + d.dot(hd) / curvature) / curvature * s * s.transpose() -
                 (hd * s.transpose() + s * hd.transpose()) / curvature;
    }
    const double gain = now.smooth - next.smooth;
    x += s;
    now = std::move(next);
    if (now.largest < least) {
      least = now.largest;
      best = x;
    }
    if (gain < kLess * std::abs(now.smooth)) break;
  }
  x = best;
  return least;
}

}  // namespace

double MixedMu(const MatrixXcd& m, Index perturbations, double enough) {
  const Bound of_balanced{m, perturbations, 1.0};
  VectorXd x = VectorXd::Zero(2 * perturbations);
  // What balances rows against columns may raise the largest gain; without it the bound holds too.
  double least = of_balanced.At(x, 1.0).largest;
  VectorXd other = x;
  other.head(perturbations) = BalancingScale(m, perturbations).head(perturbations).array().log();
  const double after = of_balanced.At(other, 1.0).largest;
  if (after < least) {
    least = after;
    x = other;
  }
  if (!(least > 0.0)) return 0.0;
  const Bound bound{m, perturbations, least};
  for (const double sharpness : {20.0, 100.0, 500.0}) {
    least = std::min(least, Descend(bound, sharpness, enough * enough, x));
    if (least <= enough * enough) break;
  }
  return std::sqrt(std::max(least, 0.0));
}

}  // namespace levitas::uncertainty
