#pragma once
// How far a rotor is ahead of its believed angle, from what of its orbit turns with it.
//
// Equation   c_b = mean over a turn of (x + j y)_b e^{-j theta}, bearing by bearing: what stands
//            still, turns backward, or is another whole order averages out (an order between
//            whole ones does not). Ahead by s/(2 pi)
//            turns, s the sine of arg sum_b c_b conj(r_b), where r_b takes a share of c_b once a
//            turn; by a quarter of a turn where that is more than a right angle. The sine, not the
//            angle, for the C library's arctangent has other bits on other machines.
// Phase      of no mark: the rotor's zero is where its orbit was as this began, and goes with the
//            orbit where that changes its phase slowly (a critical speed). What needs a mark, a
//            run-out or a balancing weight, cannot be had from it.
// Units      m, turns. Frame: bearing frame, forward is x to y.
// Thread     loop thread only; allocates nothing, throws nothing.
// Failure    a turn with a position that is no number has no orbit: forward_m is 0.
// Not done   the shafts of gears: all bearings are taken for the first shaft's. The vibration that
//            a block takes away cannot be followed meanwhile: the schema refuses that pair. A
//            thrust axis, one axis alone: ignored.

#include <array>
#include <cstddef>

#include "common/axes.hpp"
#include "common/unit_phasor.hpp"

namespace levitas::synchronous {

/// Orders so near the shaft's own that a block of it changes the orbit that is followed: turns of
/// the reference do not tell them apart.
[[nodiscard]] constexpr bool ChangesFollowedOrbit(double order) noexcept {
  return order > 0.95 && order < 1.05;
}

/// What a sample has brought: a turn that has ended, or nothing.
struct OrbitTurn {
  bool ended{};
  double forward_m{};    ///< amplitude of its forward orbit, largest bearing
  double ahead_turns{};  ///< -0.25 .. 0.25; 0 in the first turn
};

class OrbitSlip {
 public:
  explicit OrbitSlip(std::size_t axes) noexcept : bearings_(axes / 2) {}

  void Reset() noexcept;
  /// The turn that goes on has lost a sample: it begins anew, what is remembered stays.
  void DropTurn() noexcept;
  /// One sample; `phasor` of the believed angle, which has gone on by `step_turns` since the last.
  OrbitTurn Add(const AxisArray& position_m, const UnitPhasor& phasor, double step_turns,
                double reference_share) noexcept;

 private:
  struct Complex {
    double real{}, imaginary{};
  };
  using Orbits = std::array<Complex, kMaxAxes / 2>;
  OrbitTurn EndTurn(double reference_share) noexcept;

  std::size_t bearings_;
  Orbits sum_{};
  Orbits reference_{};  ///< of the turns before
  double turned_{};
  double samples_{};
  bool any_turn_{};
};

}  // namespace levitas::synchronous
