#pragma once
// Geared rigs as descriptions in code (the files in config/ are tested elsewhere).

#include <numbers>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::test {

/// Pinion and gear, deflection only; magnets on both shafts; contact, noise and converters off.
[[nodiscard]] plant::PlantConfig GearedRotor4();
/// The same with tilting discs on simply supported shafts.
[[nodiscard]] plant::PlantConfig GearedRotor8();
/// The same with torsion from motor to brake.
[[nodiscard]] plant::PlantConfig GearedRotor12();

/// Published pair of shafts without magnets: Rao, Shiau & Chang (1998), Mech. Mach. Theory 33(6).
[[nodiscard]] plant::PlantConfig RaoPair();

}  // namespace levitas::test
