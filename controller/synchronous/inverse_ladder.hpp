#pragma once
// T over speed as the loop reads it: a fixed number of matrices, made before the loop starts.
//
// Between   two speeds of the table every number lies on the straight line between its two values;
//           outside the nearest one holds.
// Rungs     kRungs matrices from the lowest to the highest speed of the block, hysteresis included;
//           the loop takes the nearest. T only says how fast and in which direction a block adapts,
//           so a change of rung changes no signal.
// Layout    [from][to], the targets side by side, so that loops over them become vector code.
// Thread    construction allocates and throws std::invalid_argument; At is pure.

#include <cstddef>
#include <vector>

#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::synchronous {

/// T transposed, real and imaginary parts apart.
struct InverseLanes {
  std::array<AxisArray, kMaxAxes> real{};       ///< [from][to]
  std::array<AxisArray, kMaxAxes> imaginary{};  ///< [from][to]
};

/// T of a block at a speed, as the table says it.
[[nodiscard]] ComplexMatrix InverseAt(const BlockConfig& block, double speed_rad_per_s);

/// Whether the window holds this speed, hysteresis included.
[[nodiscard]] bool ActsAt(const BlockConfig& block, double speed_rad_per_s) noexcept;

/// Whether both are of one order and act at some speed, hysteresis included.
[[nodiscard]] bool ShareWork(const BlockConfig& one, const BlockConfig& other) noexcept;

class InverseLadder {
 public:
  static constexpr std::size_t kRungs = 129;

  explicit InverseLadder(const BlockConfig& block);

  [[nodiscard]] const InverseLanes& At(double speed_rad_per_s) const noexcept;

 private:
  double lowest_rad_per_s_{};
  double per_width_{};  ///< rungs per rad/s
  std::vector<InverseLanes> rungs_;
};

}  // namespace levitas::synchronous
