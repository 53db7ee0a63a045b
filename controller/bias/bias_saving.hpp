#pragma once
// Bias saving: a bias current that falls while little force is asked for, and control currents that
// keep the law's force at every bias.
//
// Equation   A magnet in differential driving mode has ki = 4 k i0/s0^2 and ks = 4 k i0^2/s0^3
//            (docs/derivations.md). At a bias b the law's current ic of the rig's bias i0 becomes
//              ib = (i0/b) ic + (i0^2 - b^2)/(b s0) x,
//            so that ki(b) ib + ks(b) x = ki(i0) ic + ks(i0) x: the loop of the linear model, its
//            gains and its negative stiffness, is the same at every bias, and a change of bias is
//            no step. x is what the law reads: reference less error.
// Falls      to b = sqrt(i0 w/share), w the peak of |ic| + (i0^2 - lowest^2)/(i0 s0) |x| over all
//            axes, forgotten over the lowering time: |ib| <= share b there.
// Rises      to the same at once, no faster than the raising time; to the whole bias before a
//            speed changes (set point and speed apart), where the rotor is not levitated about its
//            centre, while a test signal passes, where an axis is at its limit, and beyond the
//            orbit. Each of these counts as long as a peak does.
// Empty      without a lowest current nothing changes: the loop's bits are those without it.
// Frame      bearing frame; units SI.
// Thread     construction allocates nothing; Step neither, throws nothing, takes bounded time.
// Failure    the constructor throws std::invalid_argument for a rig without gaps (magnets with
//            another law of force, of which the equation does not hold), or a lowest current that
//            is not below the rig's bias.
// Not done   the delay of amplifiers and sampling acts on the part (i0^2 - b^2)/(b s0) x, which the
//            magnet gives without any: amb margins prints the loop over the bias.

#include <algorithm>
#include <cstdint>

#include "common/rig_numbers.hpp"
#include "controller/bias/bias_config.hpp"

namespace levitas::bias {

/// What decides about the bias in one cycle.
struct Conditions {
  bool levitated{};                ///< about the centre, not in a trip
  bool speed_changes{};            ///< the rotor is not at the speed that is asked for
  bool excited{};                  ///< a test signal passes: what it is answered is for one bias
  AxisArray position_m{};          ///< as read
  AxisArray reference_m{};         ///< of the law
  std::uint16_t saturated_axes{};  ///< of the previous cycle
};

/// Of the law's current and of the displacement at one bias: ib = current ic + displacement x.
struct Share {
  double current{1.0};
  double displacement_a_per_m{};
};

/// The equation above.
[[nodiscard]] Share ShareAt(double rig_bias_a, double bias_a, double gap_m) noexcept;

class BiasSaving {
 public:
  BiasSaving(const BiasConfig& config, const RigNumbers& rig);

  [[nodiscard]] bool empty() const noexcept { return config_.empty(); }
  /// The law starts from rest: with the whole bias.
  void Reset() noexcept;
  /// Moves the bias by one period for the law's currents of the previous one.
  void Step(const Conditions& seen, const AxisArray& law_current_a) noexcept;
  /// [A] law currents that the coils can follow at the present bias, the same for every axis.
  [[nodiscard]] double LimitOf(double limit_a, const AxisArray& read_m) const noexcept;
  /// The law's current as control current at the present bias. `read_m`: x.
  [[nodiscard]] AxisArray At(const AxisArray& law_current_a,
                             const AxisArray& read_m) const noexcept;
  [[nodiscard]] double current_a() const noexcept { return bias_a_; }
  /// [A] that a control current may have at the present bias, both coils within their range.
  [[nodiscard]] double room_a() const noexcept {
    return std::min(bias_a_, max_coil_current_a_ - bias_a_);
  }

 private:
  [[nodiscard]] bool Whole(const Conditions& seen) const noexcept;

  BiasConfig config_;
  std::size_t axes_;
  double rig_bias_a_;
  double max_coil_current_a_;
  double fall_a_{}, rise_a_{};  ///< per period
  double forget_{1.0};          ///< of a peak, per period
  AxisArray gap_m_{};           ///< per axis
  AxisArray pull_a_per_m_{};    ///< per axis: (i0^2 - lowest^2)/(i0 s0)
  AxisArray orbit_m_{};         ///< per bearing
  std::array<Share, kMaxAxes> share_{};
  double peak_a_{};
  double bias_a_;
};

}  // namespace levitas::bias
