#include "plant_sim/loop/timed_events.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::plant_run {
namespace {

std::vector<std::string> EffectIds(const plant::PlantConfig& rig) {
  std::vector<std::string> ids;
  ids.reserve(rig.effects.size());
  for (const auto& entry : rig.effects) ids.emplace_back(effect::At(entry.id).name);
  return ids;
}

std::vector<double> Strengths(const plant::PlantConfig& rig) {
  std::vector<double> strengths;
  strengths.reserve(rig.effects.size());
  for (const auto& entry : rig.effects) strengths.push_back(entry.strength);
  return strengths;
}

// Those of PlantModel::train().inertias, in the same order.
std::vector<std::string> InertiasOf(const plant::PlantConfig& rig) {
  std::vector<std::string> names;
  for (const auto& shaft : rig.shafts) {
    if (shaft.torsion.kind != rotor::TorsionKind::kInertias) continue;
    for (const auto& inertia : shaft.torsion.inertias) names.push_back(inertia.name);
  }
  return names;
}

events::TorqueSchedule TorquesOf(const scenario::ScenarioConfig& scenario,
                                 const RigNumbers& numbers, const plant::PlantConfig& rig) {
  try {
    return {scenario.rig_events, InertiasOf(rig), numbers.period_s()};
  } catch (const std::invalid_argument& problem) {
    throw BadInput(fmt::format("scenario {} with rig {}: rig_events: {}", scenario.name,
                               numbers.name, problem.what()));
  }
}

// A mistake of the files, not of the program, so it is said as such.
const scenario::ScenarioConfig& Checked(const scenario::ScenarioConfig& scenario,
                                        const RigNumbers& numbers, const plant::PlantConfig& rig) {
  const std::vector<std::string> ids = EffectIds(rig);
  for (const levitas::ScheduledRigEvent& event : scenario.rig_events) {
    if (event.kind != levitas::RigEventKind::kEffect) continue;
    if (std::find(ids.begin(), ids.end(), event.effect) != ids.end()) continue;
    throw BadInput(
        fmt::format("scenario {} changes the effect {}, which rig {} does not list under effects",
                    scenario.name, event.effect, numbers.name));
  }
  return scenario;
}

}  // namespace

TimedEvents::TimedEvents(const scenario::ScenarioConfig& scenario, const RigNumbers& numbers,
                         const plant::PlantConfig& rig)
    : faults_(Checked(scenario, numbers, rig).rig_events, numbers.period_s()),
      changes_(scenario.rig_events, EffectIds(rig), Strengths(rig), numbers.period_s()),
      torques_(TorquesOf(scenario, numbers, rig)) {}

void TimedEvents::Prepare(plant::Plant& plant) const {
  if (!changes_.empty()) plant.AllowEffectChanges();
  if (!torques_.empty()) plant.AllowTorques();
}

void TimedEvents::Answered(std::uint64_t cycle) noexcept {
  if (!started_) start_cycle_ = cycle;
  started_ = true;
}

void TimedEvents::Disturb(std::uint64_t cycle, SensorFrame& frame) noexcept {
  faults_.Disturb(started_ ? cycle - start_cycle_ : 0, frame);
}

void TimedEvents::Change(std::uint64_t cycle, plant::Plant& plant) noexcept {
  if (!started_) return;
  torques_.Apply(cycle - start_cycle_, [&plant](std::size_t index, double torque_n_m) {
    (void)plant.SetTorque(index, torque_n_m);  // both were checked
  });
  if (changes_.empty()) return;
  changes_.Apply(cycle - start_cycle_, [&plant](std::size_t index, double strength) {
    (void)plant.SetEffectStrength(index, strength);  // index and strength were checked
  });
}

}  // namespace levitas::plant_run
