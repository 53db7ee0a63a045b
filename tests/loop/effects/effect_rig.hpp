#pragma once
// A levitated rotor for the tests of effects: every test asks what one effect changes in it.

#include <memory>
#include <vector>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/effect_entry.hpp"

namespace levitas::plant::test {

/// An entry of clear size that the flexible rotor can have: planes on the shaft, order 2 or 3 ...
[[nodiscard]] effect::EffectConfig ClearOn(const PlantConfig& rig, effect::Id id);

/// Stiff proportional-derivative levitation of bearing coordinates: stable with every clear effect.
class SimpleLaw {
 public:
  [[nodiscard]] PlantCommand operator()(const SensorFrame& frame) noexcept;
  double speed_rad_per_s{};
  AxisArray excitation_a{};

 private:
  AxisArray last_m_{};
};

/// One closed-loop period; returns what was sampled.
SensorFrame StepOnce(Plant& plant, SimpleLaw& law) noexcept;

/// All samples of a run at a speed.
[[nodiscard]] std::vector<SensorFrame> RunLevitated(Plant& plant, double speed_rad_per_s,
                                                    int periods);

/// The flexible rotor without noise, converters, gravity and contact, and one entry more or none:
/// finite elements are done once for all tests.
[[nodiscard]] std::shared_ptr<const PlantModel> Quiet();
[[nodiscard]] std::shared_ptr<const PlantModel> QuietWith(const effect::EffectConfig& entry);

using levitas::test::Entry;

/// The names of all effects, for parameterised tests.
[[nodiscard]] std::vector<effect::Id> AllIds();

}  // namespace levitas::plant::test
