#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "design/synthesis/structured_singular_value.hpp"
#include "numerics/factors/factors.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

void CheckBlocks(const UncertaintyBlocks& blocks, Eigen::Index rows, Eigen::Index columns) {
  Eigen::Index r = 0;
  Eigen::Index c = 0;
  for (const auto& block : blocks) {
    if (block.rows < 1 || block.columns < 1 ||
        (block.kind != BlockKind::kFullComplex && block.rows != block.columns))
      throw std::invalid_argument("an uncertainty block has an impossible size");
    r += block.rows;
    c += block.columns;
  }
  if (r != rows || c != columns)
    throw std::invalid_argument("the uncertainty blocks do not cover the matrix");
}

UncertaintyBlocks AsComplex(UncertaintyBlocks blocks) {
  for (auto& block : blocks)
    if (block.kind == BlockKind::kRepeatedReal) block.kind = BlockKind::kRepeatedComplex;
  return blocks;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Complex = std::complex<double>;

/// One direction of the unknowns: entry by entry of D, then of G.
struct Direction {
  MuScaling of;
  MatrixXcd form;  ///< M* D M + j (G M - M* G'), to be below b times of.columns
};

/// D and G as a sum of directions with real coefficients.
class ScalingSpace {
 public:
  ScalingSpace(const MatrixXcd& M, const UncertaintyBlocks& blocks, bool real_scaling) : M_(M) {
    ForEachBlock(blocks, [&](std::size_t, const UncertaintyBlock& block, Index r, Index c) {
      if (block.kind == BlockKind::kFullComplex) {
        MuScaling of = Zero();
        of.rows.block(r, r, block.rows, block.rows).setIdentity();
        of.columns.block(c, c, block.columns, block.columns).setIdentity();
        Add(std::move(of), true);
      } else {
        AddRepeated(block, r, c, real_scaling);
      }
    });
  }

  [[nodiscard]] Index unknowns() const { return static_cast<Index>(directions_.size()); }
  [[nodiscard]] const std::vector<Direction>& directions() const noexcept { return directions_; }

  /// D = I, G = 0.
  [[nodiscard]] Eigen::VectorXd Start() const { return start_; }

  [[nodiscard]] MuScaling At(const Eigen::VectorXd& x) const {
    MuScaling sum = Zero();
    for (Index i = 0; i < unknowns(); ++i) {
      const auto& of = directions_[static_cast<std::size_t>(i)].of;
      sum.rows += x(i) * of.rows;
      sum.columns += x(i) * of.columns;
      sum.G += x(i) * of.G;
    }
    return sum;
  }

  [[nodiscard]] MatrixXcd FormAt(const Eigen::VectorXd& x) const {
    MatrixXcd sum = MatrixXcd::Zero(M_.cols(), M_.cols());
    for (Index i = 0; i < unknowns(); ++i)
      sum += x(i) * directions_[static_cast<std::size_t>(i)].form;
    return sum;
  }

 private:
  [[nodiscard]] MuScaling Zero() const {
    return {MatrixXcd::Zero(M_.rows(), M_.rows()), MatrixXcd::Zero(M_.cols(), M_.cols()),
            MatrixXcd::Zero(M_.cols(), M_.rows())};
  }

  void Add(MuScaling of, bool in_start) {
    const MatrixXcd product = of.G * M_;
    const MatrixXcd form =
        M_.adjoint() * of.rows * M_ + Complex(0.0, 1.0) * (product - product.adjoint());
    directions_.push_back({std::move(of), form});
    start_.conservativeResize(unknowns());
    start_(unknowns() - 1) = in_start ? 1.0 : 0.0;
  }

  void AddRepeated(const UncertaintyBlock& block, Index r, Index c, bool real_scaling) {
    const bool with_g = block.kind == BlockKind::kRepeatedReal && !real_scaling;
    for (Index i = 0; i < block.rows; ++i)
      for (Index j = 0; j <= i; ++j)
        for (const Complex entry : {Complex(1.0, 0.0), Complex(0.0, 1.0)}) {
          if (entry.imag() != 0.0 && (i == j || real_scaling)) continue;
          MuScaling d = Zero();
          d.rows(r + i, r + j) = d.columns(c + i, c + j) = entry;
          d.rows(r + j, r + i) = d.columns(c + j, c + i) = std::conj(entry);
          Add(std::move(d), i == j);
          if (!with_g) continue;
          MuScaling g = Zero();
          g.G(c + i, r + j) = entry;
          g.G(c + j, r + i) = std::conj(entry);
          Add(std::move(g), false);
        }
  }

  const MatrixXcd& M_;
  std::vector<Direction> directions_;
  Eigen::VectorXd start_;
};

/// Smallest b for this x: largest generalised eigenvalue of (form, D).
double BoundAt(const ScalingSpace& problem, const Eigen::VectorXd& x) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXcd> solver(
      problem.FormAt(x), problem.At(x).columns, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
  return solver.eigenvalues().maxCoeff();
}

/// -log det(b D - form) - log det D - log(room - trace D), its gradient and Hessian, by whitened
/// directions.
class Barrier {
 public:
  Barrier(const ScalingSpace& problem, double b)
      : problem_(problem), b_(b), room_(2.0 * problem.At(problem.Start()).columns.trace().real()) {}

  [[nodiscard]] double Value(const Eigen::VectorXd& x) const {
    const MatrixXcd D = problem_.At(x).columns;
    const MatrixXcd above = b_ * D - problem_.FormAt(x);
    const Eigen::LLT<MatrixXcd> outer(above);
    const Eigen::LLT<MatrixXcd> inner(D);
    const double room = room_ - D.trace().real();
    if (outer.info() != Eigen::Success || inner.info() != Eigen::Success || !(room > 0.0))
      return INFINITY;
    return -2.0 * (LogDiagonal(outer) + LogDiagonal(inner)) - std::log(room);
  }

  /// Newton's direction and the square of its decrement.
  [[nodiscard]] std::pair<Eigen::VectorXd, double> Newton(const Eigen::VectorXd& x) const {
    const MatrixXcd D = problem_.At(x).columns;
    const MatrixXcd above = b_ * D - problem_.FormAt(x);
    const Eigen::LLT<MatrixXcd> outer(above);
    const Eigen::LLT<MatrixXcd> inner(D);
    const double room = room_ - D.trace().real();
    const Index n = D.rows();
    const Index unknowns = problem_.unknowns();
    Eigen::MatrixXd whitened(4 * n * n + 1, unknowns);
    Eigen::VectorXd gradient(unknowns);
    for (Index i = 0; i < unknowns; ++i) {
      const Direction& direction = problem_.directions()[static_cast<std::size_t>(i)];
      const MatrixXcd& step = direction.of.columns;
      const MatrixXcd a = Whiten(outer, b_ * step - direction.form);
      const MatrixXcd c = Whiten(inner, step);
      const double trace = step.trace().real() / room;
      whitened.col(i) << a.real().reshaped(), a.imag().reshaped(), c.real().reshaped(),
          c.imag().reshaped(), trace;
      gradient(i) = -a.trace().real() - c.trace().real() + trace;
    }
    const Eigen::MatrixXd hessian = whitened.transpose() * whitened;
    const Eigen::VectorXd step = -hessian.ldlt().solve(gradient);
    return {step, -gradient.dot(step)};
  }

 private:
  static double LogDiagonal(const Eigen::LLT<MatrixXcd>& llt) {
    return llt.matrixLLT().diagonal().real().array().log().sum();
  }
  static MatrixXcd Whiten(const Eigen::LLT<MatrixXcd>& llt, const MatrixXcd& matrix) {
    const MatrixXcd half = llt.matrixL().solve(matrix);
    return llt.matrixL().solve(half.adjoint());
  }

  const ScalingSpace& problem_;
  double b_, room_;
};

/// Moves x to the centre of the set of level b; false when rounding stops it.
bool Centre(const ScalingSpace& problem, double b, Eigen::VectorXd& x) {
  constexpr int kMostSteps = 30;
  constexpr double kCentred = 0.05;  // square of the decrement: close enough for the next level
  const Barrier barrier(problem, b);
  double value = barrier.Value(x);
  for (int step = 0; step < kMostSteps; ++step) {
    const auto [direction, decrement] = barrier.Newton(x);
    if (!direction.allFinite() || !(decrement >= 0.0)) return false;
    if (decrement < kCentred) return true;
    double length = 1.0;
    double next = barrier.Value(x + direction);
    while (!(next < value - 0.1 * length * decrement) && length > 1e-9) {
      length *= 0.5;
      next = barrier.Value(x + length * direction);
    }
    if (!(next < value)) return false;
    x += length * direction;
    value = next;
  }
  return true;
}

}  // namespace

