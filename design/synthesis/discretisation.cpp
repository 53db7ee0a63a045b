#include "design/synthesis/discretisation.hpp"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/problem.hpp"
#include "design/synthesis/linear_solve.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/exponential.hpp"
#include "numerics/dense/spectrum.hpp"
#include "numerics/factors/factors.hpp"

namespace levitas::synthesis {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

SampledSystem Tustin(const StateSpace& system, double period_s) {
  CheckShapes(system);
  const Index n = system.states();
  const MatrixXd one = MatrixXd::Identity(n, n);
  const Eigen::FullPivLU<MatrixXd> lu(one - 0.5 * period_s * system.A);
  if (n > 0 && !lu.isInvertible())
    throw Problem(ExitStatus::kOther,
                  "Tustin's rule has no answer: the controller has a growing mode as fast as the "
                  "sampling; sample faster, or limit the controller's bandwidth");
  // u and y stay those of the instant: D' = D + C (I - A T/2)^-1 B T/2.
  const MatrixXd B = SolveColumns(lu, system.B * period_s);
  StateSpace out;
  out.A = SolveColumns(lu, one + 0.5 * period_s * system.A);
  out.B = B;
  out.C = 0.5 * system.C * (out.A + one);
  out.D = system.D + 0.5 * system.C * B;
  return {out, period_s};
}

StateSpace InverseTustin(const SampledSystem& sampled) {
  const StateSpace& system = sampled.matrices;
  CheckShapes(system);
  const Index n = system.states();
  const Eigen::FullPivLU<MatrixXd> lu(system.A + MatrixXd::Identity(n, n));
  if (n > 0 && !lu.isInvertible())
    throw Problem(ExitStatus::kOther,
                  "the sampled plant has a pole at z = -1, which no continuous system has");
  const MatrixXd half = 2.0 * SolveColumns(lu, MatrixXd::Identity(n, n));  // I - A T/2
  StateSpace out;
  out.A = 2.0 / sampled.period_s * (MatrixXd::Identity(n, n) - half);
  out.B = half * system.B / sampled.period_s;
  out.C = system.C * half;
  out.D = system.D - 0.5 * out.C * system.B;
  return out;
}

SampledSystem ZeroOrderHold(const StateSpace& system, double period_s) {
  CheckShapes(system);
  const Index n = system.states();
  const Index m = system.inputs();
  MatrixXd joined = MatrixXd::Zero(n + m, n + m);
  joined.topLeftCorner(n, n) = system.A * period_s;
  joined.topRightCorner(n, m) = system.B * period_s;
  const MatrixXd grown = joined.exp();
  StateSpace out{grown.topLeftCorner(n, n), grown.topRightCorner(n, m), system.C, system.D};
  return {out, period_s};
}

MatrixXcd Response(const SampledSystem& system, double rad_per_s) {
  return TransferAt(system.matrices, std::polar(1.0, rad_per_s * system.period_s));
}

double SamplingError(const StateSpace& system, const SampledSystem& sampled,
                     double last_rad_per_s) {
  constexpr int kPoints = 400;
  double difference = 0.0;
  double largest = 0.0;
  for (int i = 1; i <= kPoints; ++i) {
    const double w = last_rad_per_s * std::pow(1e-4, 1.0 - static_cast<double>(i) / kPoints);
    const MatrixXcd continuous = Response(system, w);
    difference = std::max(difference, (Response(sampled, w) - continuous).norm());
    largest = std::max(largest, continuous.norm());
  }
  return largest > 0.0 ? difference / largest : difference;
}

StateSpace PadeDelay(double delay_s, int order, Index channels) {
  if (order < 1 || order > 4 || !(delay_s > 0.0))
    throw std::invalid_argument("a Pade delay has order 1 to 4 and a delay above zero");
  // Coefficients of (s T)^k: (2n - k)! n! / ((2n)! k! (n - k)!), by their recurrence.
  const Index n = order;
  Eigen::VectorXd c(n + 1);
  c(0) = 1.0;
  for (Index k = 1; k <= n; ++k)
    c(k) = c(k - 1) * static_cast<double>(n - k + 1) / static_cast<double>(k * (2 * n - k + 1));
  // Companion form in s T, then time scaled by 1/T; numerator has alternating signs.
  const double sign_n = n % 2 == 0 ? 1.0 : -1.0;
  StateSpace one{MatrixXd::Zero(n, n), MatrixXd::Zero(n, 1), MatrixXd::Zero(1, n),
                 MatrixXd::Constant(1, 1, sign_n)};
  for (Index k = 0; k < n; ++k) {
    if (k + 1 < n) one.A(k, k + 1) = 1.0 / delay_s;
    one.A(n - 1, k) = -c(k) / c(n) / delay_s;
    const double sign_k = k % 2 == 0 ? 1.0 : -1.0;
    one.C(0, k) = (sign_k - sign_n) * c(k) / c(n);
  }
  one.B(n - 1, 0) = 1.0 / delay_s;
  return Copies(one, channels);
}

namespace {

/// The same input-output gain for B and C of the part.
ModalPart Evened(ModalPart part) {
  const double ratio = std::sqrt(part.C.norm() / std::max(part.B.norm(), 1e-300));
  if (!(ratio > 0.0) || !std::isfinite(ratio)) return part;
  part.B *= ratio;
  part.C /= ratio;
  return part;
}

StateSpace Assembled(const ModalSystem& modal) {
  StateSpace sum = Gain(modal.D);
  for (const auto& part : modal.parts) {
    const double re = part.pole.real();
    const double im = part.pole.imag();
    MatrixXd A = MatrixXd::Constant(1, 1, re);
    if (part.B.rows() == 2) A = Eigen::Matrix2d{{re, im}, {-im, re}};
    sum = Sum(sum, {A, part.B, part.C, MatrixXd::Zero(modal.D.rows(), modal.D.cols())});
  }
  return sum;
}

}  // namespace

ModalSystem ModalForm(const StateSpace& given) {
  constexpr double kAllowed = 1e-6;  // error of the response: far below what a converter resolves
  CheckShapes(given);
  ModalSystem out{{}, given.D};
  if (given.states() == 0) return out;
  const StateSpace system = Balanced(given);
  const numerics::Spectrum spectrum = numerics::SpectrumOf(system.A);
  const Index n = system.states();
  MatrixXd T(n, n);
  const auto& poles = spectrum.values;
  const MatrixXcd& vectors = spectrum.vectors;
  for (Index i = 0; i < n; ++i) {
    T.col(i) = vectors.col(i).real();
    if (poles(i).imag() > 0.0 && i + 1 < n) {  // the solver lists pairs together
      T.col(i + 1) = vectors.col(i).imag();
      ++i;
    }
  }
  const MatrixXd B = SolveColumns(Eigen::FullPivLU<MatrixXd>(T), system.B);
  const MatrixXd C = system.C * T;
  for (Index i = 0; i < n; ++i) {
    const Index size = poles(i).imag() > 0.0 ? 2 : 1;
    out.parts.push_back(Evened({poles(i), B.middleRows(i, size), C.middleCols(i, size)}));
    i += size - 1;
  }
  const StateSpace again = Assembled(out);
  for (const auto& pole : poles) {  // near every pole, where an error is largest
    const std::complex<double> at(pole.real() + 0.1 * std::abs(pole) + 1e-3, std::abs(pole.imag()));
    const MatrixXcd wanted = TransferAt(system, at);
    if (!((TransferAt(again, at) - wanted).norm() <= kAllowed * (wanted.norm() + given.D.norm())))
      throw Problem(ExitStatus::kOther,
                    "the controller's poles repeat and cannot stand alone as blocks of one or two "
                    "states: reduce its order, or move a pole of a weight by a little");
  }
  return out;
}

}  // namespace levitas::synthesis
