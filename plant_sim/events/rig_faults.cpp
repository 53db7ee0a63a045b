#include "plant_sim/events/rig_faults.hpp"

#include <limits>
#include <stdexcept>

#include "plant_sim/events/cycle_at.hpp"

namespace levitas::events {

RigFaults::RigFaults(const std::vector<ScheduledRigEvent>& events, double period_s) {
  if (!(period_s > 0.0)) throw std::invalid_argument("rig faults: the period must be positive");
  faults_.reserve(events.size());
  for (const ScheduledRigEvent& event : events) {
    if (event.kind == RigEventKind::kEffect || event.kind == RigEventKind::kTorque) continue;
    if (event.axis >= kMaxAxes) throw std::invalid_argument("rig faults: no such axis");
    const std::uint64_t end = event.duration_s > 0.0
                                  ? CycleAt(event.at_s + event.duration_s, period_s)
                                  : std::numeric_limits<std::uint64_t>::max();
    faults_.push_back(
        {event.kind, CycleAt(event.at_s, period_s), end, event.axis, event.value_m, 0.0, false});
  }
}

void RigFaults::Disturb(std::uint64_t cycle, SensorFrame& frame) noexcept {
  for (Fault& fault : faults_) {
    double& reading_m = frame.position_m[fault.axis];
    if (cycle < fault.first || cycle >= fault.end) {
      fault.frozen = false;
      continue;
    }
    switch (fault.kind) {
      case RigEventKind::kSensorFrozen:
        if (!fault.frozen) fault.frozen_m = reading_m;
        fault.frozen = true;
        reading_m = fault.frozen_m;
        break;
      case RigEventKind::kSensorStuck:
        reading_m = fault.value_m;
        break;
      case RigEventKind::kSensorInvalid:
        reading_m = std::numeric_limits<double>::quiet_NaN();
        break;
      case RigEventKind::kSensorJump:
        reading_m += fault.value_m;
        break;
      case RigEventKind::kAmplifierFault:
        frame.rig_status |= kRigAmplifierFault;
        break;
      case RigEventKind::kEmergencyStop:
        frame.rig_status |= kRigEmergencyStop;
        break;
      case RigEventKind::kEffect:
      case RigEventKind::kTorque:
        break;
    }
  }
}

}  // namespace levitas::events
