#pragma once
// The law that runs: rung, memory and, while laws of unlike structure change places, both of them.
//
// Rungs      as law_schedule.hpp says: within a stretch of alike laws one rung a period at most.
// Exchange   a law of another structure shares no memory with the one before. When the speed has
//            come to it, it listens first: for kListenS it runs beside on the same errors, and what
//            the acting current has more than its own is followed with a time constant of
//            kFollowS, so that noise and vibration do not enter. Then it acts, and the difference
//            (a static load that the law before carried) goes into the integrator of a PID, which
//            counts amperes; beside a law without one it goes on and fades with kFadeS, slowly
//            enough for the rotor to come to rest where this law holds it. A speed that goes back
//            by more than half of what takes an exchange back calls it off; one that goes on, or is
//            no number for a while, changes nothing. Below some 1500 rpm 20 ms are less than half a
//            turn, and the difference follows the vibration in part.
// Limit      the fading current is within the limit with the law's own, anti-windup included.
// Units      SI; bearing frame. Thread: loop thread only; construction allocates, the rest
//            allocates nothing, throws nothing, takes bounded time (two laws while one listens).
// Failure    std::invalid_argument of LawLadder and of LawState.
// Not done   the pair of laws is not proven stable while the speed passes: each is, at its speeds
//            (the gate of `amb design` runs the nonlinear rig through the exchange).

#include <cstddef>
#include <vector>

#include "controller/law/axis_law.hpp"
#include "controller/law/law_schedule.hpp"

namespace levitas::law {

inline constexpr double kListenS = 0.1;
inline constexpr double kFollowS = 0.02;
inline constexpr double kFadeS = 1.0;

class RunningLaw {
 public:
  /// The period is that of the configuration.
  explicit RunningLaw(const LawConfig& config);

  [[nodiscard]] std::size_t axes() const noexcept { return laws_[0].axes(); }
  [[nodiscard]] std::size_t rung() const noexcept { return rung_; }
  /// Which of the laws that change places acts, counted from rest.
  [[nodiscard]] std::size_t stretch() const noexcept { return laws_.Stretch(rung_); }
  /// From rest, with the law of this speed and empty memory.
  void Start(double speed_rad_per_s) noexcept;
  /// The law of this speed from now on, and the memory as it is: for a rig that is set turning
  /// without a run-up. Across an exchange the memory is empty, and the current of the period before
  /// goes on beside it and fades.
  void JumpTo(double speed_rad_per_s) noexcept;
  /// One period of the law that the speed asks for (law::Step). A speed that is no number leaves
  /// the law as it is.
  [[nodiscard]] LawOutput Step(double speed_rad_per_s, const AxisArray& error_m,
                               const AxisArray& excitation_a, double limit_a) noexcept;

 private:
  /// True where another law is to listen in this period.
  [[nodiscard]] bool Follow(double speed_rad_per_s) noexcept;
  void Listen(const AxisArray& error_m) noexcept;
  /// The law of this rung goes on with the current that it would not give by itself.
  void TakeOver(std::size_t rung, const AxisArray& more_a) noexcept;
  [[nodiscard]] LawState& Memory(std::size_t rung) noexcept {
    return memories_[laws_.Stretch(rung)];
  }

  LawLadder laws_;
  std::vector<LawState> memories_;  ///< of each stretch of alike laws
  std::size_t rung_{};
  std::size_t listening_{};       ///< rung of the law that listens
  std::size_t listened_{};        ///< periods; 0: none listens
  AxisArray beside_a_{};          ///< what is given beside the law's own current
  AxisArray difference_a_{};      ///< of the law that listens
  AxisArray given_a_{};           ///< in the period before, without test signals
  std::size_t listen_periods_{};  ///< of kListenS
  double follow_{}, fade_{};      ///< [1] a period
};

}  // namespace levitas::law
