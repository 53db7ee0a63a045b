#pragma once
// From the list of effects of a rig to the numbers that the time step uses.
//
// Use        Prepare once (allocates), then Apply for every set of strengths (does not).
// Equations  docs/effects.md; the pure functions are those of plant_sim/effect.
// Failure    Prepare throws std::invalid_argument for an entry that this rig cannot have.
// Thread     any; Apply writes its arguments alone.

#include <span>
#include <vector>

#include "plant_sim/plant/applied_effects/effect_model.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::plant {

/// The nominal numbers that effects change, as they are now.
struct RigNow {
  double delay_samples{};
  std::vector<double> frequency_rad_per_s, damping_ratio;  ///< per mode
  AxisArray amplifier_bandwidth_hz{};
  AxisArray slew_a_per_s{};
  double gyroscopic_ratio{1.0};
  double mass_ratio{1.0};                                 ///< of the rigid rotor
  std::size_t rigid_modes{2};                             ///< they come first
  std::array<double, kMaxAxes / 2> sensor_shift_share{};  ///< of the shift, per bearing
  std::vector<double> unbalance;    ///< added modal unbalance, real then imaginary parts
  std::vector<double> static_load;  ///< added modal force, x plane then y plane
};

/// What an entry needs of the mode shapes: deflection or curvature per mode, empty if nothing.
using EntryShapes = std::vector<std::vector<double>>;

/// Checks the entries against rotor and bearings, then takes the shapes.
[[nodiscard]] EntryShapes MakeEntryShapes(const PlantParameters& parameters);
/// Storage for every entry, and its states at the end of the layout.
[[nodiscard]] EffectModel PrepareEffects(const PlantParameters& parameters, StateLayout& layout);
[[nodiscard]] RigNow PrepareRig(const PlantParameters& parameters);

/// Index of the mode of an entry; the rigid ones come first.
[[nodiscard]] inline std::size_t FlexibleMode(const PlantParameters& parameters,
                                              const effect::EffectConfig& entry) noexcept {
  return entry.mode - 1 + static_cast<std::size_t>(parameters.modes.rigid_modes);
}

/// SI values of one entry, in the order of its parameters in the catalogue.
using Values = std::array<double, effect::kMaxParameters>;

/// The value of each parameter of an entry that the rig has without it; NaN where it has none.
[[nodiscard]] Values OwnValues(const PlantParameters& parameters, const effect::EffectConfig& entry,
                               std::size_t axis) noexcept;

void ApplyEffects(const PlantParameters& parameters, const EntryShapes& shapes,
                  std::span<const double> strengths, RigNow& now, EffectModel& model) noexcept;

// By place; `values` are those of one entry at its strength.
[[nodiscard]] Values ValuesAt(const PlantParameters& parameters, const effect::EffectConfig& entry,
                              std::size_t axis, double strength) noexcept;
/// Where the next entry of each kind stores what it has.
struct Slots {
  std::size_t runout{}, pickup{}, order_force{}, spring{}, damper{}, crack{};
  std::array<std::size_t, kMaxAxes / 2> rub{};
};
void ApplyToLoop(const effect::EffectConfig& entry, const Values& values, double period_s,
                 RigNow& now, EffectModel& model) noexcept;
void ApplyToMagnets(const PlantParameters& parameters, const effect::EffectConfig& entry,
                    const Values& values, EffectModel& model) noexcept;
void ApplyToSensors(const PlantParameters& parameters, const effect::EffectConfig& entry,
                    double strength, EffectModel& model, Slots& slots) noexcept;
void ApplyToRotor(const PlantParameters& parameters, const effect::EffectConfig& entry,
                  const Values& values, const std::vector<double>& shape, RigNow& now,
                  EffectModel& model, Slots& slots) noexcept;
void ApplyFromOutside(const effect::EffectConfig& entry, const Values& values,
                      const std::vector<double>& shape, RigNow& now, EffectModel& model,
                      Slots& slots) noexcept;

}  // namespace levitas::plant
