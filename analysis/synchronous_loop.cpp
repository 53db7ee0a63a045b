#include "analysis/synchronous_loop.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/loop_response.hpp"
#include "common/rotational_speed.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/spectrum.hpp"

namespace levitas::analysis {
namespace {

using Index = Eigen::Index;
using synchronous::Target;

/// The law of all axes as one model, whatever its kind.
struct WholeLaw {
  Eigen::MatrixXd a, b, c, d;
};

WholeLaw WholeOf(const SampledLoop& loop) {
  if (loop.coupled) return {loop.coupled->a, loop.coupled->b, loop.coupled->c, loop.coupled->d};
  const auto axes = static_cast<Index>(loop.law.size());
  Index states = 0;
  for (const AxisModel& axis : loop.law) states += axis.a.rows();
  WholeLaw law{Eigen::MatrixXd::Zero(states, states), Eigen::MatrixXd::Zero(states, axes),
               Eigen::MatrixXd::Zero(axes, states), Eigen::MatrixXd::Zero(axes, axes)};
  Index at = 0;
  for (Index i = 0; i < axes; ++i) {
    const AxisModel& axis = loop.law[static_cast<std::size_t>(i)];
    const Index order = axis.a.rows();
    law.a.block(at, at, order, order) = axis.a;
    law.b.block(at, i, order, 1) = axis.b;
    law.c.block(i, at, 1, order) = axis.c;
    law.d(i, i) = axis.d;
    at += order;
  }
  return law;
}

/// Orthonormal basis of what T can give: of a block for one direction half of all amplitudes. The
/// others are never moved, and no part of a judgement.
Eigen::MatrixXcd RangeOf(const Eigen::MatrixXcd& inverse) {
  constexpr double kNothing = 1e-12;  // of the largest, squared
  const Eigen::MatrixXcd gram = inverse * inverse.adjoint();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(gram);
  const Eigen::VectorXd& values = solver.eigenvalues();  // ascending
  Index rank = 0;
  while (rank < values.size() && values[values.size() - 1 - rank] > kNothing * values.maxCoeff()) {
    ++rank;
  }
  return solver.eigenvectors().rightCols(rank);
}

/// A block at one speed: z <- e^{j a} (z + k T e), a = n w T_s, k = 2 T_s/tau, in the basis U of
/// what T can give: z = U q.
struct TurningBlock {
  Target target{};
  Eigen::MatrixXcd basis;    ///< U
  Eigen::MatrixXcd inverse;  ///< U^H T
  std::complex<double> turn;
  double rate;  ///< k

  TurningBlock(const synchronous::BlockConfig& block, std::size_t axes, double speed_rad_per_s,
               double period_s)
      : target(block.target),
        turn(std::polar(1.0, block.order * speed_rad_per_s * period_s)),
        rate(2.0 * period_s / block.time_constant_s) {
    const Eigen::MatrixXcd whole = MatrixOf(synchronous::InverseAt(block, speed_rad_per_s), axes);
    basis = RangeOf(whole);
    inverse = basis.adjoint() * whole;
  }
};

/// States [x; w; re q; im q; ...]. The law reads e = -(C x + re z of kCurrent), the plant is given
/// what the law says and re z of kVibration.
Eigen::MatrixXd LoopWithBlocks(const SampledLoop& loop, const WholeLaw& law,
                               const std::vector<TurningBlock>& blocks) {
  const Index states = loop.plant.a.rows();
  const Index axes = loop.plant.c.rows();
  const Index of_law = law.a.rows();
  Index order = states + of_law;
  std::vector<Index> first;
  for (const TurningBlock& block : blocks) {
    first.push_back(order);
    order += 2 * block.basis.cols();
  }
  Eigen::MatrixXd read = Eigen::MatrixXd::Zero(axes, order);
  Eigen::MatrixXd given = Eigen::MatrixXd::Zero(axes, order);
  read.leftCols(states) = loop.plant.c;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    Eigen::MatrixXd& into = blocks[k].target == Target::kCurrent ? read : given;
    const Index rank = blocks[k].basis.cols();
    into.middleCols(first[k], rank) = blocks[k].basis.real();
    into.middleCols(first[k] + rank, rank) = -blocks[k].basis.imag();
  }
  given -= law.d * read;
  given.middleCols(states, of_law) -= law.c;
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(order, order);
  all.topRows(states) = loop.plant.b * given;
  all.topLeftCorner(states, states) += loop.plant.a;
  all.middleRows(states, of_law) = law.b * read;
  all.block(states, states, of_law, of_law) += law.a;
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const Index rank = blocks[k].basis.cols();
    Eigen::MatrixXcd next =
        -(blocks[k].turn * blocks[k].rate) * blocks[k].inverse * read.cast<std::complex<double>>();
    next.middleCols(first[k], rank).diagonal().array() += blocks[k].turn;
    next.middleCols(first[k] + rank, rank).diagonal().array() +=
        blocks[k].turn * std::complex<double>(0.0, 1.0);
    all.middleRows(first[k], rank) = next.real();
    all.middleRows(first[k] + rank, rank) = next.imag();
  }
  return all;
}

double LargestModulus(const Eigen::MatrixXd& matrix) {
  return numerics::EigenvaluesOf(matrix).cwiseAbs().maxCoeff();
}

}  // namespace

// Those of the real [A -B; B A].
Eigen::VectorXcd EigenvaluesWithConjugates(const Eigen::MatrixXcd& matrix) {
  const Index n = matrix.rows();
  Eigen::MatrixXd real(2 * n, 2 * n);
  real << matrix.real(), -matrix.imag(), matrix.imag(), matrix.real();
  return numerics::EigenvaluesOf(real);
}

