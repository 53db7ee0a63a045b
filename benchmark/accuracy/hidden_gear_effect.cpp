#include "benchmark/accuracy/hidden_gear_effect.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <variant>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/placed_id.hpp"

namespace levitas::accuracy {

using effect::GearId;
using effect::Id;

namespace {

std::size_t PickOf(std::size_t count, Random& random) { return random.Bits() % count; }

void DrawTransmissionError(double size, double phase, Random& random, effect::EffectConfig& entry) {
  constexpr int kHighest = 6;
  entry.values[0] = static_cast<double>(PickOf(2 * kHighest + 1, random)) - kHighest;
  entry.values[1] = 3e-6 * size;
  entry.values[2] = phase;
}

void DrawToothCrack(double size, const gear::GearPair& pair, Random& random,
                    effect::EffectConfig& entry) {
  entry.on_driven = PickOf(2, random) == 1;
  const auto& wheel = entry.on_driven ? pair.driven : pair.driving;
  entry.values[0] = std::min(1.0, 0.15 * size);
  entry.values[1] = static_cast<double>(PickOf(static_cast<std::size_t>(wheel.teeth), random));
}

GearId OfTeeth(Id id) {
  const effect::PlacedId placed = effect::Placed(id);
  if (const auto* of_teeth = std::get_if<GearId>(&placed)) return *of_teeth;
  throw std::logic_error(
      fmt::format("{}: DrawEffect() draws it (hidden_effect.hpp)", effect::At(id).name));
}

}  // namespace

std::vector<effect::EffectConfig> DrawGearEffect(Id id, double size,
                                                 const plant::PlantParameters& nominal,
                                                 Random& random) {
  effect::EffectConfig entry = effect::ClearEntry(id);
  const auto ratio = [&](double clear) {
    return std::exp((random.Uniform() < 0.5 ? -1.0 : 1.0) * size * std::log1p(clear));
  };
  const double phase = std::numbers::pi * (2.0 * random.Uniform() - 1.0);
  entry.gear = PickOf(nominal.config.gears.size(), random);
  const gear::GearPair& pair = nominal.config.gears[entry.gear];
  if (id == Id::kMisalignment) {  // a universal joint: no force, uneven rotation
    entry.on_driven = PickOf(2, random) == 1;
    entry.values = {0.0, 2.0, 0.0, phase, 2e-4 * size};
    return {entry};
  }
  switch (OfTeeth(id)) {
    case GearId::kMeshStiffness:
      entry.values[0] = pair.stiffness_n_per_m * ratio(0.35);
      entry.values[1] = pair.damping_n_s_per_m * ratio(0.2);
      break;
    case GearId::kMeshStiffnessVariation:
      entry.values[0] = static_cast<double>(1 + PickOf(3, random));
      entry.values[1] = std::min(0.9, 0.03 * size);
      entry.values[2] = phase;
      break;
    case GearId::kBacklash:
      entry.values[0] = 5e-6 * size;
      break;
    case GearId::kMeshFriction:
      entry.values[0] = std::min(1.0, 0.05 * size);
      break;
    case GearId::kTransmissionError:
      DrawTransmissionError(size, phase, random, entry);
      break;
    case GearId::kGearRunout:
      entry.on_driven = PickOf(2, random) == 1;
      entry.values[0] = 10e-6 * size;
      entry.values[1] = phase;
      break;
    case GearId::kToothCrack:
      DrawToothCrack(size, pair, random, entry);
      break;
  }
  return {entry};
}

}  // namespace levitas::accuracy
