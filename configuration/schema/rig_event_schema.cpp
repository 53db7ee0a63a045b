// Table of what a scenario lets happen to the rig.
#include <array>

#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;

// In the order of RigEventKind.
constexpr std::array<std::string_view, 8> kEventKinds{
    "sensor_frozen",   "sensor_stuck",   "sensor_invalid", "sensor_jump",
    "amplifier_fault", "emergency_stop", "effect",         "torque"};

}  // namespace

void Describe(Visitor& v, ScheduledRigEvent& event, const RigNumbers& rig) {
  auto kind = static_cast<std::size_t>(event.kind);
  v.Choice({"what", kEventKinds, kRequired,
            "a fault, an effect of the rig file that changes, or a torque from outside"},
           kind);
  event.kind = static_cast<RigEventKind>(kind);
  const bool effect = event.kind == RigEventKind::kEffect;
  const bool torque = event.kind == RigEventKind::kTorque;
  const bool valued =
      event.kind == RigEventKind::kSensorStuck || event.kind == RigEventKind::kSensorJump;
  const bool sensor = valued || event.kind == RigEventKind::kSensorFrozen ||
                      event.kind == RigEventKind::kSensorInvalid;
  v.Number({"at", kSecond, 0, 1e6, kRequired, "from the first frame that is answered"}, event.at_s);
  v.When(!effect, "with a fault or a torque", [&] {
    v.Number({"duration", kSecond, 0, 1e6, 0, "of the fault or torque; 0: for good"},
             event.duration_s);
  });
  v.When(sensor, "with a fault of a sensor",
         [&] { DescribeChannel(v, rig, event.channel, event.axis); });
  v.When(valued, "with sensor_stuck or sensor_jump", [&] {
    v.Number({"value", kMicrometre, -20000, 20000, kRequired, "what it reads, or reads too much"},
             event.value_m);
  });
  v.When(effect, "with what: effect", [&] {
    v.Name({"effect", "id of an entry of the rig's effects"}, event.effect);
    v.Number({"strength", kOne, 0, 1, kRequired, "it goes to: 0 none, 1 as the rig file says"},
             event.strength);
  });
  v.When(torque, "with what: torque", [&] {
    v.Name({"inertia", "name of an inertia of a shaft's torsion"}, event.inertia);
    v.Number({"torque", kNewtonMetre, -1e9, 1e9, kRequired,
              "besides what acts already; positive in the sense in which the first shaft turns, so "
              "that a load on a driven shaft, which turns backwards, is positive"},
             event.torque_n_m);
  });
  v.When(effect || torque, "with what: effect or torque", [&] {
    v.Number({"ramp", kSecond, 0, 1e6, 0, "to get there, and of a torque back; 0: at once"},
             event.ramp_s);
  });
}

}  // namespace levitas::configuration
