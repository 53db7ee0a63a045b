#include "diagnosis/report/gear_entry.hpp"

#include <algorithm>
#include <numbers>

namespace levitas::diagnosis {
namespace {

constexpr double kDegreesPerRad = 180.0 / std::numbers::pi;

}  // namespace

using effect::Id;

EntryValues GearEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  const MeshView& mesh = rig.meshes.at(at.location.gear.value());
  if (id == Id::kMeshStiffness) {
    return {EntryValue{"stiffness_n_per_m",
                       mesh.stiffness_n_per_m * std::max(0.01, 1.0 + at.At("stiffness")), 8},
            EntryValue{"damping_n_s_per_m",
                       mesh.damping_n_s_per_m * std::max(0.0, 1.0 + at.At("damping")), 8}};
  }
  if (id == Id::kMeshStiffnessVariation) {
    return {EntryValue{"order", static_cast<double>(at.location.order.value())},
            EntryValue{"amplitude", std::min(0.9, at.Amplitude())}, PhaseValue(at.Phase())};
  }
  if (id == Id::kTransmissionError) {
    return {EntryValue{"order", static_cast<double>(at.location.order.value())},
            EntryValue{"amplitude_um", 1e6 * at.Amplitude()}, PhaseValue(at.Phase())};
  }
  if (id == Id::kGearRunout) {
    return {EntryValue{"amplitude_um", 1e6 * at.Amplitude()}, PhaseValue(at.Phase())};
  }
  if (id == Id::kToothCrack) {
    return {EntryValue{"depth", std::clamp(at.At("depth"), 0.0, 1.0)},
            EntryValue{"tooth", static_cast<double>(at.location.tooth.value())}};
  }
  if (id == Id::kMisalignment) {
    const EntryValue order{"order", static_cast<double>(at.location.order.value())};
    if (at.location.z_m) {
      return {EntryValue{"z_mm", 1e3 * *at.location.z_m}, order,
              EntryValue{"force_n", at.Amplitude()}, PhaseValue(at.Phase())};
    }
    return {order, EntryValue{"rotation_error_deg", kDegreesPerRad * at.Amplitude()},
            PhaseValue(at.Phase())};
  }
  if (id == Id::kMeshFriction) {
    return {EntryValue{"coefficient", std::clamp(at.At("coefficient"), 0.0, 1.0)}};
  }
  if (id == Id::kBacklash) {
    return {EntryValue{"gap_um", 1e6 * std::max(0.0, at.At("gap_m"))}};
  }
  return {};
}

}  // namespace levitas::diagnosis