MuUpper MuUpperBound(const MatrixXcd& M, const UncertaintyBlocks& blocks, bool real_scaling) {
  // Ends when three levels together gain less than a thousandth: mu within about 0.1 %.
  constexpr int kMostLevels = 80;
  constexpr double kSettled = 1e-3;
  constexpr double kAbove = 0.02;  // share of the last gain kept between the level and its set
  CheckBlocks(blocks, M.rows(), M.cols());
  const double size = M.norm();
  if (!(size > 0.0)) {
    const MatrixXcd one_r = MatrixXcd::Identity(M.rows(), M.rows());
    const MatrixXcd one_c = MatrixXcd::Identity(M.cols(), M.cols());
    return {0.0, {one_r, one_c, MatrixXcd::Zero(M.cols(), M.rows())}};
  }
  const MatrixXcd unit = M / size;
  const ScalingSpace problem(unit, blocks, real_scaling);
  Eigen::VectorXd x = problem.Start();
  Eigen::VectorXd best = x;
  double bound = BoundAt(problem, x);
  double level = 1.2 * bound + 1e-12;
  std::vector<double> bounds{bound};
  for (int step = 0; step < kMostLevels; ++step) {
    const bool centred = Centre(problem, level, x);
    const double now = BoundAt(problem, x);
    if (now < bound) {
      bound = now;
      best = x;
    }
    if (!centred || !(bound > 1e-10)) break;
    bounds.push_back(bound);
    if (bounds.size() > 4 && bounds[bounds.size() - 4] - bound < kSettled * bound) break;
    level = now + kAbove * (level - now);
  }
  MuUpper out{size * std::sqrt(std::max(bound, 0.0)), problem.At(best)};
  out.scaling.G *= size;  // M was scaled to norm 1: D is unchanged, G grows with M
  return out;
}

}  // namespace levitas::synthesis
