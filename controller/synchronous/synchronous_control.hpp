#pragma once
// Synchronous control of all axes: run-out taken off, notches in and out of their speeds, and what
// ends them.
//
// Order      in a cycle: the angle is judged; blocks begin or end; run-outs are subtracted; what
//            kCurrent blocks hold is taken out of the error; all blocks adapt to that error; what
//            kVibration blocks hold is added to the current.
// Begins     where the rotor is levitated about its centre, the angle is good, and the speed is
//            positive and within the block's window. A block begins with nothing: no step.
// Ends       speed beyond window and hysteresis: fades over its time constant, a second at most.
//            Angle lost or jumped, an axis saturated (a fifth of the time is enough), orbit grown
//            (below what the supervisor trips at), current too large, levitation given up, also
//            while it fades already: fades within half a turn (and 0.2 s at most), in step with the
//            angle's flywheel.
// Again      after a fade of the speed, of a measured angle or of the levitation when the
//            conditions hold again; after any other end not before the speed has left the window.
//            A block that corrects its T may begin kRetries times more after its orbit grew, with
//            what it has learned from that; so may one whose angle is estimated from the orbit and
//            was lost or jumped.
// Empty      without run-outs and blocks Step does nothing: the loop's bits are those without it.
// Frame      bearing frame; units SI.
// Thread     construction allocates; Step allocates nothing, throws nothing, takes bounded time.
// Failure    the constructor throws std::invalid_argument for a table that cannot be.
// Not done   no proof that a block is stable (amb design notch, amb margins); speeds below zero:
//            blocks act in the sense x to y only.

#include <array>
#include <cstdint>
#include <vector>

#include "common/rig_numbers.hpp"
#include "controller/synchronous/angle_follower.hpp"
#include "controller/synchronous/block_status.hpp"
#include "controller/synchronous/generalised_notch.hpp"
#include "controller/synchronous/influence_estimate.hpp"
#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::synchronous {

struct Conditions {
  AngleReading angle;
  double believed_speed_rad_per_s{};  ///< its size, by the supervisor
  bool levitated{};                   ///< about the centre, not in a trip
  std::uint16_t saturated_axes{};     ///< of the previous cycle
  AxisArray position_m{};             ///< as read
};

class SynchronousControl {
 public:
  static constexpr int kRetries = 3;

  /// `orbit_trip_fraction`: of the clearance; the supervisor trips there, a block gives way below.
  SynchronousControl(const SynchronousConfig& config, const RigNumbers& rig,
                     double orbit_trip_fraction = 0.5);

  /// The law starts from rest: so do the blocks.
  void Reset() noexcept;
  /// Changes what the law reads and what is added to its current.
  void Step(const Conditions& seen, AxisArray& error_m, AxisArray& added_a) noexcept;
  /// A cycle in which the law does not step (no frame, or no current).
  void Wait(const Conditions& seen) noexcept;

  [[nodiscard]] bool empty() const noexcept { return blocks_.empty() && run_outs_.empty(); }
  [[nodiscard]] std::size_t blocks() const noexcept { return blocks_.size(); }
  /// What a block that corrects its T has learned.
  [[nodiscard]] const InfluenceEstimate& influence(std::size_t block) const noexcept {
    return blocks_[block].influence;
  }
  [[nodiscard]] const BlockStatus& status(std::size_t block) const noexcept {
    return blocks_[block].status;
  }

 private:
  struct Block {
    Block(const BlockConfig& config, std::size_t axes, double period_s);
    /// Whether the speed is beyond the window and its hysteresis.
    [[nodiscard]] bool Left(double speed_rad_per_s) const noexcept {
      return !(speed_rad_per_s >= from - hysteresis && speed_rad_per_s <= to + hysteresis);
    }
    InverseLadder inverse;
    double order;
    Target target;
    double time_constant_s;
    double rate;       ///< 2 T_s/tau
    double slow_fade;  ///< share per period
    double from, to, hysteresis;
    double largest_current_a;
    bool adaptive;
    InfluenceEstimate influence;
    NotchState state;
    BlockStatus status;
    double gain{};
    bool fast{};
    int retries{};              ///< after a failure, since the speed came into the window
    AxisArray orbit_limit_m{};  ///< per bearing, since it began
  };

  void Supervise(const Conditions& seen) noexcept;
  void CountSaturation(const Conditions& seen) noexcept;
  void FadeRunOut(bool wanted) noexcept;
  void PaceAngle() noexcept;
  [[nodiscard]] Ending Trouble(const Block& block, const Conditions& seen) const noexcept;
  [[nodiscard]] bool Calm(const Block& block) const noexcept;
  void Begin(Block& block) noexcept;
  void End(Block& block, Ending why) noexcept;
  void Fade(Block& block) noexcept;
  void WatchOrbit(const Conditions& seen) noexcept;

  std::size_t axes_;
  double period_s_;
  AngleFollower angle_;
  bool angle_estimated_;  ///< from the orbit, which the blocks change
  double orbit_growth_;
  AxisArray least_orbit_m_{};  // per bearing
  AxisArray most_orbit_m_{};   // per bearing, below the supervisor's
  double saturated_limit_cycles_;
  AxisArray saturated_{};     // per axis, cycles counted back
  AxisArray orbit_now_m_{};   // per bearing, of the turn that goes on
  AxisArray orbit_turn_m_{};  // of the last whole turn
  double turned_{};           // turns since that turn ended
  double run_out_gain_{};
  bool run_out_fades_{};  // to the end, before it comes again
  std::vector<RunOut> run_outs_;
  std::vector<Block> blocks_;
};

}  // namespace levitas::synchronous
