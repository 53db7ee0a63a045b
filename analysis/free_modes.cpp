#include "analysis/free_modes.hpp"

#include "analysis/rotor_planes.hpp"
#include "plant_sim/plant/magnet_of.hpp"
#include "plant_sim/rotor/finite_element.hpp"

namespace levitas::analysis {
namespace {

BearingConstants Constants(const plant::BearingConfig& bearing) {
  const plant::MagnetConfig& config = bearing.magnet;
  const magnet::Magnet magnet = plant::MagnetOf(config);
  return {bearing.name, magnet::ForcePerCurrent(magnet, config.bias_current_a),
          magnet::NegativeStiffness(magnet, config.bias_current_a)};
}

}  // namespace

FreeModes ComputeFreeModes(const plant::PlantConfig& plant,
                           const std::vector<double>& speeds_rad_per_s, std::size_t modes) {
  FreeModes result;
  for (const auto& bearing : plant.bearings) result.bearings.push_back(Constants(bearing));
  const auto add = [&](const auto& model) {
    result.rotor_mass_kg = model.total_mass_kg;
    for (const double speed : speeds_rad_per_s) {
      rotor::WhirlFrequencies whirl = rotor::FreeWhirl(model, speed, modes);
      result.whirl.push_back({speed, std::move(whirl.backward_hz), std::move(whirl.forward_hz)});
    }
  };
  if (plant.rotor.given) {
    add(rotor::FromGivenModes(*plant.rotor.given, PlanesOf(plant)));
  } else {
    add(rotor::Assemble(plant.rotor, PlanesOf(plant)));
  }
  return result;
}

}  // namespace levitas::analysis
