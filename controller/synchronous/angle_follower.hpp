#pragma once
// The rotor's angle as synchronous control uses it: followed, judged, and carried on by itself when
// the sensor fails.
//
// Equation   prediction  p = a + w dt;  error  e = wrap(measured - p);
//            a <- p + 2 b T e,  w <- w + b^2 T e,   b = 2 pi bandwidth: both poles of the follower
//            lie at exp(-b T) to first order.
// Lag        none at constant speed; under an acceleration A the followed angle stays A/b^2 behind
//            (1.2 degrees at 800 rpm/s and 10 Hz).
// Good       followed without a break for kGoodTurns turns. A break is: an error beyond the limit
//            (a jump; also an angle that stands still or comes late while the rotor turns), no
//            reading for half a turn, a rig that says its speed is unknown, a number that is none,
//            and a followed speed that differs from the rig's by more than the share allowed.
// Flywheel   from a break until it is good again `phase` goes on from the last prediction at the
//            last followed speed, so that what is being switched off stays in step meanwhile.
// Orders     an angle is counted in turns, whole ones apart, so that orders which are no whole
//            numbers (the other shaft of a gear) go on without a step from turn to turn.
// Thread     loop thread only; Update allocates nothing, throws nothing. Units: SI.
// Speed      with AngleSource::kSpeed the prediction at the rig's speed is the angle: nothing is
//            judged but whether frames and speed are there, and a turn begins anywhere.
// Not done   no angle from nothing: without a sensor of the angle no block acts.

#include <cstdint>

#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::synchronous {

struct AngleReading {
  bool fresh{};              ///< a new frame is there
  bool speed_unknown{};      ///< the rig says so
  double angle_rad{};        ///< 0 .. 2 pi
  double speed_rad_per_s{};  ///< as the rig reads it
  std::uint32_t periods{1};  ///< since the last Update
};

enum class AngleTrouble : std::uint8_t { kNone, kLost, kJumped };

class AngleFollower {
 public:
  static constexpr double kGoodTurns = 10.0;
  static constexpr double kSilentTurns = 0.5;

  AngleFollower(const AngleConfig& config, double period_s) noexcept;

  void Update(const AngleReading& reading) noexcept;

  [[nodiscard]] bool good() const noexcept { return good_turns_ >= kGoodTurns; }
  /// Of the latest Update.
  [[nodiscard]] AngleTrouble trouble() const noexcept { return trouble_; }
  /// Followed where it is good, else the flywheel's [turns].
  [[nodiscard]] double TurnsOf(double order) const noexcept;
  [[nodiscard]] double speed_rad_per_s() const noexcept {
    return good() ? followed_.speed_rad_per_s : flywheel_.speed_rad_per_s;
  }

 private:
  struct Angle {
    double whole{};   ///< turns, a whole number
    double within{};  ///< turns, 0 .. 1
    double speed_rad_per_s{};
    void Advance(double turns) noexcept;
  };
  void Begin(const AngleReading& reading) noexcept;
  void Break(AngleTrouble trouble) noexcept;

  AngleSource source_;
  double period_s_;
  double largest_error_turns_;
  double largest_speed_share_;
  double angle_gain_, speed_gain_;
  Angle followed_, flywheel_;
  bool begun_{};
  double good_turns_{};
  double silent_turns_{};
  AngleTrouble trouble_{AngleTrouble::kNone};
};

}  // namespace levitas::synchronous
