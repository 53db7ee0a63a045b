#include "plant_sim/plant/parameter_access.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "common/nearest.hpp"
#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::plant {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// A number of the rig under its name; `scale` converts what is stored into the unit of the name.
struct Entry {
  std::string name;
  double* stored;
  double scale{1.0};
};

void AddBearing(std::vector<Entry>& entries, const std::string& at, BearingConfig& b) {
  entries.push_back(
      {at + "magnet.force_constant_n_m2_per_a2", &b.magnet.force_constant_n_m2_per_a2});
  entries.push_back({at + "magnet.bias_current_a", &b.magnet.bias_current_a});
  entries.push_back({at + "magnet.gap_m", &b.magnet.gap_m});
  entries.push_back({at + "magnet.max_coil_current_a", &b.magnet.max_coil_current_a});
  entries.push_back({at + "amplifier.bandwidth_hz", &b.amplifier.bandwidth_hz});
  entries.push_back({at + "amplifier.slew_a_per_s", &b.amplifier.slew_a_per_s});
  if (auto& law = b.magnet.exponential) {
    entries.push_back({at + "magnet.force_n_per_a2", &law->force_n_per_a2});
    entries.push_back({at + "magnet.decay_m", &law->decay_m});
    entries.push_back({at + "magnet.far_gap_m", &law->far_gap_m});
  }
  if (auto& coil = b.amplifier.voltage) {
    entries.push_back({at + "amplifier.steady", &coil->steady});
    entries.push_back({at + "amplifier.offset_a", &coil->offset_a});
    entries.push_back({at + "amplifier.time_constant_s", &coil->time_constant_s});
    entries.push_back({at + "amplifier.decay_m", &coil->decay_m});
    entries.push_back({at + "amplifier.motion_emf", &coil->motion_emf});
    entries.push_back({at + "amplifier.dead_band_a", &coil->dead_band_a});
    entries.push_back({at + "amplifier.curvature", &coil->curvature});
    entries.push_back({at + "amplifier.iron_1_per_a2", &coil->iron_1_per_a2});
    entries.push_back({at + "amplifier.warming_1_per_s", &coil->warming_1_per_s});
    entries.push_back({at + "amplifier.away_steady_ratio", &coil->away_steady_ratio});
    entries.push_back({at + "amplifier.away_time_constant_ratio", &coil->away_time_constant_ratio});
  }
  entries.push_back({at + "sensor.bandwidth_hz", &b.sensor.bandwidth_hz});
  entries.push_back({at + "sensor.noise_rms_m", &b.sensor.noise_rms_m});
  entries.push_back({at + "sensor.range_m", &b.sensor.range_m});
  entries.push_back({at + "sensor.gain", &b.sensor.gain});
  entries.push_back({at + "touchdown.clearance_m", &b.touchdown.clearance_m});
  entries.push_back({at + "touchdown.stiffness_n_per_m", &b.touchdown.stiffness_n_per_m});
  entries.push_back({at + "touchdown.damping_n_s_per_m", &b.touchdown.damping_n_s_per_m});
  entries.push_back({at + "touchdown.friction", &b.touchdown.friction});
  entries.push_back({at + "touchdown.journal_radius_m", &b.touchdown.journal_radius_m});
}

void AddGear(std::vector<Entry>& entries, const std::string& at, gear::GearPair& pair) {
  entries.push_back({at + "stiffness_n_per_m", &pair.stiffness_n_per_m});
  entries.push_back({at + "damping_n_s_per_m", &pair.damping_n_s_per_m});
  entries.push_back({at + "driving_torque_n_m", &pair.driving_torque_n_m});
  entries.push_back({at + "backlash_m", &pair.imperfection.backlash_m});
  entries.push_back({at + "friction", &pair.imperfection.friction});
  for (auto* wheel : {&pair.driving, &pair.driven}) {
    const std::string name = at + (wheel == &pair.driving ? "driving." : "driven.");
    entries.push_back({name + "runout_m", &wheel->runout_m});
    entries.push_back({name + "runout_phase_rad", &wheel->runout_phase_rad});
  }
  for (std::size_t i = 0; i < pair.transmission_error.size(); ++i) {
    const std::string name = at + fmt::format("transmission_error[{}].", i);
    entries.push_back({name + "amplitude_m", &pair.transmission_error[i].amplitude_m});
    entries.push_back({name + "phase_rad", &pair.transmission_error[i].phase_rad});
  }
}

