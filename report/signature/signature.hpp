#pragma once
// Pictures of what each effect does to a rig: nominal beside effect.
//
// Response   linear effects: gain from the control current of the first axis to the readings of
//            both axes of its bearing, delay included, and how gain and phase change.
// Spectrum   effects that turn with the rotor, or of the sensor: full spectrum of the orbit over
//            orders of rotation (positive = forward), the spectrum of what the effect adds to
//            readings and currents, and the orbit, levitated by a plain law with an integrator.
// Gear       effects of teeth: full spectrum of the driving wheel's shaft over its orders, and of
//            what the effect adds, without a control law.
// Force      magnets: force over commanded current, the rotor held in the centre.
// Both       the nominal curve is a broad pale line below the effect's thin one, so that it is seen
//            where the two lie on each other.
// Size       the title says it, in the keys and units of a rig file; of what is counted from the
//            rig's own value that value as well.
// Units      hertz, newtons, amperes, micrometres.
// Thread     any; a picture takes some tens of milliseconds.
// Failure    std::invalid_argument when the rig cannot have the effect.

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/plant_parameters.hpp"
#include "report/svg/figure.hpp"

namespace levitas::configuration {
struct Unit;
}

namespace levitas::signature {

/// `rig` without effects beside `rig` with this entry.
[[nodiscard]] svg::Figure Picture(const plant::PlantParameters& rig,
                                  const effect::EffectConfig& entry);

/// "tau 50 µs", "bandwidth 144 Hz (the rig has 720 Hz)".
[[nodiscard]] std::string SizeText(const plant::PlantParameters& rig,
                                   const effect::EffectConfig& entry);

/// A curve of the nominal rig: below the other, and seen beside it.
inline void MakeNominal(svg::Series& curve) {
  curve.colour = "#5aa0d8";
  curve.width = 5.0;
}

// The panels of effect::Shows; a pair of models: without and with the effect.
struct Pair {
  plant::PlantParameters without;
  plant::PlantParameters with;
};
[[nodiscard]] std::vector<svg::Panel> ResponsePanels(const Pair& rigs);
[[nodiscard]] std::vector<svg::Panel> SpectrumPanels(const Pair& rigs);
[[nodiscard]] std::vector<svg::Panel> ForcePanels(const Pair& rigs);
[[nodiscard]] std::vector<svg::Panel> GearPanels(const Pair& rigs);

/// The unit that a key of a rig file ends in; of a pure number kOne.
[[nodiscard]] const configuration::Unit& FileUnit(const effect::Parameter& parameter);

/// docs/effects.md as it must read for the present catalogue.
[[nodiscard]] std::string EffectsDocument();

}  // namespace levitas::signature
