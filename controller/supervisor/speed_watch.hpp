#pragma once
// The speed as far as it can be believed, and the proof that the rotor stands or turns.
//
// Believed   a reading is believed when the drive can have brought the rotor there since the last
//            believed one:  |w - w0| <= kMargin w_max + kRate a_max t,  t the time since then. (A
//            touchdown bearing can brake faster; its rotor then counts as turning for longer.)
// Glitch     a reading that contradicts the last believed one, or is no number, changes nothing
//            until such readings have lasted for kTurns turns at the believed speed (a key phasor
//            hears of a change once a turn), within kShortestS and kLongestS. A speed that had not
//            changed for long and rises within what the drive can do in that time is then believed:
//            the first pulses of a key phasor. Any other is unknown from then on.
// Unknown    until readings agree among themselves for standstill_s and lie above the lowest speed
//            that the rotor can have come down to: only the time under the brake counts, at its
//            rate divided by kBrakeMargin. A reading that is stuck at zero is believed when the
//            rotor must have come to rest.
// Stands     believed below standstill without interruption for standstill_s. Turns: believed at or
//            above it for kTurningS, or unknown.
// Time       counted in periods, those without a fresh frame and skipped ones included; of what is
//            proven (stands, turns, agrees) a gap between readings counts as 10 periods at most.
// Thread     loop thread only; Update allocates nothing, throws nothing. Units: SI.
// Not done   no judgement while the rig itself says that the speed is unknown: nothing is proven
//            then, and the last believed speed stays.

#include <cstdint>

#include "common/rig_numbers.hpp"
#include "controller/supervisor/observation.hpp"
#include "controller/supervisor/supervisor_config.hpp"

namespace levitas::supervisor {

class SpeedWatch {
 public:
  static constexpr double kMargin = 0.01;  ///< of the rated speed: noise and steps of a converter
  static constexpr double kRate = 2.0;     ///< times what the drive can do: load, friction, jitter
  static constexpr double kTurns = 1.5;
  static constexpr double kShortestS = 0.01;
  static constexpr double kLongestS = 0.2;
  static constexpr double kTurningS = 0.02;
  static constexpr double kBrakeMargin = 1.5;

  SpeedWatch(const RigNumbers& rig, const SequenceConfig& config);

  /// Once in each cycle. `brake_rad_per_s2`: the rate at which the drive was told to bring the
  /// rotor to rest in the previous cycle, 0 when it was not.
  void Update(const Observation& seen, double brake_rad_per_s2) noexcept;
  /// Another rig, or the same one started anew: nothing is known of its rotor.
  void Forget() noexcept;

  [[nodiscard]] bool stands() const noexcept {
    return known_ && !lost_ && standing_ >= standstill_cycles_;
  }
  [[nodiscard]] bool turns() const noexcept { return lost_ || turning_ >= turning_cycles_; }
  /// It must be taken to turn now, however short the evidence.
  [[nodiscard]] bool may_turn() const noexcept {
    return lost_ || (known_ && !(Magnitude() < standstill_rad_per_s_));
  }
  [[nodiscard]] bool unknown() const noexcept { return lost_; }
  [[nodiscard]] double Magnitude() const noexcept;
  /// Size of the speed for the law: the believed one; while unknown, that less what the brake took.
  [[nodiscard]] double Estimate() const noexcept { return lost_ ? lowest_rad_per_s_ : Magnitude(); }
  /// What contradicts: the reading (0 for what is no number) and the nearest one that can be.
  [[nodiscard]] Finding Contradiction() const noexcept;
  [[nodiscard]] double standstill_rad_per_s() const noexcept { return standstill_rad_per_s_; }

 private:
  [[nodiscard]] bool Near(double speed_rad_per_s, double from_rad_per_s,
                          std::uint64_t periods) const noexcept;
  [[nodiscard]] std::uint64_t WindowCycles() const noexcept;
  void Judge(double speed_rad_per_s, std::uint64_t since_fresh) noexcept;
  void Believe(double speed_rad_per_s, std::uint64_t since_fresh) noexcept;
  void Lose(double speed_rad_per_s) noexcept;
  void Regain(double speed_rad_per_s, std::uint64_t since_fresh) noexcept;

  double period_s_;
  double standstill_rad_per_s_;
  double margin_rad_per_s_;
  double rate_rad_per_s2_;
  double max_brake_rad_per_s2_;
  std::uint64_t standstill_cycles_;
  std::uint64_t turning_cycles_;

  bool known_{};
  bool lost_{};
  double believed_rad_per_s_{};
  std::uint64_t age_{};           // periods since a reading was believed
  std::uint64_t since_fresh_{};   // periods since a frame was fresh
  std::uint64_t unchanged_{};     // periods since the believed speed was another
  std::uint64_t contradicted_{};  // periods of readings that contradict
  std::uint64_t standing_{};
  std::uint64_t turning_{};
  // While unknown.
  double lowest_rad_per_s_{};     // the rotor cannot be slower
  double candidate_rad_per_s_{};  // the latest reading
  std::uint64_t agreeing_{};      // periods of readings that agree
  Finding contradiction_;
};

}  // namespace levitas::supervisor
