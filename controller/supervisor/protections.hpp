#pragma once
// The protections: each cycle's observation in, the first fault found out.
//
// Rules      one member function per protection, listed with its limit in docs/safety.md.
// Priority   faults of the signals before faults of the motion, since the latter are computed
//            from the former.
// Counters   run in every state, so that arming a protection never starts from stale evidence,
//            except those of orbit, saturation, amplifier answer and held currents, which mean
//            something only while energised. Orbit and contact count periods: while frames are
//            missing, or cycles were skipped, the rotor counts as being where it was seen last.
// Thread     loop thread only; Check allocates nothing, throws nothing.
// Failure    the constructor throws std::invalid_argument for a limit that cannot work (zero,
//            negative, not finite): a protection is never switched off by leaving it out.
// Not done   no reaction: see mode_table.hpp.

#include <cstdint>

#include "common/rig_numbers.hpp"
#include "controller/supervisor/event_window.hpp"
#include "controller/supervisor/mode_table.hpp"
#include "controller/supervisor/observation.hpp"
#include "controller/supervisor/supervisor_config.hpp"

namespace levitas::supervisor {

/// A rig that was told to energise must report it within this many cycles.
inline constexpr std::uint32_t kAmplifierAnswerCycles = 50;

/// No law holds a rotor by fewer frames than 3 in 20: within 4 x frame_missing_cycles so many
/// missing ones count as a line that is cut. (Half of the frames, drawn at random, nearly hold it.)
inline constexpr double kCutShare = 0.85;

/// A rotor beyond the clearance for this long (time inside it counted back) runs on its touchdown
/// bearings: the magnets do not hold it any more.
inline constexpr double kContactS = 0.02;

class Protections {
 public:
  Protections(const RigNumbers& rig, const ProtectionConfig& config);

  /// What a cycle brings beside the observation.
  struct Circumstances {
    FaultSet armed{};         ///< faults that are looked for
    bool energised{};         ///< the amplifiers were commanded on in the previous cycle
    bool stop_requested{};    ///< the operator's emergency stop
    AxisArray reference_m{};  ///< where the law held the rotor in the previous cycle
    Finding speed{};          ///< what SpeedWatch found
  };
  /// Updates all counters, then returns the first of the armed faults.
  [[nodiscard]] Finding Check(const Observation& seen, const Circumstances& now) noexcept;

  /// During a levitated stop: the rotor runs on its touchdown bearings although the law is on.
  [[nodiscard]] Finding Contact(const Observation& seen) const noexcept;
  /// A new rig session is accepted from here on.
  void AcceptSession(std::uint32_t rig_session) noexcept;
  /// False until the first session was accepted: the rig has not been heard yet.
  [[nodiscard]] bool session_known() const noexcept { return session_known_; }
  [[nodiscard]] bool Knows(std::uint32_t rig_session) const noexcept {
    return session_known_ && session_ == rig_session;
  }
  /// The signals of this cycle are good: fresh, finite, in range, moving, no fault bit.
  [[nodiscard]] bool SignalsGood(const Observation& seen) const noexcept;

 private:
  void Count(const Observation& seen, const Circumstances& now) noexcept;
  void CountTransport(const Observation& seen, bool energised) noexcept;
  void CountMotion(const Observation& seen, const Circumstances& now) noexcept;
  [[nodiscard]] Finding FindSignalFault(const Observation& seen, FaultSet armed) const noexcept;
  [[nodiscard]] Finding FindMotionFault(const Observation& seen,
                                        const Circumstances& now) const noexcept;
  [[nodiscard]] Finding NotFinite(const Observation& seen) const noexcept;
  [[nodiscard]] Finding OutOfRange(const Observation& seen) const noexcept;
  [[nodiscard]] Finding Frozen() const noexcept;
  [[nodiscard]] Finding AmplifierFault(const Observation& seen) const noexcept;
  [[nodiscard]] Finding FrameMissing(const Observation& seen) const noexcept;
  [[nodiscard]] Finding Orbit(const Observation& seen, const AxisArray& reference_m) const noexcept;
  [[nodiscard]] Finding OrbitFinding(const AxisArray& from_m, std::size_t bearing,
                                     double limit_m) const noexcept;
  [[nodiscard]] Finding Saturated() const noexcept;

  std::size_t axes_{};
  ProtectionConfig config_;
  AxisArray orbit_limit_m_{};  // per bearing
  AxisArray range_limit_m_{};  // per axis
  double speed_limit_rad_per_s_{};
  AxisArray clearance_m_{};  // per bearing
  double period_s_{};
  std::uint64_t contact_limit_cycles_{};
  std::uint32_t saturated_limit_cycles_{};

  std::array<std::uint32_t, kMaxAxes> out_of_range_{};
  std::array<std::uint32_t, kMaxAxes> unchanged_{};
  std::array<std::uint32_t, kMaxAxes> saturated_{};
  struct Counted {  // of a bearing
    bool beyond{};  // as seen last
    std::uint64_t periods{};
  };
  static void CountBack(Counted& counted, std::uint64_t periods, std::uint64_t most) noexcept;

  std::array<Counted, kMaxAxes> orbit_{};    // beyond the orbit's limit, from the reference
  std::array<Counted, kMaxAxes> contact_{};  // beyond the clearance, from the centre
  AxisArray last_position_m_{};
  bool has_position_{};
  std::uint32_t frames_missing_{};
  std::uint32_t amplifiers_silent_{};
  std::uint32_t session_{};
  bool session_known_{false};
  std::uint32_t held_before_{};   // the rig's count in the latest frame ...
  std::uint32_t held_session_{};  // ... and its session
  EventWindow deadlines_;
  EventWindow lost_;
  EventWindow cut_;
  EventWindow late_;
};

}  // namespace levitas::supervisor
