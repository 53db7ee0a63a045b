#include "analysis/synchronous_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/loop_response.hpp"
#include "controller/synchronous/inverse_ladder.hpp"
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

bool ActsAt(const synchronous::BlockConfig& block, double speed_rad_per_s) {
  return speed_rad_per_s >= block.from_rad_per_s - block.hysteresis_rad_per_s &&
         speed_rad_per_s <= block.to_rad_per_s + block.hysteresis_rad_per_s;
}

/// States [x; w; re z; im z; ...] with z the turning amplitude of a block as it stands in the fixed
/// frame: z <- e^{j a} (z + k T e), a = n w T_s, k = 2 T_s/tau, e = -(C x + re z of kCurrent).
class LoopWithBlocks {
 public:
  LoopWithBlocks(const SampledLoop& loop, const WholeLaw& law,
                 const std::vector<const synchronous::BlockConfig*>& blocks)
      : plant_(loop.plant),
        law_(law),
        axes_(loop.plant.c.rows()),
        order_(plant_.a.rows() + law.a.rows() + 2 * axes_ * static_cast<Index>(blocks.size())),
        period_s_(loop.period_s) {
    // What the law reads, and what the plant is given, as rows over all states.
    read_ = Eigen::MatrixXd::Zero(axes_, order_);
    read_.leftCols(plant_.a.rows()) = plant_.c;
    Eigen::MatrixXd added = Eigen::MatrixXd::Zero(axes_, order_);
    for (std::size_t k = 0; k < blocks.size(); ++k) {
      Eigen::MatrixXd& into = blocks[k]->target == Target::kCurrent ? read_ : added;
      into.middleCols(First(k), axes_).setIdentity();
    }
    given_ = added - law_.d * read_;
    given_.middleCols(plant_.a.rows(), law_.a.rows()) -= law_.c;
  }

  [[nodiscard]] Eigen::MatrixXd Matrix(const std::vector<const synchronous::BlockConfig*>& blocks,
                                       double speed_rad_per_s) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(order_, order_);
    const Index states = plant_.a.rows();
    all.topRows(states) = plant_.b * given_;
    all.topLeftCorner(states, states) += plant_.a;
    all.middleRows(states, law_.a.rows()) = law_.b * read_;
    all.block(states, states, law_.a.rows(), law_.a.rows()) += law_.a;
    for (std::size_t k = 0; k < blocks.size(); ++k) AddBlock(*blocks[k], k, speed_rad_per_s, all);
    return all;
  }

 private:
  [[nodiscard]] Index First(std::size_t block) const {
    return plant_.a.rows() + law_.a.rows() + 2 * axes_ * static_cast<Index>(block);
  }

  void AddBlock(const synchronous::BlockConfig& block, std::size_t k, double speed_rad_per_s,
                Eigen::MatrixXd& all) const {
    const double rate = 2.0 * period_s_ / block.time_constant_s;
    const Eigen::MatrixXcd inverse =
        MatrixOf(synchronous::InverseAt(block, speed_rad_per_s), static_cast<std::size_t>(axes_));
    Eigen::MatrixXcd turning = -rate * inverse * read_.cast<std::complex<double>>();
    for (Index i = 0; i < axes_; ++i) {
      turning(i, First(k) + i) += 1.0;
      turning(i, First(k) + axes_ + i) += std::complex<double>(0.0, 1.0);
    }
    turning *= std::polar(1.0, block.order * speed_rad_per_s * period_s_);
    all.middleRows(First(k), axes_) = turning.real();
    all.middleRows(First(k) + axes_, axes_) = turning.imag();
  }

  const plant::LinearModel& plant_;
  const WholeLaw& law_;
  Index axes_;
  Index order_;
  double period_s_;
  Eigen::MatrixXd read_, given_;
};

double LargestModulus(const Eigen::MatrixXd& matrix) {
  return numerics::EigenvaluesOf(matrix).cwiseAbs().maxCoeff();
}

/// Eigenvalues of A + j B and their conjugates: those of the real [A -B; B A].
Eigen::VectorXcd WithConjugates(const Eigen::MatrixXcd& matrix) {
  const Index n = matrix.rows();
  Eigen::MatrixXd real(2 * n, 2 * n);
  real << matrix.real(), -matrix.imag(), matrix.imag(), matrix.real();
  return numerics::EigenvaluesOf(real);
}

}  // namespace

Eigen::MatrixXcd SynchronousAnswer(const SampledLoop& loop, double speed_rad_per_s, double order,
                                   Target target) {
  const LoopResponse response(loop);
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
  std::vector<const synchronous::BlockConfig*> acting;
  for (const synchronous::BlockConfig& block : control.blocks) {
    BlockJudgement& judged = made.blocks.emplace_back();
    judged.acts = ActsAt(block, speed_rad_per_s);
    if (!judged.acts) continue;
    acting.push_back(&block);
    const Eigen::MatrixXcd product =
        MatrixOf(synchronous::InverseAt(block, speed_rad_per_s), axes) *
        SynchronousAnswer(loop, speed_rad_per_s, block.order, block.target);
    const Eigen::VectorXcd values = WithConjugates(product);
    judged.slowest_decay = values.real().minCoeff();
    judged.largest_eigenvalue = values.cwiseAbs().maxCoeff();
  }
  const WholeLaw law = WholeOf(loop);
  made.largest_pole_modulus_without = LargestModulus(LoopWithBlocks(loop, law, {}).Matrix({}, 0.0));
  made.largest_pole_modulus =
      acting.empty()
          ? made.largest_pole_modulus_without
          : LargestModulus(LoopWithBlocks(loop, law, acting).Matrix(acting, speed_rad_per_s));
  return made;
}

std::vector<double> JudgedSpeeds(const synchronous::SynchronousConfig& control, std::size_t count) {
  std::vector<double> speeds;
  for (const synchronous::BlockConfig& block : control.blocks) {
    const double low = std::max(0.0, block.from_rad_per_s - block.hysteresis_rad_per_s);
    const double high = block.to_rad_per_s + block.hysteresis_rad_per_s;
    for (std::size_t i = 0; i < count; ++i) {
      const double share =
          count < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(count - 1);
      speeds.push_back(low + share * (high - low));
    }
    for (const auto& at : block.inverse) {
      if (at.speed_rad_per_s >= low && at.speed_rad_per_s <= high) {
        speeds.push_back(at.speed_rad_per_s);
      }
    }
  }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  return speeds;
}

}  // namespace levitas::analysis
