#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "common/random.hpp"
#include "design/synthesis/structured_singular_value.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/spectra/spectra.hpp"

namespace levitas::synthesis {

namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Complex = std::complex<double>;

Complex PhaseOf(Complex value) {
  const double size = std::abs(value);
  return size > 0.0 ? value / size : Complex(1.0, 0.0);
}

double Ratio(double above, double below) { return below > 1e-300 ? above / below : 0.0; }

/// State of the power iteration: a, z stand at the rows of M, b, w at its columns.
class PowerIteration {
 public:
  PowerIteration(const MatrixXcd& M, const UncertaintyBlocks& blocks, Random& random)
      : M_(M), blocks_(blocks), b_(M.cols()), w_(M.cols()), q_(blocks.size()) {
    for (auto* vector : {&b_, &w_})
      for (auto& value : *vector) value = Complex(random.Normal(), random.Normal());
    b_.normalize();
    w_.normalize();
    for (auto& q : q_) q = random.Uniform() < 0.5 ? -1.0 : 1.0;
  }

  void Step() {
    VectorXcd a = M_ * b_;
    a.normalize();
    VectorXcd z(M_.rows());
    ForEachBlock(blocks_, [&](std::size_t i, const UncertaintyBlock& block, Index r, Index c) {
      const auto ai = a.segment(r, block.rows);
      const auto wi = w_.segment(c, block.columns);
      if (block.kind == BlockKind::kFullComplex) {
        z.segment(r, block.rows) = Ratio(wi.norm(), ai.norm()) * ai;
      } else if (block.kind == BlockKind::kRepeatedComplex) {
        z.segment(r, block.rows) = PhaseOf(wi.dot(ai)) * wi;
      } else {
        z.segment(r, block.rows) = q_[i] * wi;
      }
    });
    w_ = M_.adjoint() * z;
    w_.normalize();
    ForEachBlock(blocks_, [&](std::size_t i, const UncertaintyBlock& block, Index r, Index c) {
      const auto ai = a.segment(r, block.rows);
      const auto wi = w_.segment(c, block.columns);
      auto bi = b_.segment(c, block.columns);
      if (block.kind == BlockKind::kFullComplex) {
        bi = Ratio(ai.norm(), wi.norm()) * wi;
      } else if (block.kind == BlockKind::kRepeatedComplex) {
        bi = PhaseOf(ai.dot(wi)) * ai;
      } else {
        const double wanted = std::copysign(Ratio(bi.norm(), ai.norm()), q_[i]) + ai.dot(wi).real();
        q_[i] = std::clamp(wanted, -1.0, 1.0);
        bi = q_[i] * ai;
      }
    });
    a_ = a;
    b_.normalize();
  }

  /// The perturbation of norm one that the iteration stands at, complex blocks turned by `phase`.
  [[nodiscard]] MatrixXcd Delta(double phase) const {
    const Complex turn = std::polar(1.0, phase);
    MatrixXcd delta = MatrixXcd::Zero(M_.cols(), M_.rows());
    ForEachBlock(blocks_, [&](std::size_t i, const UncertaintyBlock& block, Index r, Index c) {
      const auto ai = a_.segment(r, block.rows);
      const auto wi = w_.segment(c, block.columns);
      auto part = delta.block(c, r, block.columns, block.rows);
      const double size = ai.norm() * wi.norm();
      if (block.kind == BlockKind::kFullComplex) {
        if (size > 1e-300) part = turn * (wi * ai.adjoint()) / size;
      } else if (block.kind == BlockKind::kRepeatedComplex) {
        part.diagonal().setConstant(turn * PhaseOf(ai.dot(wi)));
      } else {
        part.diagonal().setConstant(q_[i]);
      }
    });
    return delta;
  }

