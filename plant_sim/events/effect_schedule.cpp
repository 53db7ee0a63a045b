#include "plant_sim/events/effect_schedule.hpp"

#include <stdexcept>

#include "plant_sim/events/cycle_at.hpp"

namespace levitas::events {

EffectSchedule::EffectSchedule(const std::vector<ScheduledRigEvent>& events,
                               const std::vector<std::string>& ids, std::vector<double> strengths,
                               double period_s)
    : strengths_(std::move(strengths)) {
  if (!(period_s > 0.0)) throw std::invalid_argument("effects: the period must be positive");
  strengths_.resize(ids.size(), 1.0);
  for (const ScheduledRigEvent& event : events) {
    if (event.kind != RigEventKind::kEffect) continue;
    bool found = false;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] != event.effect) continue;
      found = true;
      changes_.push_back({i, CycleAt(event.at_s, period_s), CycleAt(event.ramp_s, period_s), 0.0,
                          event.strength, false, false});
    }
    if (!found) {
      throw std::invalid_argument("the scenario changes the effect " + event.effect +
                                  ", which the rig file does not list under effects");
    }
  }
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const Change& a, const Change& b) { return a.first < b.first; });
}

}  // namespace levitas::events
