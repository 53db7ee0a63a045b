#include "identification/law/rational_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::identification {
namespace {

using Complex = std::complex<double>;
using Index = Eigen::Index;

/// Poles that move by less than this share have arrived.
constexpr double kArrived = 1e-10;

Index OrderOf(const std::vector<Pole>& poles) {
  std::size_t order = 0;
  for (const Pole& pole : poles) order += pole.order();
  return static_cast<Index>(order);
}

/// Real coefficients a, b of a pair are those of its residue a + j b.
void Basis(const std::vector<Pole>& poles, Complex zeta, Eigen::Ref<Eigen::VectorXcd> out) {
  Index at = 0;
  for (const Pole& pole : poles) {
    const Complex one = 1.0 / (zeta - pole.place);
    if (pole.order() == 1) {
      out[at++] = one;
      continue;
    }
    const Complex other = 1.0 / (zeta - std::conj(pole.place));
    out[at++] = one + other;
    out[at++] = Complex(0.0, 1.0) * (one - other);
  }
}

/// Least squares with columns of like size; rows are real and imaginary parts in turn.
Eigen::VectorXd Solve(Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  Eigen::VectorXd size = matrix.colwise().norm();
  for (Index i = 0; i < size.size(); ++i)
    if (!(size[i] > 0.0)) size[i] = 1.0;
  matrix *= size.cwiseInverse().asDiagonal();
  Eigen::VectorXd solution = matrix.colPivHouseholderQr().solve(right);
  return solution.cwiseQuotient(size);
}

/// Columns: d, r_i, t_0, t_i, and with `sigma` c_i.
Eigen::MatrixXd Regressors(std::span<const SpectrumLine> lines, const std::vector<Pole>& poles,
                           bool sigma, Eigen::VectorXd& right) {
  const Index n = OrderOf(poles);
  const auto rows = static_cast<Index>(2 * lines.size());
  Eigen::MatrixXd matrix(rows, 2 * (n + 1) + (sigma ? n : 0));
  right.resize(rows);
  Eigen::VectorXcd basis(n);
  Eigen::VectorXcd row(matrix.cols());
  for (Index k = 0; k < rows / 2; ++k) {
    const SpectrumLine& line = lines[static_cast<std::size_t>(k)];
    Basis(poles, line.zeta, basis);
    row[0] = line.input;
    row.segment(1, n) = line.input * basis;
    row[n + 1] = 1.0;
    row.segment(n + 2, n) = basis;
    if (sigma) row.tail(n) = -line.output * basis;
    matrix.row(2 * k) = row.real().transpose();
    matrix.row(2 * k + 1) = row.imag().transpose();
    right[2 * k] = line.output.real();
    right[2 * k + 1] = line.output.imag();
  }
  return matrix;
}

/// Zeros of 1 + sum c_i/(zeta - p_i).
std::vector<Complex> ZerosOf(const std::vector<Pole>& poles, const Eigen::VectorXd& c) {
  const Index n = c.size();
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  Index at = 0;
  for (const Pole& pole : poles) {
    a(at, at) = pole.place.real();
    b[at] = 1.0;
    if (pole.order() == 2) {
      a(at + 1, at + 1) = pole.place.real();
      a(at, at + 1) = pole.place.imag();
      a(at + 1, at) = -pole.place.imag();
      b[at] = 2.0;
    }
    at += static_cast<Index>(pole.order());
  }
  const Eigen::MatrixXd closed = a - b * c.transpose();
  const Eigen::VectorXcd zeros = numerics::EigenvaluesOf(closed);
  return {zeros.begin(), zeros.end()};
}

Complex Mirrored(Complex place, LawDomain domain) {
  if (domain == LawDomain::kDiscrete) {
    return std::abs(place) > 1.0 ? 1.0 / std::conj(place) : place;
  }
  return {-std::abs(place.real()), place.imag()};
}

std::vector<Pole> PolesAt(const std::vector<Complex>& places, LawDomain domain, bool mirror) {
  std::vector<Pole> poles;
  for (Complex place : places) {
    if (mirror) place = Mirrored(place, domain);
    // Rounding leaves a real eigenvalue of a real matrix exactly real.
    if (place.imag() >= 0.0) poles.push_back({place, {}});
  }
  return poles;
}

double MovedBy(const std::vector<Pole>& from, const std::vector<Pole>& to) {
  if (from.size() != to.size()) return std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (const Pole& pole : to) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Pole& other : from) nearest = std::min(nearest, std::abs(pole.place - other.place));
    most = std::max(most, nearest / std::abs(pole.place));
  }
  return most;
}

/// The linear least squares at given poles.
struct LinearFit {
  Eigen::MatrixXd matrix;  ///< Regressors without sigma
  Eigen::VectorXd coefficients;
  Eigen::VectorXd left;  ///< Y less the fit
};

/// At the fit's poles; coefficients and squares into the fit too.
LinearFit FitResidues(std::span<const SpectrumLine> lines, RationalFit& fit) {
  Eigen::VectorXd right;
  LinearFit linear{Regressors(lines, fit.poles, false, right), {}, {}};
  Eigen::MatrixXd scaled = linear.matrix;
  linear.coefficients = Solve(scaled, right);
  linear.left = right - linear.matrix * linear.coefficients;
  const Eigen::VectorXd& found = linear.coefficients;
  fit.squares = linear.left.squaredNorm();
  fit.direct = found[0];
  Index at = 1;
  for (Pole& pole : fit.poles) {
    pole.residue = pole.order() == 2 ? Complex(found[at], found[at + 1]) : Complex(found[at], 0.0);
    at += static_cast<Index>(pole.order());
  }
  return linear;
}