double LargestPoleModulus(const SampledLoop& loop) {
  return LargestModulus(ClosedLoopMatrix(loop));
}

Eigen::MatrixXcd SynchronousAnswer(const LoopResponse& response, double speed_rad_per_s,
                                   double order, Target target) {
  const double hz = order * speed_rad_per_s / (2.0 * std::numbers::pi);
  const Eigen::MatrixXcd sensitivity = response.Sensitivity(hz);
  if (target == Target::kCurrent) return sensitivity;
  return sensitivity * response.Plant(hz);
}

Eigen::MatrixXcd MatrixOf(const synchronous::ComplexMatrix& matrix, std::size_t axes) {
  const auto size = static_cast<Index>(axes);
  Eigen::MatrixXcd made(size, size);
  for (std::size_t to = 0; to < axes; ++to) {
    for (std::size_t from = 0; from < axes; ++from) {
      made(static_cast<Index>(to), static_cast<Index>(from)) = {matrix.real[to][from],
                                                                matrix.imaginary[to][from]};
    }
  }
  return made;
}

synchronous::ComplexMatrix ComplexMatrixOf(const Eigen::MatrixXcd& matrix) {
  synchronous::ComplexMatrix made;
  for (Index to = 0; to < matrix.rows(); ++to) {
    for (Index from = 0; from < matrix.cols(); ++from) {
      const auto i = static_cast<std::size_t>(to);
      const auto j = static_cast<std::size_t>(from);
      made.real[i][j] = matrix(to, from).real();
      made.imaginary[i][j] = matrix(to, from).imag();
    }
  }
  return made;
}

bool SynchronousJudgement::stable() const noexcept {
  const bool slow = std::all_of(blocks.begin(), blocks.end(), [](const BlockJudgement& block) {
    return !block.acts || block.slowest_decay > 0.0;
  });
  return slow && largest_pole_modulus < 1.0;
}

SynchronousJudgement JudgeSynchronous(const SampledLoop& loop,
                                      const synchronous::SynchronousConfig& control,
                                      double speed_rad_per_s) {
  SynchronousJudgement made;
  made.speed_rad_per_s = speed_rad_per_s;
  const auto axes = static_cast<std::size_t>(loop.plant.c.rows());
  const LoopResponse response(loop);
  std::vector<TurningBlock> acting;
  for (const synchronous::BlockConfig& block : control.blocks) {
    BlockJudgement& judged = made.blocks.emplace_back();
    judged.acts = synchronous::ActsAt(block, speed_rad_per_s);
    if (!judged.acts) continue;
    const TurningBlock& turning = acting.emplace_back(block, axes, speed_rad_per_s, loop.period_s);
    const Eigen::MatrixXcd product =
        turning.inverse * SynchronousAnswer(response, speed_rad_per_s, block.order, block.target) *
        turning.basis;
    judged.slowest_decay = product.size() == 0  // T gives nothing, or is no number
                               ? std::numeric_limits<double>::quiet_NaN()
                               : EigenvaluesWithConjugates(product).real().minCoeff();
  }
  made.largest_pole_modulus = LargestModulus(LoopWithBlocks(loop, WholeOf(loop), acting));
  return made;
}

std::vector<double> JudgedSpeeds(const synchronous::SynchronousConfig& control, std::size_t count,
                                 TableSpeeds table) {
  std::vector<double> speeds;
  for (const synchronous::BlockConfig& block : control.blocks) {
    const double low = std::max(0.0, block.from_rad_per_s - block.hysteresis_rad_per_s);
    const double high = block.to_rad_per_s + block.hysteresis_rad_per_s;
    for (std::size_t i = 0; i < count; ++i) {
      const double share =
          count < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
      speeds.push_back(std::lerp(low, high, share));  // ends at `high`, where the block acts
    }
    for (const auto& at : block.inverse) {
      if (table == TableSpeeds::kLeftOut) break;
      if (at.speed_rad_per_s >= low && at.speed_rad_per_s <= high) {
        speeds.push_back(at.speed_rad_per_s);
      }
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  return speeds;
}

std::string UnstableBlocks(const plant::PlantConfig& plant, const law::LawConfig& law,
                           const synchronous::SynchronousConfig& control) {
  constexpr std::size_t kSpeeds = 25;
  for (const synchronous::BlockConfig& block : control.blocks) {
    synchronous::SynchronousConfig alone;
    alone.blocks.push_back(block);
    std::vector<double> unstable_rpm;
    double worst = 1.0;
    double largest = 0.0;
    for (const double speed : JudgedSpeeds(alone, kSpeeds, TableSpeeds::kLeftOut)) {
      // All blocks act together where their windows overlap.
      const SampledLoop loop = CloseLoop(plant, law, speed);
      const SynchronousJudgement judged = JudgeSynchronous(loop, control, speed);
      if (judged.stable() || !(LargestPoleModulus(loop) < 1.0)) continue;
      unstable_rpm.push_back(RadPerSToRpm(speed));
      largest = std::max(largest, judged.largest_pole_modulus);
      for (const BlockJudgement& each : judged.blocks) {
        if (each.acts) worst = std::min(worst, each.slowest_decay);
      }
    }
    if (unstable_rpm.empty()) continue;
    return fmt::format(
        "synchronous block {} is not stable with this rig from {:.0f} to {:.0f} rpm (slowest decay "
        "{:.3g}, below 0 it grows; largest |z| of the loop {:.6f})",
        block.name, unstable_rpm.front(), unstable_rpm.back(), worst, largest);
  }
  return {};
}

}  // namespace levitas::analysis
