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
// Orbit      with AngleSource::kOrbit the speed is the rig's times 1 + s, and the orbit says once a
//            turn how far the rotor is ahead (orbit_slip.hpp): angle and s take 1 - p^2 and
//            (1 - p)^2 of it, both poles at p = 0.8 a turn, or slower (FollowWithin). Good after
//            kOrbitTurns in a row that end close to a forward orbit that is large enough; lost by
//            one below kLeastKeptShare of that (a block makes it smaller) or by kGoodTurns that
//            do not end for missing frames; else jumped by an error or an s beyond what is
//            allowed. s begins at zero after each. Lag: that of the rig's speed.
// Coasts     where a block changes the orbit, or acts while the speed changes by more than
//            kSteadyShare and the orbit's phase with it, the angle goes on at the rig's speed times
//            1 + s, unmended and unjudged. What is left is followed from then on, slowly: an angle
//            that moves makes the block lag, which moves the orbit by more than the angle where
//            the block leaves little of it.
// Not done   no angle from nothing: without a speed of the rig no block acts.

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "common/axes.hpp"
#include "controller/synchronous/orbit_slip.hpp"
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
  static constexpr double kOrbitTurns = 30.0;
  static constexpr double kLeastKeptShare = 0.25;
  static constexpr double kSteadyShare = 0.005;
  static constexpr double kSilentTurns = 0.5;

  AngleFollower(const AngleConfig& config, double period_s, std::size_t axes = 0) noexcept;

  /// `position_m`: of a fresh frame; read with AngleSource::kOrbit.
  void Update(const AngleReading& reading, const AxisArray& position_m = {}) noexcept;

  /// With AngleSource::kOrbit: from now on for so long, at least, what the orbit does is a block's
  /// doing.
  void Coast(double time_s) noexcept { coast_s_ = std::max(coast_s_, time_s); }
  /// The orbit is followed with this time constant, for a block acts that must stay faster. Zero:
  /// none acts.
  void FollowWithin(double time_s) noexcept { follow_s_ = time_s; }

  [[nodiscard]] bool good() const noexcept { return good_turns_ >= needed_turns_; }
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
  void FollowAngle(const AngleReading& reading, double step_turns) noexcept;
  [[nodiscard]] double OrbitPole() const noexcept;
  [[nodiscard]] AngleTrouble JudgeTurn(const OrbitTurn& turn) const noexcept;
  void FollowOrbit(const AngleReading& reading, double step_turns,
                   const AxisArray& position_m) noexcept;

  AngleSource source_;
  double period_s_;
  double largest_error_turns_;
  double largest_orbit_error_turns_;  ///< as OrbitTurn counts it
  double largest_speed_share_;
  double least_followed_m_;
  double angle_gain_, speed_gain_;
  Angle followed_, flywheel_;
  OrbitSlip orbit_;
  double slip_{};  ///< of kOrbit: followed speed over the rig's, less one
  double needed_turns_;
  double coast_s_{}, follow_s_{};
  double reference_speed_rad_per_s_{};  ///< the rig's, as what is followed began
  double unended_turns_{};
  bool begun_{};
  double good_turns_{};
  double silent_turns_{};
  AngleTrouble trouble_{AngleTrouble::kNone};
};

}  // namespace levitas::synchronous
