#include "diagnosis/isolability/stated_fault.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "configuration/schema/unit.hpp"
#include "diagnosis/model/location.hpp"
#include "plant_sim/effect/strength.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/plant/applied_effects/clear_entry.hpp"

namespace levitas::diagnosis {
namespace {

using effect::Id;
using effect::Scope;

std::string PlaceOf(const effect::EffectConfig& entry, const RigView& rig) {
  switch (effect::At(entry.id).scope) {
    case Scope::kChannels:
      return AtAxis(rig.numbers, 0).name;
    case Scope::kBearing:
      return AtBearing(rig.numbers, entry.bearing).name;
    case Scope::kMode:
      return AtMode(entry.mode).name;
    case Scope::kRig:
    case Scope::kGear:  // refused before
      break;
  }
  return "";
}

/// The first parameter that grows with the effect: the others are places, phases and shapes.
std::string SizeOf(const effect::EffectConfig& entry, const plant::PlantParameters& rig) {
  const auto parameters = effect::At(entry.id).parameters;
  const plant::Values own = plant::OwnValues(rig, entry, 0);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const effect::Parameter& p = parameters[i];
    if (p.scaling == effect::Scaling::kFixed) continue;
    double value = effect::AtStrength(p, entry.values[i], own[i], entry.strength);
    for (const configuration::Unit& unit : configuration::AllUnits()) {
      if (unit.suffix == p.file_suffix) value = std::stod(configuration::FromSi(value, unit));
    }
    return fmt::format("{} {:.3g}", effect::FileKey(p), value);
  }
  return "";
}

}  // namespace

std::optional<StatedFault> StatedFaultOf(Id id, const RigView& rig, double strength) {
  const effect::Row& row = effect::At(id);
  if (row.place == effect::Place::kGear) return std::nullopt;
  if (row.scope == Scope::kMode && rig.modes < 3) return std::nullopt;
  const plant::PlantParameters& own = rig.model->parameters();
  StatedFault fault;
  fault.entry = plant::ClearOn(own, id);
  fault.entry.strength = strength;
  if (row.scope == Scope::kChannels) fault.entry.axes = 1U;
  const auto& discs = own.config.rotor.discs;
  for (std::size_t i = 0; i < row.parameters.size(); ++i) {
    const effect::Parameter& p = row.parameters[i];
    if (p.stem != "z" || !(p.clear > 0.0)) continue;
    if (!discs.empty()) fault.entry.values[i] = discs[discs.size() / 2].z_m;
  }
  fault.place = PlaceOf(fault.entry, rig);
  fault.size = SizeOf(fault.entry, own);
  return fault;
}

std::vector<StatedFault> StatedFaults(const RigView& rig, double strength) {
  std::vector<StatedFault> faults;
  for (const effect::Row& row : effect::EntryRows()) {
    if (row.id == Id::kSampleJitter) continue;  // no term of the diagnosis describes it
    if (auto fault = StatedFaultOf(row.id, rig, strength)) faults.push_back(std::move(*fault));
  }
  return faults;
}

}  // namespace levitas::diagnosis
