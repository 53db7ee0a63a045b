#pragma once
// Files in which every key of the tables appears.

#include "configuration/rig_file.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::configuration::test {

inline RigFile FullRig() {
  RigFile rig = LoadRig(FindConfig("flexible_rotor", "rigs"));
  rig.plant.rotor.rings.push_back({0.2, 0.01, 9.525e-3, 0.05, 7850.0});
  rig.plant.bearings[0].sensor.characteristic = {{-1e-4, -9e-5}, {0.0, 0.0}, {1e-4, 1.2e-4}};
  rig.lines.emergency_stop = gpio::LinePlace{"gpiochip0", 0, true, gpio::Bias::kInternal};
  rig.lines.amplifier_enable = gpio::LinePlace{"pinctrl-bcm2711", 17, true, gpio::Bias::kExternal};
  rig.lines.amplifier_fault = gpio::LinePlace{"/dev/gpiochip1", 2, false, gpio::Bias::kExternal};
  rig.lines.heartbeat = gpio::HeartbeatConfig{{"gpio-sim.0-node0", 3}, 7, 0.0125};
  rig.lines.key_phasor = gpio::KeyPhasorConfig{{"gpiochip0", 4}, 2, 0.0, 500.0, 1e-5};
  // One of each kind of place; AllEffects has them all, and costs the loops over tables more time.
  for (const effect::Id id :
       {effect::Id::kExtraDelay, effect::Id::kMagneticSaturation, effect::Id::kAxisRotation,
        effect::Id::kSensorRunout, effect::Id::kShaftBow, effect::Id::kMisalignment}) {
    rig.plant.effects.push_back(effect::ClearEntry(id));
  }
  return rig;
}

/// A shipped rig with every effect of the catalogue that it can have: one rotor's, or those of
/// gears.
inline RigFile AllEffects(bool of_gears = false) {
  RigFile rig = of_gears ? LoadRig(FindConfig("geared_rotor_4dof", "rigs")) : FullRig();
  rig.plant.effects.clear();
  for (const effect::Row& row : effect::EntryRows()) {
    if ((row.scope == effect::Scope::kGear) != of_gears) continue;
    rig.plant.effects.push_back(effect::ClearEntry(row.id, 100.0));
    // A damping ratio or a noise has another own value than a frequency.
    for (std::size_t k = 0; k < row.parameters.size(); ++k) {
      double& value = rig.plant.effects.back().values[k];
      if (value > row.parameters[k].high) value = row.parameters[k].high / 3.0;
    }
  }
  return rig;
}

inline ControllerFile FullController(const RigNumbers& rig) {
  ControllerFile controller = LoadController(FindConfig("flexible_rotor", "controllers"), rig);
  controller.bias = {0.25, 0.625, 0.125, 4.0, 0.008};
  return controller;
}

inline scenario::ScenarioConfig FullScenario(const RigNumbers& rig) {
  scenario::ScenarioConfig scenario = LoadScenario(FindConfig("default", "scenarios"), rig);
  scenario.steps[1].excitation = {{"de_x", 0, 0.05, 12, 2, 0.0}, {"nde_y", 3, 0.1, 15, 1, 0.25}};
  return scenario;
}

/// A rotor of given modes, and the state-space law that goes with it.
inline RigFile ModalRig() {
  RigFile rig = LoadRig(FindConfig("turbomolecular_pump", "rigs"));
  rig.plant.rotor.given->gyroscopic = {{1, 0, -0.05}};
  return rig;
}

inline ControllerFile StateSpaceController(const RigNumbers& rig) {
  return LoadController(FindConfig("turbomolecular_pump", "controllers"), rig);
}

/// Every kind of signal at both points, and every kind of event.
inline scenario::ScenarioConfig EventfulScenario(const RigNumbers& rig) {
  const std::string channel = rig.channels[1];
  std::string text = "kind: scenario\nname: eventful\nsteps:\n  - do: nothing\n    hold_s: 1\n";
  text += "    excitation:\n";
  const auto add = [&](const std::string& rest) {
    text += "      - {channel: " + channel + ", " + rest + "}\n";
  };
  add("amplitude_a: 0.1, order: 20");
  add("signal: paprbs, point: measured_position, amplitude_um: 3, low_share: 0.2, seed: 7");
  add("signal: stepped_sine, amplitude_ma: 50, from_hz: 3, to_hz: 400, dwell_s: 0.1");
  add("signal: chirp, amplitude_a: 0.1, from_hz: 3, to_hz: 400, repeat_s: 2, spacing: linear");
  add("signal: multisine, amplitude_a: 0.1, from_hz: 3, to_hz: 400, repeat_s: 0.5");
  add("signal: impulse, amplitude_a: 0.1, width_ms: 0.5, every_s: 0.1");
  text += "rig_events:\n";
  for (const char* what : {"sensor_frozen", "sensor_stuck, value_um: 30", "sensor_invalid",
                           "sensor_jump, value_um: -5"}) {
    text += "  - {at_s: 1.5, duration_s: 0.25, channel: " + channel + ", what: " + what + "}\n";
  }
  text += "  - {at_s: 2, what: amplifier_fault}\n  - {at_s: 3, what: emergency_stop}\n";
  text += "  - {at_s: 4, what: effect, effect: unbalance, strength: 0.5, ramp_s: 2}\n";
  text +=
      "  - {at_s: 5, what: torque, inertia: brake, torque_n_m: -2.5, duration_s: 3, ramp_s: 1}\n";
  return ParseScenario(text, "eventful.yaml", rig);
}

/// A controller with a run-out and blocks of both targets, every number of its own.
inline ControllerFile SynchronousController(const RigNumbers& rig) {
  ControllerFile controller = FullController(rig);
  synchronous::SynchronousConfig& control = controller.synchronous;
  control.angle.bandwidth_hz = 7.5;
  control.angle.largest_error_rad = 0.5;
  control.angle.largest_speed_share = 0.2;
  control.orbit_growth = 3.0;
  control.least_orbit_fraction = 0.3;
  control.saturated_s = 0.03;
  synchronous::RunOut& run_out = control.run_outs.emplace_back();
  run_out.order = 2.0;
  run_out.real_m[1] = 3e-6;
  for (const auto target : {synchronous::Target::kCurrent, synchronous::Target::kVibration}) {
    synchronous::BlockConfig& block = control.blocks.emplace_back();
    block.target = target;
    block.name = target == synchronous::Target::kCurrent ? "low" : "high";
    block.order = target == synchronous::Target::kCurrent ? 3.0 : 4.0;
    block.time_constant_s = 0.25;
    block.from_rad_per_s = RpmToRadPerS(1500.0);
    block.to_rad_per_s = RpmToRadPerS(4500.0);
    block.hysteresis_rad_per_s = RpmToRadPerS(40.0);
    block.adaptive = target == synchronous::Target::kVibration;
    if (block.adaptive) block.largest_current_a = 0.125;
    if (block.adaptive) block.least_change_m = 1e-6;
    for (const double rpm : {1500.0, 3000.0}) {
      synchronous::InverseAtSpeed& at = block.inverse.emplace_back();
      at.speed_rad_per_s = RpmToRadPerS(rpm);
      at.inverse.real[0][1] = 0.1 + rpm;
      at.inverse.imaginary[0][1] = -0.3;
      at.inverse.real[2][2] = 1.0 / 3.0;
    }
  }
  return controller;
}

}  // namespace levitas::configuration::test
