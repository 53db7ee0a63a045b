#pragma once
// A shipped rig, controller and scenario in one process, cycle by cycle.

#include <algorithm>
#include <functional>
#include <string>

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/scenario/scenario_player.hpp"
#include "controller/supervisor/supervisor.hpp"
#include "plant_sim/loop/timed_events.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::test {

struct ShippedLoop {
  ShippedLoop(const std::string& rig_name, const std::string& scenario_name)
      : rig(configuration::LoadRig(configuration::FindConfig(rig_name, "rigs"))),
        controller(configuration::LoadController(
            configuration::FindConfig(
                rig.run.controller.empty() ? "flexible_rotor_commissioned" : rig.run.controller,
                "controllers"),
            rig.numbers)),
        scenario(configuration::LoadScenario(configuration::FindConfig(scenario_name, "scenarios"),
                                             rig.numbers)) {}

  struct Most {
    double orbit_m{};
    double contact_n{};
    double speed_rad_per_s{};
    double excitation_a{};
    double excitation_m{};
    std::uint16_t saturated_axes{};
  };

  /// Plays the scenario to its end, at most `limit_s`; `watch` sees every record from lifted on.
  /// Returns what the player says at the end, empty when all went well.
  std::string Play(std::uint64_t seed, double limit_s,
                   const std::function<void(const cycle::CycleRecord&)>& watch = nullptr) {
    plant::Plant plant(rig.plant, seed);
    plant.RestInTouchdown();
    plant_run::TimedEvents events(scenario, rig.numbers, rig.plant);
    events.Prepare(plant);
    cycle::ControlCycle cycle({rig.numbers, controller.law, controller.supervisor,
                               controller.synchronous, controller.bias});
    scenario::ScenarioPlayer player(scenario, rig.numbers.period_s(),
                                    controller.supervisor.sequence.standstill_rad_per_s);
    cycle::CycleRecord record;
    const auto limit = static_cast<std::uint64_t>(limit_s / rig.numbers.period_s());
    while (!player.finished() && !player.failed() && record.in.cycle < limit) {
      ++record.in.cycle;
      record.in.frame = plant.Sample();
      events.Disturb(record.in.cycle, record.in.frame);
      record.in.frame_present = true;
      const auto asked = player.Next(record.out.mode, record.in.frame.speed_rad_per_s,
                                     record.out.fault, record.out.command_refused,
                                     Radius(record.in.frame), cycle.decision().standing);
      record.in.op = {asked.command, asked.speed_rad_per_s, asked.acceleration_rad_per_s2,
                      asked.excitation_a, asked.excitation_m};
      record.out = cycle.Step(record.in);
      events.Answered(record.in.cycle);
      Note(record, plant);
      if (watch && Free(record.out.mode)) watch(record);
      events.Change(record.in.cycle, plant);
      plant.Advance(plant::CommandOf(record.out.current));
    }
    return player.failed() ? player.Text() : player.finished() ? "" : "not finished";
  }

  static bool Free(Mode mode) { return mode == Mode::kLevitating || mode == Mode::kSpinning; }

  static double Radius(const SensorFrame& frame) {
    double largest_m = 0.0;
    for (std::size_t x = 0; x < frame.axes; x += 2) {
      largest_m = std::max(largest_m, std::hypot(frame.position_m[x], frame.position_m[x + 1]));
    }
    return largest_m;
  }

  void Note(const cycle::CycleRecord& record, const plant::Plant& plant) {
    if (!Free(record.out.mode)) return;
    most.orbit_m = std::max(most.orbit_m, Radius(record.in.frame));
    most.contact_n = std::max(most.contact_n, plant.ContactForce());
    most.speed_rad_per_s = std::max(most.speed_rad_per_s, record.in.frame.speed_rad_per_s);
    most.saturated_axes |= record.out.saturated_axes;
    for (std::size_t i = 0; i < kMaxAxes; ++i) {
      most.excitation_a = std::max(most.excitation_a, std::abs(record.in.op.excitation_a[i]));
      most.excitation_m = std::max(most.excitation_m, std::abs(record.in.op.excitation_m[i]));
    }
  }

  configuration::RigFile rig;
  configuration::ControllerFile controller;
  scenario::ScenarioConfig scenario;
  Most most;
};

}  // namespace levitas::test