/// Derivatives of the fit by real and imaginary part of each pole, rows as those of Regressors;
/// `linear` the coefficients of FitResidues.
Eigen::MatrixXd ByPoles(std::span<const SpectrumLine> lines, const RationalFit& fit,
                        const Eigen::VectorXd& linear) {
  const Index n = OrderOf(fit.poles);
  Eigen::MatrixXd out(static_cast<Index>(2 * lines.size()), n);
  for (Index k = 0; k < out.rows() / 2; ++k) {
    const SpectrumLine& line = lines[static_cast<std::size_t>(k)];
    Index at = 0;
    for (const Pole& pole : fit.poles) {
      const bool pair = pole.order() == 2;
      const auto coefficient = [&](Index first) {
        return Complex(linear[first + at], pair ? linear[first + at + 1] : 0.0);
      };
      const Complex r = coefficient(1);
      const Complex t = coefficient(n + 2);
      const Complex one = 1.0 / (line.zeta - pole.place);
      const Complex upper = (r * line.input + t) * one * one;
      Complex lower = 0.0;
      if (pair) {
        const Complex other = 1.0 / (line.zeta - std::conj(pole.place));
        lower = (std::conj(r) * line.input + std::conj(t)) * other * other;
        const Complex turning = Complex(0.0, 1.0) * (upper - lower);
        out(2 * k, at + 1) = turning.real();
        out(2 * k + 1, at + 1) = turning.imag();
      }
      out(2 * k, at) = (upper + lower).real();
      out(2 * k + 1, at) = (upper + lower).imag();
      at += static_cast<Index>(pole.order());
    }
  }
  return out;
}

std::vector<Pole> Shifted(std::vector<Pole> poles, const Eigen::VectorXd& step, double share) {
  Index at = 0;
  for (Pole& pole : poles) {
    const double turning = pole.order() == 2 ? step[at + 1] : 0.0;
    at += static_cast<Index>(pole.order());
    pole.place += share * Complex(step[at - static_cast<Index>(pole.order())], turning);
  }
  return poles;
}

// Where sigma stands before a noisy Y, poles end beside the least squares; a few steps of
// Gauss-Newton, the linear coefficients always at their own optimum, bring them there.
void Refine(std::span<const SpectrumLine> lines, RationalFit& fit) {
  constexpr int kSteps = 12;
  LinearFit linear = FitResidues(lines, fit);
  for (int turn = 0; turn < kSteps; ++turn) {
    const Index n = OrderOf(fit.poles);
    Eigen::MatrixXd all(linear.matrix.rows(), linear.matrix.cols() + n);
    all << linear.matrix, ByPoles(lines, fit, linear.coefficients);
    const Eigen::VectorXd step = Solve(all, linear.left).tail(n);
    double share = 1.0;
    RationalFit moved;
    for (; share > 1e-3; share *= 0.5) {
      moved = fit;
      moved.poles = Shifted(fit.poles, step, share);
      LinearFit found = FitResidues(lines, moved);
      if (OrderOf(moved.poles) != n || !(moved.squares < fit.squares)) continue;
      linear = std::move(found);
      break;
    }
    if (share <= 1e-3) return;
    const bool arrived = fit.squares - moved.squares < 1e-9 * fit.squares;
    fit = std::move(moved);
    if (arrived) return;
  }
}

/// Pairs spread evenly over the logarithm of the frequency, and a real pole if one is left over.
std::vector<Pole> FirstPoles(std::size_t order, const RationalFitOptions& options) {
  const auto at = [&](Complex s) {
    return options.domain == LawDomain::kDiscrete ? std::exp(s * options.period_s) : s;
  };
  const double low = std::log(options.lowest_rad_per_s);
  const double high = std::log(options.highest_rad_per_s);
  std::vector<Pole> poles;
  const std::size_t pairs = order / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(pairs);
    const double w = std::exp(low + share * (high - low));
    poles.push_back({at({-0.1 * w, w}), {}});
  }
  if (order % 2 == 1) poles.push_back({at(-std::exp(0.5 * (low + high))), {}});
  return poles;
}

}  // namespace

std::size_t RationalFit::order() const noexcept { return static_cast<std::size_t>(OrderOf(poles)); }

Complex RationalFit::At(Complex zeta) const {
  Complex sum = direct;
  for (const Pole& pole : poles) {
    sum += pole.residue / (zeta - pole.place);
    if (pole.order() == 2) sum += std::conj(pole.residue) / (zeta - std::conj(pole.place));
  }
  return sum;
}

RationalFit FitRational(std::span<const SpectrumLine> lines, const std::vector<Pole>& begin,
                        const RationalFitOptions& options) {
  RationalFit fit;
  const Index n = OrderOf(begin);
  if (static_cast<Index>(2 * lines.size()) < 3 * n + 2) return fit;
  fit.poles = begin;
  for (int turn = 0; turn < options.turns && n > 0 && !fit.converged; ++turn) {
    Eigen::VectorXd right;
    Eigen::MatrixXd matrix = Regressors(lines, fit.poles, true, right);
    const Eigen::VectorXd c = Solve(matrix, right).tail(n);
    const bool mirror = 2 * turn < options.turns;
    std::vector<Pole> moved = PolesAt(ZerosOf(fit.poles, c), options.domain, mirror);
    fit.converged = MovedBy(fit.poles, moved) < kArrived;
    fit.poles = std::move(moved);
  }
  fit.converged = fit.converged || n == 0;
  Refine(lines, fit);
  return fit;
}

RationalFit FitRational(std::span<const SpectrumLine> lines, std::size_t order,
                        const RationalFitOptions& options) {
  return FitRational(lines, FirstPoles(order, options), options);
}

}  // namespace levitas::identification
