#pragma once
// What a scenario lets happen to the simulated rig, joined to the loop that drives it.
//
// Time     cycles since the first frame that a controller answered; before that nothing happens.
// Thread   the loop's; all but construction allocate nothing, lock nothing, throw nothing.
// Failure  the constructor throws BadInput for an effect that the rig file does not list, and for a
//          torque on an inertia that it does not have.

#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "controller/scenario/scenario_config.hpp"
#include "plant_sim/events/effect_schedule.hpp"
#include "plant_sim/events/rig_faults.hpp"
#include "plant_sim/events/torque_schedule.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::plant_run {

class TimedEvents {
 public:
  TimedEvents(const scenario::ScenarioConfig& scenario, const RigNumbers& numbers,
              const plant::PlantConfig& rig);

  /// Prepares the plant for changes of its effects and for torques; before the loop.
  void Prepare(plant::Plant& plant) const;
  /// The frame of this cycle was answered.
  void Answered(std::uint64_t cycle) noexcept;
  void Disturb(std::uint64_t cycle, SensorFrame& frame) noexcept;
  void Change(std::uint64_t cycle, plant::Plant& plant) noexcept;

 private:
  events::RigFaults faults_;
  events::EffectSchedule changes_;
  events::TorqueSchedule torques_;
  bool started_{false};
  std::uint64_t start_cycle_{0};
};

}  // namespace levitas::plant_run
