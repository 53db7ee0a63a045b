#pragma once
// Rigs that several tests use, as descriptions in code (the files in config/ are tested elsewhere).

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::test {

/// Flexible rotor on two magnetic bearings, 8 modes per plane, as the reference responses have it:
/// no noise, quantisation, gravity or contact; unbalance of the spin reference.
[[nodiscard]] plant::PlantConfig QuietFlexibleRotor();

/// The same rig as it runs: noise, converters, gravity at 45 degrees, touchdown bearings.
[[nodiscard]] plant::PlantConfig FlexibleRotor();

/// Published rig of a test bench (doi 10.14393/ufu.di.2015.186): shaft, rings and two magnets.
[[nodiscard]] plant::PlantConfig UfuRig();

/// A rigid, symmetric rotor whose two bearings see `mass_kg` in all: closed forms hold for it.
[[nodiscard]] plant::PlantConfig RigidRotor(double mass_kg);

}  // namespace levitas::test
