#pragma once
// The protections: each cycle's observation in, the first fault found out.
//
// Rules      one member function per protection, listed with its limit in docs/safety.md.
// Priority   faults of the signals before faults of the motion, since the latter are computed
//            from the former.
// Counters   run in every state, so that arming a protection never starts from stale evidence,
//            except saturation and the amplifier answer, which mean something only while energised.
// Thread     loop thread only; Check allocates nothing, throws nothing.
// Failure    the constructor throws std::invalid_argument for a limit that cannot work (zero,
//            negative, not finite): a protection is never switched off by leaving it out.
// Not done   no reaction: see mode_table.hpp.

#include <cstdint>
#include <vector>

#include "common/rig_numbers.hpp"
#include "controller/supervisor/mode_table.hpp"
#include "controller/supervisor/observation.hpp"
#include "controller/supervisor/supervisor_config.hpp"

namespace levitas::supervisor {

/// A rig that was told to energise must report it within this many cycles.
inline constexpr std::uint32_t kAmplifierAnswerCycles = 50;

/// A rotor beyond the clearance for this long (time inside it counted back) runs on its touchdown
/// bearings: the magnets do not hold it any more.
inline constexpr double kContactS = 0.02;

class Protections {
 public:
  Protections(const RigNumbers& rig, const ProtectionConfig& config);

  /// Updates all counters, then returns the first of the `armed` faults. `energised`: the
  /// amplifiers were commanded on in the previous cycle. `stop_requested`: the operator's emergency
  /// stop.
  [[nodiscard]] Finding Check(const Observation& seen, FaultSet armed, bool energised,
                              bool stop_requested) noexcept;

  /// During a levitated stop: the rotor runs on its touchdown bearings although the law is on.
  [[nodiscard]] Finding Contact(const Observation& seen) const noexcept;
  /// A new rig session is accepted from here on.
  void AcceptSession(std::uint32_t rig_session) noexcept;
  /// False until the first session was accepted: the rig has not been heard yet.
  [[nodiscard]] bool session_known() const noexcept { return session_known_; }
  /// The signals of this cycle are good: fresh, finite, in range, moving, no fault bit.
  [[nodiscard]] bool SignalsGood(const Observation& seen) const noexcept;

 private:
  void Count(const Observation& seen, bool energised) noexcept;
  [[nodiscard]] Finding FindSignalFault(const Observation& seen, FaultSet armed) const noexcept;
  [[nodiscard]] Finding FindMotionFault(const Observation& seen, FaultSet armed,
                                        bool stop_requested) const noexcept;
  [[nodiscard]] Finding NotFinite(const Observation& seen) const noexcept;
  [[nodiscard]] Finding OutOfRange(const Observation& seen) const noexcept;
  [[nodiscard]] Finding Frozen() const noexcept;
  [[nodiscard]] Finding AmplifierFault(const Observation& seen) const noexcept;
  [[nodiscard]] Finding Orbit(const Observation& seen) const noexcept;
  [[nodiscard]] Finding OrbitFinding(const Observation& seen, std::size_t bearing,
                                     double limit_m) const noexcept;
  [[nodiscard]] Finding DeadlineMissed(const Observation& seen) const noexcept;
  [[nodiscard]] Finding Saturated() const noexcept;
  [[nodiscard]] double Radius(const Observation& seen, std::size_t bearing) const noexcept;

  std::size_t axes_{};
  ProtectionConfig config_;
  AxisArray orbit_limit_m_{};  // per bearing
  AxisArray range_limit_m_{};  // per axis
  double speed_limit_rad_per_s_{};
  AxisArray clearance_m_{};  // per bearing
  double period_s_{};
  std::uint32_t contact_limit_cycles_{};
  std::uint32_t saturated_limit_cycles_{};

  std::array<std::uint32_t, kMaxAxes> out_of_range_{};
  std::array<std::uint32_t, kMaxAxes> unchanged_{};
  std::array<std::uint32_t, kMaxAxes> saturated_{};
  std::array<std::uint32_t, kMaxAxes> beyond_orbit_{};  // per bearing
  std::array<std::uint32_t, kMaxAxes> in_contact_{};    // per bearing
  AxisArray last_position_m_{};
  bool has_position_{};
  std::uint32_t frames_missing_{};
  std::uint32_t amplifiers_silent_{};
  std::uint32_t session_{};
  bool session_known_{false};
  // The cycles of the latest misses, as many as trip, oldest at next_miss_.
  std::vector<std::uint64_t> misses_;
  std::size_t next_miss_{};
  std::size_t miss_count_{};
};

}  // namespace levitas::supervisor
