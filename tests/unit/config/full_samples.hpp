#pragma once
// Files in which every key of the tables appears.

#include "config/rig_file.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::config::test {

inline RigFile FullRig() {
  RigFile rig = LoadRig(FindConfig("flexible_rotor", "rigs"));
  rig.plant.rotor.rings.push_back({0.2, 0.01, 9.525e-3, 0.05, 7850.0});
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

/// The shipped rig with every effect of the catalogue.
inline RigFile AllEffects() {
  RigFile rig = FullRig();
  rig.plant.effects.clear();
  for (const effect::Row& row : effect::Catalogue()) {
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
  return LoadController(FindConfig("flexible_rotor", "controllers"), rig);
}

inline scenario::ScenarioConfig FullScenario(const RigNumbers& rig) {
  scenario::ScenarioConfig scenario = LoadScenario(FindConfig("default", "scenarios"), rig);
  scenario.steps[1].excitation = {{"de_x", 0, 0.05, 12, 2, 0.0}, {"nde_y", 3, 0.1, 15, 1, 0.25}};
  return scenario;
}

}  // namespace levitas::config::test
