// What a trip tells a person; one table row per fault.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/rotational_speed.hpp"
#include "session/log/event_deriver.hpp"

namespace levitas::session {
namespace {

/// How value and limit of a fault are shown: SI value x factor, in `unit`; none without a unit.
struct Row {
  const char* cause;
  double factor;
  const char* unit;
};

constexpr double kStandingRadPerS = 1.0;  // [rad/s] below, nobody says that it runs down
constexpr double kMicro = 1e6;
constexpr double kRpmPerRadPerS = RadPerSToRpm(1.0);

constexpr std::array<Row, kFaultCount> kRows{{
    {"no fault", 1.0, nullptr},
    {"the orbit is too large", kMicro, "um"},
    {"the position sensor is out of its range", kMicro, "um"},
    {"the position sensor is frozen", 1.0, "equal readings"},
    {"the position sensor gives no number", 1.0, nullptr},
    {"sensor frames are missing", 1.0, "cycles"},
    {"too many deadlines were missed", 1.0, "periods"},
    {"the coil current is at its limit for too long", 1.0, "s"},
    {"the rotor is too fast", kRpmPerRadPerS, "rpm"},
    {"emergency stop", 1.0, nullptr},
    {"the rig restarted", 1.0, nullptr},
    {"an amplifier reports a fault", 1.0, nullptr},
    {"the self-test failed", kMicro, "um"},
    {"the rotor did not reach the centre in time", kMicro, "um"},
    {"the speed is not known", 1.0, nullptr},
    {"the control law gives no number", 1.0, nullptr},
    {"too many sensor frames were lost", 1.0, "cycles"},
    {"too many currents came late, the rig held the last ones", 1.0, "periods"},
}};

constexpr const char* kLateRemedy =
    " If the rig sent in time, this machine was late: amb doctor names what keeps it from real "
    "time.";

std::string Where(const cycle::CycleOutputs& out, const std::vector<std::string>& channels) {
  if (out.fault_axis < 0) return {};
  const auto axis = static_cast<std::size_t>(out.fault_axis);
  if (axis >= channels.size()) return fmt::format(" on axis {}", axis);
  return fmt::format(" on {}", channels[axis]);
}

/// Why a lift was given up, with the figures of its last tenth of a second, and what helps; empty
/// where the rotor was levitated already.
std::string LiftReasonText(const cycle::CycleOutputs& out, const LiftWatch& lift) {
  const auto axis = static_cast<std::size_t>(std::max<int>(out.fault_axis, 0));
  const double sag_um = lift.SagOf(axis) * kMicro;
  const double radius_um = out.fault_limit * kMicro;
  const bool at_limit = out.fault == Fault::kCoilSaturated;
  switch (at_limit ? lift.ReasonOfLimit(axis) : lift.ReasonOf(axis, out.fault_limit)) {
    case LiftReason::kUnknown:
      return {};
    case LiftReason::kAtLimit:
      return fmt::format(
          " The control current is at its limit and the rotor stays {:.4g} um off the centre: the "
          "load is more than the magnets lift from there, or a probe or a coil is the wrong way "
          "round.",
          sag_um);
    case LiftReason::kLimitToLimit:
      return fmt::format(
          " The control current goes from one limit to the other and the rotor swings about a "
          "place {:.4g} um off the centre: the loop is unstable. amb poles names the pole that "
          "grows; raise kd, or let amb design pid make a law.",
          sag_um);
    case LiftReason::kSags:
      return fmt::format(
          " It sags: from where it lay, {:.4g} um off the centre, it came to {:.4g} um, the settle "
          "radius is {:.4g} um; the control current was {:.3g} A, below its limit. Raise ki "
          "(without it the law carries the load with stiffness alone) or kp, or lift_timeout_s for "
          "an integrator that is slow{}.",
          lift.StartOf(axis) * kMicro, sag_um, radius_um, lift.CurrentOf(axis),
          sag_um < 0.5 * lift.StartOf(axis) * kMicro
              ? "; if it may hang there, raise settle_radius_um"
              : "");
    case LiftReason::kSwings:
      return fmt::format(
          " It does not sag (its mean place is {:.4g} um off the centre, the settle radius {:.4g} "
          "um) but swings: it never stayed inside for lift_settle_s. Raise kd or settle_radius_um, "
          "or lower the noise of the probes; amb poles names the least damped mode.",
          sag_um, radius_um);
  }
  return {};
}

/// The safe state as the outputs of the tripping cycle command it (docs/safety.md).
const char* SafeState(const CurrentFrame& current, double speed_rad_per_s) {
  if (!current.amplifiers_enabled) {
    return std::abs(speed_rad_per_s) < kStandingRadPerS
               ? "The coils are switched off and the rotor lies in the touchdown bearings."
               : "The coils are switched off and the rotor runs down in the touchdown bearings.";
  }
  return current.drive_enabled
             ? "The rotor stays levitated while the drive brakes it; at standstill it is lowered "
               "into the touchdown bearings."
             : "The rotor stays levitated and is lowered into the touchdown bearings.";
}

}  // namespace

std::string TripText(const cycle::CycleRecord& record, const std::vector<std::string>& channels,
                     const LiftWatch* lift) {
  const auto index = static_cast<std::size_t>(record.out.fault);
  Row row = index < kRows.size() ? kRows[index] : Row{"unknown fault", 1.0, nullptr};
  // Without an axis the self-test failed because the rotor turns.
  if (record.out.fault == Fault::kSelfTestFailed && record.out.fault_axis < 0) {
    row = {"the self-test failed: the rotor turns", kRpmPerRadPerS, "rpm"};
  }
  // With figures it is not a report of the rig: what was read, and what can have been.
  if (record.out.fault == Fault::kSpeedUnknown && record.out.fault_limit != 0.0) {
    row = {"the speed is not known: what is read contradicts what the drive can do", kRpmPerRadPerS,
           "rpm"};
  }
  // With a limit it is not a report of the rig but the lack of one.
  if (record.out.fault == Fault::kAmplifierFault && record.out.fault_limit > 0.0) {
    row = {"the amplifiers do not report that they are on", 1.0, "cycles in a row"};
  }
  std::string numbers;
  if (row.unit != nullptr) {
    numbers = fmt::format(": {:.4g} {}, allowed {:.4g} {}", record.out.fault_value * row.factor,
                          row.unit, record.out.fault_limit * row.factor, row.unit);
  }
  const Fault fault = record.out.fault;
  const bool may_be_of_a_lift = fault == Fault::kLiftFailed || fault == Fault::kCoilSaturated;
  const std::string reason =
      may_be_of_a_lift && lift != nullptr ? LiftReasonText(record.out, *lift) : std::string{};
  const bool of_time = fault == Fault::kFrameMissing || fault == Fault::kDeadlineMissed ||
                       fault == Fault::kFramesLost || fault == Fault::kCurrentsLate;
  return fmt::format(
      "TRIP {} in cycle {}: {}{}{}.{} {}{} When it stands and the cause is "
      "gone, give the command reset.",
      Name(record.out.fault), record.in.cycle, row.cause, Where(record.out, channels), numbers,
      reason, SafeState(record.out.current, record.in.frame.speed_rad_per_s),
      of_time ? kLateRemedy : "");
}

}  // namespace levitas::session
