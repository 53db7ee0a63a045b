#include "benchmark/accuracy/hidden_gear_effect.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::accuracy {

using effect::Id;

std::vector<effect::EffectConfig> DrawGearEffect(Id id, double size,
                                                 const plant::PlantParameters& nominal,
                                                 Random& random) {
  effect::EffectConfig entry = effect::ClearEntry(id);
  const auto pick = [&random](std::size_t count) { return random.Bits() % count; };
  const auto ratio = [&](double clear) {
    return std::exp((random.Uniform() < 0.5 ? -1.0 : 1.0) * size * std::log1p(clear));
  };
  const double phase = std::numbers::pi * (2.0 * random.Uniform() - 1.0);
  entry.gear = pick(nominal.config.gears.size());
  const gear::GearPair& pair = nominal.config.gears[entry.gear];
  switch (id) {
    case Id::kMeshStiffness:
      entry.values[0] = pair.stiffness_n_per_m * ratio(0.35);
      entry.values[1] = pair.damping_n_s_per_m * ratio(0.2);
      break;
    case Id::kMeshStiffnessVariation:
      entry.values[0] = static_cast<double>(1 + pick(3));
      entry.values[1] = std::min(0.9, 0.03 * size);
      entry.values[2] = phase;
      break;
    case Id::kBacklash:
      entry.values[0] = 5e-6 * size;
      break;
    case Id::kMeshFriction:
      entry.values[0] = std::min(1.0, 0.05 * size);
      break;
    case Id::kTransmissionError: {
      constexpr int kHighest = 6;
      entry.values[0] = static_cast<double>(pick(2 * kHighest + 1)) - kHighest;
      entry.values[1] = 3e-6 * size;
      entry.values[2] = phase;
      break;
    }
    case Id::kMisalignment:  // a universal joint: no force, uneven rotation
      entry.on_driven = pick(2) == 1;
      entry.values = {0.0, 2.0, 0.0, phase, 2e-4 * size};
      break;
    case Id::kGearRunout:
      entry.on_driven = pick(2) == 1;
      entry.values[0] = 10e-6 * size;
      entry.values[1] = phase;
      break;
    default: {  // cracked tooth
      entry.on_driven = pick(2) == 1;
      const auto& wheel = entry.on_driven ? pair.driven : pair.driving;
      entry.values[0] = std::min(1.0, 0.15 * size);
      entry.values[1] = static_cast<double>(pick(static_cast<std::size_t>(wheel.teeth)));
      break;
    }
  }
  return {entry};
}

}  // namespace levitas::accuracy
