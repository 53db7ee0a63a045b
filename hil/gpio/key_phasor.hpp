#pragma once
// Speed and angle from the pulses of a key phasor, with a judgement of each pulse.
//
// Equations  mark spacing d = 2 pi / n. k marks in T seconds: mean speed k d / T, which under
//            constant acceleration is the speed at the middle of T; two intervals give
//              a = (w2 - w1) / ((T1 + T2) / 2),   speed at the pulse  w = w2 + a T2 / 2,
//            and between pulses  angle = angle_0 + w e + a e^2 / 2,  e the time since the pulse.
// Window     with |acceleration| <= A the next mark is passed between the roots of
//              w T + A T^2 / 2 = k d  and  w T - A T^2 / 2 = k d  (none: the rotor may stop before)
//            widened by the jitter of the time stamps. Earlier than k = 1: an extra pulse, not
//            believed. In the window of k > 1: k - 1 pulses are missing. Between: a jump.
// Unknown    each pulse not believed, each missing one adds 2 to a score, each good one takes 1
//            away; at kScoreLimit, or after kMaxMissing overdue marks, the speed is unknown and the
//            last good one is held. Four intervals in a row that agree among themselves lock it
//            anew.
// Units      rad, rad/s; time stamps in ns of CLOCK_MONOTONIC.
// Thread     one owner. No allocation, no failure.
// Not done   one mark tells no direction: rotation counts as positive. With n > 1 the angle counts
//            from the mark that came first.

#include <cstdint>
#include <optional>

#include "hil/gpio/line_config.hpp"

namespace levitas::gpio {

enum class SpeedState : std::uint8_t {
  kStanding,   ///< no mark for so long that the rotor stands
  kAcquiring,  ///< marks, but too few to judge the next
  kLocked,
  kUnknown,  ///< the pulses contradict what a rotor can do
};

struct SpeedReading {
  double speed_rad_per_s{};
  double angle_rad{};  ///< 0 <= angle < 2 pi
  SpeedState state{SpeedState::kStanding};
};

struct PulseCounters {
  std::uint64_t good{};
  std::uint64_t extra{};
  std::uint64_t missing{};
  std::uint64_t jumps{};
};

class KeyPhasor {
 public:
  static constexpr int kMaxMissing = 3;
  static constexpr int kScoreLimit = 6;
  static constexpr int kAgreeing = 4;                         ///< intervals that lock anew
  static constexpr double kStandingRadPerS = 0.05;            ///< below this the rotor stands
  static constexpr double kLeastAccelerationRadPerS2 = 1e-3;  ///< keeps the windows' roots finite

  explicit KeyPhasor(const KeyPhasorConfig& config) noexcept;

  void Pulse(std::int64_t time_ns) noexcept;
  /// `time_ns` must not lie before the newest pulse by more than some periods.
  [[nodiscard]] SpeedReading At(std::int64_t time_ns) noexcept;
  [[nodiscard]] const PulseCounters& counters() const noexcept { return counters_; }

 private:
  struct Window {
    double from_s{};
    double to_s{};  ///< infinite: the rotor may stop before the mark
  };
  enum class Verdict : std::uint8_t { kEarly, kFits, kJump };

  [[nodiscard]] Window WindowOf(int marks, double speed_rad_per_s,
                                double previous_s) const noexcept;
  [[nodiscard]] Verdict Judge(double interval_s, int& marks) const noexcept;
  [[nodiscard]] bool Agree(double first_s, double second_s) const noexcept;
  void FollowRaw(std::int64_t time_ns) noexcept;
  void Accept(std::int64_t time_ns, double interval_s, int marks) noexcept;
  void Doubt(int points) noexcept;
  void Lock(std::int64_t time_ns) noexcept;
  [[nodiscard]] SpeedReading Predicted(double elapsed_s) const noexcept;

  KeyPhasorConfig config_;
  double spacing_rad_;
  SpeedState state_{SpeedState::kStanding};
  std::int64_t last_ns_{};    // pulse that speed and angle refer to
  double speed_rad_per_s_{};  // at that pulse
  double acceleration_rad_per_s2_{};
  double mean_rad_per_s_{};  // over the last interval ...
  double interval_s_{};      // ... which was this long
  std::uint32_t mark_{};     // of that pulse, 0 .. n - 1
  int score_{};
  // Every pulse, believed or not.
  std::optional<std::int64_t> raw_ns_;
  double raw_before_s_{};
  double raw_last_s_{};
  int raw_agreeing_{};
  PulseCounters counters_;
};

}  // namespace levitas::gpio