 private:
  const MatrixXcd& M_;
  const UncertaintyBlocks& blocks_;
  VectorXcd a_, b_, w_;
  std::vector<double> q_;
};

PowerIteration Iterated(const MatrixXcd& M, const UncertaintyBlocks& blocks, Random& random) {
  constexpr int kSteps = 100;
  PowerIteration iteration(M, blocks, random);
  for (int step = 0; step < kSteps; ++step) iteration.Step();
  return iteration;
}

VectorXcd Eigenvalues(const MatrixXcd& matrix) {
  return Eigen::ComplexEigenSolver<MatrixXcd>(matrix, false).eigenvalues();
}

/// Largest |real eigenvalue| of M Delta: I - M Delta/lambda is singular.
double LargestReal(const MatrixXcd& matrix) {
  constexpr double kReal = 1e-9;
  double largest = 0.0;
  const VectorXcd values = Eigenvalues(matrix);
  for (const auto& value : values)
    if (std::abs(value.imag()) <= kReal * std::abs(value))
      largest = std::max(largest, std::abs(value.real()));
  return largest;
}

/// The eigenvalue nearest to `near`.
Complex Nearest(const VectorXcd& values, Complex near) {
  Complex found = values(0);
  for (const auto& value : values)
    if (std::abs(value - near) < std::abs(found - near)) found = value;
  return found;
}

/// With real and complex blocks: turns the complex ones until an eigenvalue is real.
double LargestTurnedReal(const MatrixXcd& M, const PowerIteration& at) {
  constexpr int kTurns = 24;
  constexpr int kHalvings = 40;
  double largest = 0.0;
  const double turn = 2.0 * std::numbers::pi / kTurns;
  for (int i = 0; i < kTurns; ++i) {
    const double from = i * turn;
    const VectorXcd starts = Eigenvalues(M * at.Delta(from));
    const VectorXcd ends = Eigenvalues(M * at.Delta(from + turn));
    for (const auto& start : starts) {
      Complex low = start;
      const Complex high = Nearest(ends, start);
      if (std::abs(low) <= largest || (low.imag() < 0.0) == (high.imag() < 0.0)) continue;
      double a = from;
      double b = from + turn;
      for (int halving = 0; halving < kHalvings; ++halving) {
        const double middle = 0.5 * (a + b);
        const Complex value = Nearest(Eigenvalues(M * at.Delta(middle)), low);
        if ((value.imag() < 0.0) == (low.imag() < 0.0)) {
          a = middle;
          low = value;
        } else {
          b = middle;
        }
      }
      if (std::abs(low.imag()) <= 1e-6 * std::abs(low))
        largest = std::max(largest, std::abs(low.real()));
    }
  }
  return largest;
}

/// Largest |eigenvalue| of M Delta over the perturbations that power iterations find; complex
/// blocks only.
double ComplexLowerBound(const MatrixXcd& M, const UncertaintyBlocks& blocks, int starts,
                         Random& random) {
  double largest = 0.0;
  for (int start = 0; start < starts; ++start) {
    const PowerIteration iteration = Iterated(M, blocks, random);
    largest = std::max(largest, Eigenvalues(M * iteration.Delta(0.0)).cwiseAbs().maxCoeff());
  }
  return largest;
}

/// M with rows and columns of the real blocks first.
struct Parted {
  MatrixXcd M;
  Index real{};  ///< rows (and columns) of the real blocks
  UncertaintyBlocks real_blocks, complex_blocks;
};

Parted RealFirst(const MatrixXcd& M, const UncertaintyBlocks& blocks) {
  Parted out;
  std::vector<Index> rows, columns;
  for (const bool real : {true, false}) {
    ForEachBlock(blocks, [&](std::size_t, const UncertaintyBlock& block, Index r, Index c) {
      if ((block.kind == BlockKind::kRepeatedReal) != real) return;
      for (Index i = 0; i < block.rows; ++i) rows.push_back(r + i);
      for (Index i = 0; i < block.columns; ++i) columns.push_back(c + i);
      (real ? out.real_blocks : out.complex_blocks).push_back(block);
      if (real) out.real += block.rows;
    });
  }
  out.M = M(rows, columns);
  return out;
}

/// Real parameters held at corners, at zero and at drawn places: with them at q/b, the complex
/// blocks see F = M22 + M21 q/b (I - M11 q/b)^-1 M12, and b is a lower bound when that of F is b or
/// more.
double HeldRealLowerBound(const MatrixXcd& M, const UncertaintyBlocks& blocks, double known,
                          Random& random) {
  constexpr int kStarts = 3;
  constexpr std::size_t kDraws = 24;
  constexpr int kHalvings = 12;
  const Parted parted = RealFirst(M, blocks);
  const Index n = parted.real;
  const Index rest_rows = M.rows() - n;
  const Index rest_columns = M.cols() - n;
  double best = known;
  for (std::size_t draw = 0; draw <= kDraws; ++draw) {
    MatrixXcd q = MatrixXcd::Zero(n, n);
    Index at = 0;
    for (std::size_t i = 0; i < parted.real_blocks.size(); ++i) {
      const double corner = i < 4 && ((draw >> i) & 1U) != 0U ? 1.0 : -1.0;
      const double value = draw < 16 ? corner : (draw == 16 ? 0.0 : 2.0 * random.Uniform() - 1.0);
      for (Index k = 0; k < parted.real_blocks[i].rows; ++k, ++at) q(at, at) = value;
    }
    const auto is_bound = [&](double b) {
      const MatrixXcd one = MatrixXcd::Identity(n, n);
      const MatrixXcd inner = (one - parted.M.topLeftCorner(n, n) * q / b)
                                  .partialPivLu()
                                  .solve(parted.M.topRightCorner(n, rest_columns));
      const MatrixXcd F = parted.M.bottomRightCorner(rest_rows, rest_columns) +
                          parted.M.bottomLeftCorner(rest_rows, n) * q / b * inner;
      return F.allFinite() && ComplexLowerBound(F, parted.complex_blocks, kStarts, random) >= b;
    };
    double low = std::max(best * 1.002, 1e-9 * M.norm());
    if (!is_bound(low)) continue;
    double high = std::max(M.norm(), low);
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (low + high);
      (is_bound(middle) ? low : high) = middle;
    }
    best = low;
  }
  return best;
}

}  // namespace

double MuLowerBound(const MatrixXcd& M, const UncertaintyBlocks& blocks) {
  constexpr int kStarts = 12;
  CheckBlocks(blocks, M.rows(), M.cols());
  bool has_real = false;
  bool has_complex = false;
  for (const auto& block : blocks)
    (block.kind == BlockKind::kRepeatedReal ? has_real : has_complex) = true;
  Random random(20261123);
  if (!has_real) return ComplexLowerBound(M, blocks, kStarts, random);
  double largest = 0.0;
  for (int start = 0; start < kStarts; ++start) {
    const PowerIteration iteration = Iterated(M, blocks, random);
    largest = std::max(largest, LargestReal(M * iteration.Delta(0.0)));
    if (has_complex) largest = std::max(largest, LargestTurnedReal(M, iteration));
  }
  return has_complex ? HeldRealLowerBound(M, blocks, largest, random) : largest;
}

}  // namespace levitas::synthesis
