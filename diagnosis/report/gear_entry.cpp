#include "diagnosis/report/gear_entry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace levitas::diagnosis {
namespace {

using effect::Id;

/// The number behind `word` in a place: "mesh, order -3", "mesh, driven tooth 7".
int Behind(const std::string& place, const std::string& word) {
  const auto at = place.rfind(word);
  return at == std::string::npos ? 0 : std::atoi(place.c_str() + at + word.size());
}

EntryValue Number(std::string key, double value, int digits = 6) {
  return {std::move(key), value, {}, digits};
}
EntryValue Words(std::string key, std::string text) {
  return {std::move(key), 0.0, std::move(text)};
}

}  // namespace

const MeshView* MeshOf(const RigView& rig, const std::string& place) {
  for (const MeshView& mesh : rig.meshes) {
    if (place == mesh.name || place.starts_with(mesh.name + ", ")) return &mesh;
  }
  return nullptr;
}

EntryValues GearEntry(const RigView& rig, Id id, const std::string& place,
                      const std::map<std::string, double>& theta) {
  const MeshView* mesh = MeshOf(rig, place);
  if (mesh == nullptr) return {};
  const auto value = [&theta](const char* parameter) {
    const auto found = theta.find(parameter);
    return found == theta.end() ? 0.0 : found->second;
  };
  const double amplitude = std::hypot(value("cosine"), value("sine"));
  const double phase = std::atan2(value("sine"), value("cosine"));
  const int order = Behind(place, "order ");
  const char* wheel = place.find("driven") != std::string::npos ? "driven" : "driving";
  const EntryValue on = Words("gear", mesh->name);
  if (id == Id::kMeshStiffness) {
    return {on,
            Number("stiffness_n_per_m",
                   mesh->stiffness_n_per_m * std::max(0.01, 1.0 + value("stiffness")), 8),
            Number("damping_n_s_per_m",
                   mesh->damping_n_s_per_m * std::max(0.0, 1.0 + value("damping")), 8)};
  }
  if (id == Id::kMeshStiffnessVariation) {
    return {on, Number("order", order), Number("amplitude", std::min(0.9, amplitude)),
            PhaseValue(phase)};
  }
  if (id == Id::kTransmissionError) {
    return {on, Number("order", order), Number("amplitude_um", 1e6 * amplitude), PhaseValue(phase)};
  }
  if (id == Id::kGearRunout) {
    return {on, Words("wheel", wheel), Number("amplitude_um", 1e6 * amplitude), PhaseValue(phase)};
  }
  if (id == Id::kToothCrack) {
    return {on, Words("wheel", wheel), Number("depth", std::clamp(value("depth"), 0.0, 1.0)),
            Number("tooth", Behind(place, "tooth "))};
  }
  if (id == Id::kMeshFriction) {
    return {on, Number("coefficient", std::clamp(value("coefficient"), 0.0, 1.0))};
  }
  if (id == Id::kBacklash) {
    return {on, Number("gap_um", 1e6 * std::max(0.0, value("gap_m")))};
  }
  return {};
}

}  // namespace levitas::diagnosis
