#include "plant_sim/plant/applied_effects/gear_effects.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/effect/placed_id.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/plant/applied_effects/coupling_effects.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::GearId;
using effect::Id;

bool OnGear(const EffectConfig& entry) {
  return effect::At(entry.id).scope == effect::Scope::kGear;
}

/// Where the next entry of a mesh stores what it has.
struct Next {
  std::size_t variation{}, crack{}, harmonic{};
};

void Recall(const MeshModel& nominal, MeshModel& mesh) noexcept {
  mesh.law.stiffness_n_per_m = nominal.law.stiffness_n_per_m;
  mesh.law.damping_n_s_per_m = nominal.law.damping_n_s_per_m;
  mesh.law.half_backlash_m = nominal.law.half_backlash_m;
  mesh.law.friction = nominal.law.friction;
  mesh.driving.runout_m = nominal.driving.runout_m;
  mesh.driven.runout_m = nominal.driven.runout_m;
}

void AddRunout(const PlantParameters& parameters, const EffectConfig& entry, const Values& values,
               TrainModel& train) noexcept {
  const gear::GearPair& pair = parameters.config.gears[entry.gear];
  MeshModel& mesh = train.meshes[entry.gear];
  const gear::Wheel& wheel = entry.on_driven ? pair.driven : pair.driving;
  WheelModel& model = entry.on_driven ? mesh.driven : mesh.driving;
  const gear::Vector off_m{values[0] * std::cos(values[1]), values[0] * std::sin(values[1])};
  model.runout_m = model.runout_m + off_m;
  const auto& shape = entry.on_driven ? mesh.driven_shape : mesh.driving_shape;
  ShaftUnbalance& unbalance = train.unbalance[wheel.shaft];
  for (std::size_t i = 0; i < shape.size(); ++i) {
    unbalance.real[i] += shape[i] * wheel.eccentric_mass_kg * off_m.x;
    unbalance.imaginary[i] += shape[i] * wheel.eccentric_mass_kg * off_m.y;
  }
}

void ApplyEntry(const PlantParameters& parameters, const EffectConfig& entry, const Values& values,
                Next& next, std::vector<gear::Harmonic>& error, TrainModel& train) noexcept {
  gear::MeshLaw& law = train.meshes[entry.gear].law;
  switch (std::get<GearId>(effect::Placed(entry.id))) {
    case GearId::kMeshStiffness:
      law.stiffness_n_per_m = values[0];
      law.damping_n_s_per_m = values[1];
      break;
    case GearId::kMeshStiffnessVariation:
      law.variation[next.variation++] = {static_cast<int>(values[0]), values[1], values[2]};
      break;
    case GearId::kBacklash:
      law.half_backlash_m += 0.5 * values[0];
      break;
    case GearId::kMeshFriction:
      law.friction += values[0];
      break;
    case GearId::kTransmissionError:
      error[next.harmonic++] = {static_cast<int>(values[0]), values[1], values[2]};
      break;
    case GearId::kGearRunout:
      AddRunout(parameters, entry, values, train);
      break;
    case GearId::kToothCrack:
      law.cracks[next.crack++] = {entry.on_driven, static_cast<int>(values[1]), values[0]};
      break;
  }
}

}  // namespace

NominalGears PrepareGears(const PlantParameters& parameters, TrainModel& train) {
  PrepareCouplings(parameters, train);
  NominalGears gears{train.meshes, {}, train.unbalance};
  for (const auto& pair : parameters.config.gears) gears.errors.push_back(pair.transmission_error);
  for (const EffectConfig& entry : parameters.config.effects) {
    if (!OnGear(entry)) continue;
    gear::MeshLaw& law = train.meshes[entry.gear].law;
    if (entry.id == Id::kMeshStiffnessVariation) law.variation.emplace_back();
    if (entry.id == Id::kToothCrack) law.cracks.emplace_back();
    if (entry.id == Id::kTransmissionError) {
      gears.errors[entry.gear].push_back({static_cast<int>(entry.values[0]), 0.0, 0.0});
    }
  }
  for (std::size_t m = 0; m < train.meshes.size(); ++m) {
    train.meshes[m].error = gear::TransmissionError(gears.errors[m]);
  }
  return gears;
}

void ApplyToGears(const PlantParameters& parameters, std::span<const double> strengths,
                  NominalGears& gears, TrainModel& train) noexcept {
  ApplyToCouplings(parameters, strengths, train);
  const auto& entries = parameters.config.effects;
  if (std::none_of(entries.begin(), entries.end(), OnGear)) return;
  for (std::size_t s = 0; s < train.unbalance.size(); ++s) {
    const ShaftUnbalance& nominal = gears.unbalance[s];
    std::copy(nominal.real.begin(), nominal.real.end(), train.unbalance[s].real.begin());
    std::copy(nominal.imaginary.begin(), nominal.imaginary.end(),
              train.unbalance[s].imaginary.begin());
  }
  std::array<Next, kMaxGears> next;
  for (std::size_t m = 0; m < train.meshes.size(); ++m) {
    const MeshModel& nominal = gears.meshes[m];
    Recall(nominal, train.meshes[m]);
    next[m] = {nominal.law.variation.size(), nominal.law.cracks.size(),
               parameters.config.gears[m].transmission_error.size()};
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!OnGear(entries[i])) continue;
    const std::size_t m = entries[i].gear;
    ApplyEntry(parameters, entries[i], ValuesAt(parameters, entries[i], 0, strengths[i]), next[m],
               gears.errors[m], train);
  }
  for (std::size_t m = 0; m < train.meshes.size(); ++m) train.meshes[m].error.Set(gears.errors[m]);
}

}  // namespace levitas::plant
