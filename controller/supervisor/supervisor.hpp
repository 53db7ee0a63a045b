#pragma once
// The supervisor: runs the mode table on what is seen in each cycle.
//
// Order      in one cycle: a fault first; without one the operator's command; then what happened
//            by itself (self-test passed, lifted, stands, landed). Each takes at most one edge.
// Reference  moves along 3 p^2 - 2 p^3 (p = share of the ramp's time), so that it starts and ends
//            without a step in velocity; also on its way back from a landing that is given up.
// Landing    is given up when the rotor turns after all, or leaves the reference: it returns to the
//            centre under the brake, and contact counts as such only once it is there.
// Frame      bearing frame. Units: SI.
// Thread     loop thread only; Check and Decide allocate nothing and throw nothing.
// Failure    faults are latched in the decision; the constructor throws std::invalid_argument for
//            numbers that cannot work.
// Not done   no currents: the cycle runs the law with the decision's reference.

#include <cstdint>

#include "common/rig_numbers.hpp"
#include "controller/supervisor/mode_table.hpp"
#include "controller/supervisor/observation.hpp"
#include "controller/supervisor/protections.hpp"
#include "controller/supervisor/speed_watch.hpp"
#include "controller/supervisor/supervisor_config.hpp"

namespace levitas::supervisor {

/// During the self-test the rotor may read this many clearances from the centre: the sensor planes
/// lie outside the touchdown bearings, so a tilted rotor reads more than the clearance there.
inline constexpr double kRestingPlaceFactor = 1.25;

struct Request {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};
  double acceleration_rad_per_s2{};
};

struct Decision {
  State state{State::kOff};
  bool start_law{};  ///< clear the law's memory before this cycle's step
  AxisArray reference_m{};
  bool drive_enabled{};
  double speed_set_point_rad_per_s{};
  double acceleration_rad_per_s2{};
  bool command_refused{};
  bool standing{};  ///< proven that the rotor stands (SpeedWatch)
  bool turning{};   ///< must be taken to turn: above standstill as last believed, or unknown
  double believed_speed_rad_per_s{};  ///< its size (SpeedWatch::Estimate)
  Latch latch;
  Finding released;  ///< why the magnets let go; kNone: they did not, or as planned
};

class Supervisor {
 public:
  Supervisor(const RigNumbers& rig, const SupervisorConfig& config);

  /// The first armed fault of this cycle, if any. Call once per cycle, before Decide.
  [[nodiscard]] Finding Check(const Observation& seen, const Request& request) noexcept;
  /// Takes the edges of this cycle and says what the rig shall do.
  const Decision& Decide(const Observation& seen, const Request& request,
                         const Finding& finding) noexcept;

  /// A fault of this cycle that only the law's step brought to light, after Decide: the rig is
  /// released in the same cycle. Nothing changes in a state that does not look for it.
  const Decision& Drop(const Observation& seen, const Finding& finding) noexcept;

  [[nodiscard]] const Decision& decision() const noexcept { return decision_; }

 private:
  struct Times {
    std::uint64_t self_test, lift_ramp, lift_settle, lift_timeout, landing_ramp;  // [cycles]
  };

  [[nodiscard]] Finding SelfTest(const Observation& seen) noexcept;
  [[nodiscard]] Finding Lift(const Observation& seen) noexcept;
  [[nodiscard]] bool Happened(Event event, const Observation& seen) const noexcept;
  [[nodiscard]] bool Holds(Guard guard, const Observation& seen,
                           const Request& request) const noexcept;
  bool Take(Event event, const Observation& seen, const Request& request,
            const Finding& finding) noexcept;
  void Act(Action action, const Observation& seen, const Request& request,
           const Finding& finding) noexcept;
  void Enter(State state) noexcept;
  void MoveReference() noexcept;
  void CommandDrive(const Observation& seen) noexcept;
  [[nodiscard]] Finding SpeedFinding() const noexcept;
  /// Where the rotor is to be, the reference of the orbit's limit.
  [[nodiscard]] AxisArray Expected(const Observation& seen) const noexcept;
  [[nodiscard]] bool Returning() const noexcept;
  [[nodiscard]] Finding FarthestBearing(const Observation& seen,
                                        const AxisArray& limit_m) const noexcept;

  std::size_t axes_{};
  AxisArray resting_limit_m_{};  // per bearing, during the self-test
  AxisArray settle_limit_m_{};   // per bearing, during the lift: the same for all
  double max_speed_rad_per_s_{};
  double max_acceleration_rad_per_s2_{};
  SequenceConfig sequence_;
  std::uint32_t implausible_limit_cycles_{};
  Times times_{};
  Protections protections_;
  SpeedWatch speed_;

  Decision decision_;
  std::uint64_t cycles_in_state_{};
  std::uint32_t implausible_cycles_{};
  std::uint64_t near_centre_cycles_{};
  AxisArray rest_m_{};       // where the rotor lay before the lift
  AxisArray ramp_from_m_{};  // reference when the present ramp began
  double set_point_rad_per_s_{};
  double acceleration_rad_per_s2_{};
};

}  // namespace levitas::supervisor