void AddEffect(std::vector<Entry>& entries, const std::string& at, effect::EffectConfig& e) {
  const auto parameters = effect::At(e.id).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    entries.push_back({at + effect::SiName(parameters[k]), &e.values[k]});
  }
  entries.push_back({at + "strength", &e.strength});
  entries.push_back({at + "at_s", &e.at_s});
  entries.push_back({at + "ramp_s", &e.ramp_s});
}

// The one table of names: reading, setting and listing all walk through it.
std::vector<Entry> Entries(PlantParameters& p) {
  std::vector<Entry> entries{{"delay_samples", &p.config.delay_samples},
                             {"gravity_m_per_s2", &p.config.gravity_m_per_s2},
                             {"gravity_direction_rad", &p.config.gravity_direction_rad}};
  entries.push_back(
      {"drive.max_acceleration_rad_per_s2", &p.config.drive.max_acceleration_rad_per_s2});
  entries.push_back({"drive.coast_down_1_per_s", &p.config.drive.coast_down_1_per_s});
  entries.push_back({"drive.coast_down_rad_per_s2", &p.config.drive.coast_down_rad_per_s2});
  entries.push_back({"drive.polar_inertia_kg_m2", &p.config.drive.polar_inertia_kg_m2});
  // The rigid modes have neither frequency nor damping: a free rotor's cannot be set. Geared
  // shafts that stand on springs have none.
  const bool one_rotor = p.config.shafts.empty();
  for (Eigen::Index i = one_rotor ? p.modes.rigid_modes : 0; i < p.modes.frequency_rad_per_s.size();
       ++i) {
    if (!one_rotor && p.modes.frequency_rad_per_s[i] == 0.0) continue;
    const std::string at = fmt::format("rotor.modes[{}].", i);
    entries.push_back({at + "frequency_hz", &p.modes.frequency_rad_per_s[i], 1.0 / kTwoPi});
    entries.push_back({at + "damping_ratio", &p.modes.damping_ratio[i]});
  }
  for (std::size_t i = 0; i < p.config.bearings.size(); ++i) {
    AddBearing(entries, fmt::format("bearings[{}].", i), p.config.bearings[i]);
  }
  for (std::size_t i = 0; i < p.config.gears.size(); ++i) {
    AddGear(entries, fmt::format("gears[{}].", i), p.config.gears[i]);
  }
  for (std::size_t i = 0; i < p.config.unbalance.size(); ++i) {
    const std::string at = fmt::format("unbalance[{}].", i);
    entries.push_back({at + "moment_kg_m", &p.config.unbalance[i].moment_kg_m});
    entries.push_back({at + "phase_rad", &p.config.unbalance[i].phase_rad});
  }
  for (std::size_t i = 0; i < p.config.effects.size(); ++i) {
    AddEffect(entries, fmt::format("effects[{}].", i), p.config.effects[i]);
  }
  return entries;
}

Entry Find(PlantParameters& parameters, std::string_view name) {
  const auto entries = Entries(parameters);
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [name](const Entry& entry) { return entry.name == name; });
  if (found != entries.end()) return *found;
  const auto closer = [name](const Entry& a, const Entry& b) {
    return EditDistance(name, a.name) < EditDistance(name, b.name);
  };
  const auto nearest = std::min_element(entries.begin(), entries.end(), closer);
  throw BadInput(fmt::format("the rig has no parameter '{}'; the nearest of its {} is '{}'", name,
                             entries.size(), nearest->name));
}

}  // namespace

std::vector<std::string> ParameterNames(const PlantParameters& parameters) {
  PlantParameters copy = parameters;
  std::vector<std::string> names;
  for (auto& entry : Entries(copy)) names.push_back(std::move(entry.name));
  return names;
}

double GetParameter(const PlantParameters& parameters, std::string_view name) {
  PlantParameters copy = parameters;
  const Entry entry = Find(copy, name);
  return *entry.stored * entry.scale;
}

void SetParameter(PlantParameters& parameters, std::string_view name, double value) {
  const Entry entry = Find(parameters, name);
  *entry.stored = value / entry.scale;
}

}  // namespace levitas::plant
