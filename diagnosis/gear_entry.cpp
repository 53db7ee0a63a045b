#include "diagnosis/gear_entry.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace levitas::diagnosis {
namespace {

/// The number behind `word` in a place: "mesh, order -3", "mesh, driven tooth 7".
int Behind(const std::string& place, const std::string& word) {
  const auto at = place.rfind(word);
  return at == std::string::npos ? 0 : std::atoi(place.c_str() + at + word.size());
}

}  // namespace

const MeshView* MeshOf(const RigView& rig, const std::string& place) {
  for (const MeshView& mesh : rig.meshes) {
    if (place == mesh.name || place.starts_with(mesh.name + ", ")) return &mesh;
  }
  return nullptr;
}

std::string GearEntry(const RigView& rig, const std::string& effect, const std::string& place,
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
  const std::string on = fmt::format("gear: {}", mesh->name);
  if (effect == "mesh_stiffness") {
    return fmt::format("{}, stiffness_n_per_m: {:.8g}, damping_n_s_per_m: {:.8g}", on,
                       mesh->stiffness_n_per_m * std::max(0.01, 1.0 + value("stiffness")),
                       mesh->damping_n_s_per_m * std::max(0.0, 1.0 + value("damping")));
  }
  if (effect == "mesh_stiffness_variation") {
    return fmt::format("{}, order: {}, amplitude: {:.6g}, phase_rad: {:.6g}", on, order,
                       std::min(0.9, amplitude), phase);
  }
  if (effect == "transmission_error") {
    return fmt::format("{}, order: {}, amplitude_um: {:.6g}, phase_rad: {:.6g}", on, order,
                       1e6 * amplitude, phase);
  }
  if (effect == "gear_runout") {
    return fmt::format("{}, wheel: {}, amplitude_um: {:.6g}, phase_rad: {:.6g}", on, wheel,
                       1e6 * amplitude, phase);
  }
  if (effect == "tooth_crack") {
    return fmt::format("{}, wheel: {}, depth: {:.6g}, tooth: {}", on, wheel,
                       std::clamp(value("depth"), 0.0, 1.0), Behind(place, "tooth "));
  }
  if (effect == "mesh_friction") {
    return fmt::format("{}, coefficient: {:.6g}", on, std::clamp(value("coefficient"), 0.0, 1.0));
  }
  if (effect == "backlash") {
    return fmt::format("{}, gap_um: {:.6g}", on, 1e6 * std::max(0.0, value("gap_m")));
  }
  return {};
}

}  // namespace levitas::diagnosis
