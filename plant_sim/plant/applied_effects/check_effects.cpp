#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "plant_sim/effect/catalogue.hpp"
#include "plant_sim/plant/check_config.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::Scope;

[[noreturn]] void Refuse(std::size_t index, const EffectConfig& entry, const std::string& what) {
  throw std::invalid_argument(fmt::format("effects[{}] ({}): {}; correct the rig description",
                                          index, effect::At(entry.id).name, what));
}

void CheckValues(std::size_t index, const EffectConfig& entry) {
  const auto parameters = effect::At(entry.id).parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const effect::Parameter& p = parameters[i];
    const double value = entry.values[i];
    if (value >= p.low && value <= p.high && (!p.whole || value == std::round(value))) continue;
    // Also the neutral limit of an effect that is neutral at infinity.
    if (value == p.neutral) continue;
    Refuse(index, entry,
           fmt::format("{} = {}, allowed {} to {}{}", p.stem, value, p.low, p.high,
                       p.whole ? " (whole)" : ""));
  }
  if (!(entry.strength >= 0.0 && entry.strength <= 1.0)) {
    Refuse(index, entry, fmt::format("strength = {}, allowed 0 to 1", entry.strength));
  }
  for (const double time_s : {entry.at_s, entry.ramp_s}) {
    if (time_s >= 0.0 && std::isfinite(time_s)) continue;
    Refuse(index, entry, fmt::format("at_s or ramp_s = {}, allowed 0 and above", time_s));
  }
}

void CheckReference(std::size_t index, const EffectConfig& entry, const PlantConfig& config) {
  const Scope scope = effect::At(entry.id).scope;
  const std::size_t bearings = config.bearings.size();
  const bool of_a_wheel = entry.id == effect::Id::kMisalignment && !config.shafts.empty();
  if ((scope == Scope::kGear || of_a_wheel) && entry.gear >= config.gears.size()) {
    Refuse(index, entry,
           config.gears.empty()
               ? "needs a rig with gears"
               : fmt::format("gear pair {} of a rig that has {}", entry.gear, config.gears.size()));
  }
  if (scope == Scope::kChannels) {
    for (std::size_t axis = 0; axis < 2 * bearings; ++axis) {
      if (entry.Acts(axis)) return;
    }
    Refuse(index, entry, "names no channel of the rig");
  }
  if (scope == Scope::kBearing && entry.bearing >= bearings) {
    Refuse(index, entry, fmt::format("bearing {} of a rig that has {}", entry.bearing, bearings));
  }
}

// Geared shafts have modes and planes of their own: what refers to those of one rotor is refused.
bool NeedsOneRotor(const EffectConfig& entry) {
  const effect::Row& row = effect::At(entry.id);
  if (entry.id == effect::Id::kGyroscopicInertia || entry.id == effect::Id::kMisalignment) {
    return false;
  }
  return row.place == effect::Place::kRotor || row.place == effect::Place::kExternal ||
         entry.id == effect::Id::kSensorPosition;
}

/// What a misaligned coupling acts on: the disc of a lumped shaft, the radius of the wheel. Planes
/// of a beam are known once its elements are, and checked there.
void CheckCoupling(std::size_t index, const EffectConfig& entry, const PlantConfig& config) {
  const double z_m = entry.values[0];
  const double force_n = entry.values[2];
  const double rotation_rad = entry.values[4];
  if (config.shafts.empty()) {
    if (rotation_rad == 0.0) return;
    Refuse(
        index, entry,
        "rotation_error acts between geared shafts; the drive prescribes the rotation of the one "
        "rotor of this rig");
  }
  const gear::GearPair& pair = config.gears[entry.gear];
  const gear::Wheel& wheel = entry.on_driven ? pair.driven : pair.driving;
  const rotor::Shaft& shaft = config.shafts[wheel.shaft];
  if (force_n != 0.0 && !shaft.is_beam && std::abs(z_m - shaft.lumped.z_m) > 1e-9) {
    Refuse(index, entry,
           fmt::format("z_mm = {:.6g}, but shaft {} can be pushed at its disc only, at {:.6g}",
                       1e3 * z_m, shaft.name, 1e3 * shaft.lumped.z_m));
  }
  if (rotation_rad != 0.0 && wheel.base_radius_m == 0.0) {
    Refuse(index, entry, "rotation_error needs the base_radius_mm of the wheel");
  }
}

bool SamePlace(const EffectConfig& a, const EffectConfig& b, std::size_t bearings) {
  if (a.id != b.id) return false;
  switch (effect::At(a.id).scope) {
    case Scope::kChannels:
      return (a.axes & b.axes & ((1U << (2 * bearings)) - 1U)) != 0U;
    case Scope::kBearing:
      return a.bearing == b.bearing && a.on_sensor == b.on_sensor;
    case Scope::kMode:
      return a.mode == b.mode;
    case Scope::kGear:
      return a.gear == b.gear;
    case Scope::kRig:
      break;
  }
  return true;
}

}  // namespace

void CheckEffects(const PlantConfig& config) {
  const auto& entries = config.effects;
  const std::size_t bearings = config.bearings.size();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const effect::Row& row = effect::At(entries[i].id);
    if (!effect::IsEntry(row)) Refuse(i, entries[i], effect::InPlaceOfAnEntry(row));
    CheckValues(i, entries[i]);
    CheckReference(i, entries[i], config);
    if (config.rotor.given && entries[i].id == effect::Id::kBreathingCrack) {
      Refuse(i, entries[i], "needs the sections of the shaft, this rotor is given by its modes");
    }
    if (entries[i].id == effect::Id::kMisalignment) CheckCoupling(i, entries[i], config);
    if (!config.shafts.empty() && NeedsOneRotor(entries[i])) {
      Refuse(i, entries[i], "needs a rig with one rotor, this one has geared shafts");
    }
    if (effect::At(entries[i].id).facts.repeats) continue;
    for (std::size_t k = 0; k < i; ++k) {
      if (SamePlace(entries[i], entries[k], bearings)) {
        Refuse(i, entries[i], fmt::format("effects[{}] acts at the same place", k));
      }
    }
  }
}

}  // namespace levitas::plant
