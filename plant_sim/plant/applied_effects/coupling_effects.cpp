#include "plant_sim/plant/applied_effects/coupling_effects.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/plant/eigen_index.hpp"

namespace levitas::plant {
namespace {

using effect::EffectConfig;
using effect::Id;

// Places of the values of `misalignment` in the catalogue.
constexpr std::size_t kPlane = 0;
constexpr std::size_t kOrder = 1;
constexpr std::size_t kForce = 2;
constexpr std::size_t kPhase = 3;
constexpr std::size_t kRotation = 4;

const gear::Wheel& WheelOf(const PlantParameters& parameters, const EffectConfig& entry) {
  const gear::GearPair& pair = parameters.config.gears[entry.gear];
  return entry.on_driven ? pair.driven : pair.driving;
}

std::vector<double> ShapeOf(const PlantParameters& parameters, const EffectConfig& entry,
                            std::size_t shaft) {
  const rotor::ModalRotor& modes = parameters.modes;
  const auto count = static_cast<std::size_t>(modes.frequency_rad_per_s.size());
  if (entry.values[kForce] == 0.0) return std::vector<double>(count, 0.0);
  std::string planes;
  for (std::size_t node = 0; node < modes.node_z_m.size(); ++node) {
    if (modes.node_shaft[node] != shaft) continue;
    if (std::abs(modes.node_z_m[node] - entry.values[kPlane]) <= 1e-9) {
      return ToVector(modes.shapes.row(At(node)));
    }
    planes += fmt::format("{}{:.6g}", planes.empty() ? "" : ", ", 1e3 * modes.node_z_m[node]);
  }
  throw std::invalid_argument(
      fmt::format("effect misalignment: z = {:.6g} mm is no plane of shaft {}, which has {} mm; "
                  "name one of them",
                  1e3 * entry.values[kPlane], shaft + 1, planes));
}

/// Torque on the torsional modes per error of the spring beside the wheel; empty without one.
std::vector<double> TwistOf(const PlantParameters& parameters, const EffectConfig& entry,
                            std::size_t shaft) {
  const rotor::Torsion& torsion = parameters.config.shafts[shaft].torsion;
  const std::size_t count = torsion.inertias.size();
  if (torsion.kind != rotor::TorsionKind::kInertias || count < 2) return {};
  const std::size_t wheel = torsion.gear_at;
  const bool before = entry.on_driven ? wheel + 1 == count : wheel > 0;
  const std::size_t neighbour = before ? wheel - 1 : wheel + 1;
  const double stiffness = torsion.inertias[before ? neighbour : wheel].stiffness_n_m_per_rad;
  const Eigen::Index first = parameters.first_torsion_row[shaft];
  const auto& shapes = parameters.torsion.shapes;
  return ToVector(stiffness * (shapes.row(first + At(wheel)) - shapes.row(first + At(neighbour))));
}

}  // namespace

void PrepareCouplings(const PlantParameters& parameters, TrainModel& train) {
  for (const EffectConfig& entry : parameters.config.effects) {
    if (train.shafts == 0 || entry.id != Id::kMisalignment) continue;
    const gear::Wheel& wheel = WheelOf(parameters, entry);
    CouplingModel coupling;
    coupling.shaft = wheel.shaft;
    coupling.ratio = train.ratio[wheel.shaft];
    coupling.order = static_cast<int>(entry.values[kOrder]);
    coupling.shape = ShapeOf(parameters, entry, wheel.shaft);
    coupling.twist = TwistOf(parameters, entry, wheel.shaft);
    coupling.mesh = entry.gear;
    if (coupling.twist.empty()) coupling.base_radius_m = wheel.base_radius_m;
    train.couplings.push_back(std::move(coupling));
  }
}

void ApplyToCouplings(const PlantParameters& parameters, std::span<const double> strengths,
                      TrainModel& train) noexcept {
  if (train.couplings.empty()) return;
  const auto& entries = parameters.config.effects;
  std::size_t next = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i].id != Id::kMisalignment) continue;
    const Values values = ValuesAt(parameters, entries[i], 0, strengths[i]);
    const gear::Vector direction{std::cos(values[kPhase]), std::sin(values[kPhase])};
    CouplingModel& coupling = train.couplings[next++];
    coupling.force_n = values[kForce] * direction;
    coupling.rotation_rad = values[kRotation] * direction;
  }
}

}  // namespace levitas::plant
