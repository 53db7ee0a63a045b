#include "plant_sim/events/torque_schedule.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "plant_sim/events/cycle_at.hpp"

namespace levitas::events {
namespace {

constexpr std::uint64_t kForGood = std::numeric_limits<std::uint64_t>::max();

std::size_t IndexOf(const std::string& inertia, const std::vector<std::string>& inertias) {
  const auto found = std::find(inertias.begin(), inertias.end(), inertia);
  if (found == inertias.end()) {
    std::string names;
    for (const std::string& name : inertias) names += (names.empty() ? "" : ", ") + name;
    throw std::invalid_argument(
        names.empty()
            ? "no shaft of the rig has torsional inertias that a torque could act on"
            : "no torsional inertia of the rig is called " + inertia + "; there are " + names);
  }
  if (std::find(found + 1, inertias.end(), inertia) != inertias.end()) {
    throw std::invalid_argument("two torsional inertias of the rig are called " + inertia);
  }
  return static_cast<std::size_t>(found - inertias.begin());
}

}  // namespace

TorqueSchedule::TorqueSchedule(const std::vector<ScheduledRigEvent>& events,
                               const std::vector<std::string>& inertias, double period_s) {
  if (!(period_s > 0.0)) throw std::invalid_argument("torques: the period must be positive");
  for (const ScheduledRigEvent& event : events) {
    if (event.kind != RigEventKind::kTorque) continue;
    const std::size_t index = IndexOf(event.inertia, inertias);
    const std::uint64_t end =
        event.duration_s > 0.0 ? CycleAt(event.at_s + event.duration_s, period_s) : kForGood;
    torques_.push_back({index, CycleAt(event.at_s, period_s), end, CycleAt(event.ramp_s, period_s),
                        event.torque_n_m});
    const auto same = [index](const Inertia& inertia) { return inertia.index == index; };
    if (std::none_of(acted_on_.begin(), acted_on_.end(), same)) acted_on_.push_back({index, 0.0});
  }
}

// Within a duration shorter than the ramp it falls from what it has reached.
double TorqueSchedule::Torque::At(std::uint64_t cycle) const noexcept {
  if (cycle < first) return 0.0;
  const auto share = [this](std::uint64_t passed) {
    if (passed >= ramp_cycles) return 1.0;
    return static_cast<double>(passed) / static_cast<double>(ramp_cycles);
  };
  if (cycle < end) return torque_n_m * share(cycle - first);
  return torque_n_m * std::max(0.0, share(end - first) - share(cycle - end));
}

}  // namespace levitas::events
