#pragma once
// The sampled loop with synchronous control in it: what a block adapts to, and whether it may.
//
// Answer    of the error that the law reads to what a block gives, at z = e^{j n w T_s}:
//             kCurrent    E = -S (D + c),  S = (I + P C)^-1
//             kVibration  E = -S (D + P c)
//           so that T = S^-1, or (S P)^-1, lets every amplitude decay with the block's time
//           constant (docs/derivations.md eq. (N3), (N4)).
// Slow      condition for a slow block: every eigenvalue of T times the answer has a positive real
//           part. Re = 1: decays as its time constant says; 0.5: takes twice as long.
// Exact     eigenvalues of the whole sampled loop at that constant speed, two states per axis for
//           each block that acts there: holds for a fast block too, and for several together.
//           What T never moves (the other direction of a block for one) is no part of either.
// Frame     bearing frame; units SI: answer [1] or [m/A].
// Thread    any; pure. Failure: BadInput when the law's axes do not fit the plant's.
// Not done  changing speed, saturation: they are run (tests/loop/synchronous).

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "analysis/loop_response.hpp"
#include "analysis/sampled_loop.hpp"
#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::analysis {

[[nodiscard]] Eigen::MatrixXcd SynchronousAnswer(const LoopResponse& response,
                                                 double speed_rad_per_s, double order,
                                                 synchronous::Target target);

[[nodiscard]] Eigen::MatrixXcd MatrixOf(const synchronous::ComplexMatrix& matrix, std::size_t axes);
[[nodiscard]] synchronous::ComplexMatrix ComplexMatrixOf(const Eigen::MatrixXcd& matrix);

struct BlockJudgement {
  bool acts{};             ///< its window holds this speed
  double slowest_decay{};  ///< smallest real part of the eigenvalues of T times the answer
};

struct SynchronousJudgement {
  double speed_rad_per_s{};
  std::vector<BlockJudgement> blocks;
  double largest_pole_modulus{};  ///< of the loop with all blocks that act
  [[nodiscard]] bool stable() const noexcept;
};

/// Of the loop without any block.
[[nodiscard]] double LargestPoleModulus(const SampledLoop& loop);

/// Of A + j B and their conjugates.
[[nodiscard]] Eigen::VectorXcd EigenvaluesWithConjugates(const Eigen::MatrixXcd& matrix);

/// At one speed; `loop` closed at that speed.
[[nodiscard]] SynchronousJudgement JudgeSynchronous(const SampledLoop& loop,
                                                    const synchronous::SynchronousConfig& control,
                                                    double speed_rad_per_s);

enum class TableSpeeds : std::uint8_t { kIncluded, kLeftOut };

/// Speeds at which blocks are judged: `count` over each window, hysteresis included, and the speeds
/// of its table (they stand closely where T changes fast); ascending.
[[nodiscard]] std::vector<double> JudgedSpeeds(const synchronous::SynchronousConfig& control,
                                               std::size_t count,
                                               TableSpeeds table = TableSpeeds::kIncluded);

/// Why the blocks of a controller must not run with this rig: the first block that is not stable
/// somewhere, with its speeds. Empty: all are stable at the speeds judged, or there are none. A
/// speed at which the loop is unstable without any block is no block's fault.
[[nodiscard]] std::string UnstableBlocks(const plant::PlantConfig& plant, const law::LawConfig& law,
                                         const synchronous::SynchronousConfig& control);

}  // namespace levitas::analysis
