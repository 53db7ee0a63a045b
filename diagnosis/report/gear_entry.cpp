#include "diagnosis/report/gear_entry.hpp"

#include <algorithm>
#include <utility>

namespace levitas::diagnosis {
namespace {

using effect::Id;

EntryValue Number(std::string key, double value, int digits = 6) {
  return {std::move(key), value, digits};
}
}  // namespace

EntryValues GearEntry(const RigView& rig, Id id, const PlacedEffect& at) {
  const MeshView& mesh = rig.meshes.at(at.location.gear.value());
  if (id == Id::kMeshStiffness) {
    return {Number("stiffness_n_per_m",
                   mesh.stiffness_n_per_m * std::max(0.01, 1.0 + at.At("stiffness")), 8),
            Number("damping_n_s_per_m",
                   mesh.damping_n_s_per_m * std::max(0.0, 1.0 + at.At("damping")), 8)};
  }
  if (id == Id::kMeshStiffnessVariation) {
    return {Number("order", at.location.order.value()),
            Number("amplitude", std::min(0.9, at.Amplitude())), PhaseValue(at.Phase())};
  }
  if (id == Id::kTransmissionError) {
    return {Number("order", at.location.order.value()),
            Number("amplitude_um", 1e6 * at.Amplitude()), PhaseValue(at.Phase())};
  }
  if (id == Id::kGearRunout) {
    return {Number("amplitude_um", 1e6 * at.Amplitude()), PhaseValue(at.Phase())};
  }
  if (id == Id::kToothCrack) {
    return {Number("depth", std::clamp(at.At("depth"), 0.0, 1.0)),
            Number("tooth", static_cast<double>(at.location.tooth.value()))};
  }
  if (id == Id::kMeshFriction) {
    return {Number("coefficient", std::clamp(at.At("coefficient"), 0.0, 1.0))};
  }
  if (id == Id::kBacklash) {
    return {Number("gap_um", 1e6 * std::max(0.0, at.At("gap_m")))};
  }
  return {};
}

}  // namespace levitas::diagnosis
