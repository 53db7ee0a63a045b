#pragma once
// The numbers of a rig that terms need, taken once from the plant's model in the bearing frame.
//
// By chance  effects of the rig file that no model foretells, though it knows how often or how
//            large they are: lost frames, instants that scatter, the phase of the mains. The model
//            goes without them; who looks for them asks `by_chance` what is known.
// Thread  immutable after construction.

#include <memory>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "diagnosis/model/mesh_view.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::diagnosis {

struct RigView {
  RigView(const RigNumbers& numbers, const plant::PlantConfig& plant);

  RigNumbers numbers;
  std::shared_ptr<const plant::PlantModel> model;
  std::size_t axes{};
  std::size_t modes{};  ///< per plane
  double period_s{};
  std::vector<effect::EffectConfig> by_chance;  ///< of the rig file
  std::vector<double> omega_rad_per_s;          ///< per mode, 0 for the rigid ones
  std::vector<double> damping_ratio;
  std::vector<MeshView> meshes;  ///< empty for a rig with one rotor

  [[nodiscard]] bool geared() const noexcept { return !model->config().shafts.empty(); }
  /// Shape of the modes at a plane of the one rotor, and its slope.
  [[nodiscard]] std::vector<double> Shape(double z_m) const;
  [[nodiscard]] std::vector<double> Slope(double z_m) const;
  /// Rms of a mode's shape over the nodes of the one rotor: what it typically bends. At probes and
  /// magnets alone it would say little where these stand near the mode's nodes.
  [[nodiscard]] double ShapeRms(std::size_t mode) const;
  [[nodiscard]] const plant::BearingConfig& bearing(std::size_t axis) const {
    return model->config().bearings[axis / 2];
  }
  [[nodiscard]] const plant::BearingModel& magnet(std::size_t axis) const {
    return model->bearings()[axis / 2];
  }
  /// [m] rms of what a reading adds to the true position: noise, that of the file's `sensor_noise`
  /// included, and the converter's steps.
  [[nodiscard]] double ReadingNoise(std::size_t axis) const;
  [[nodiscard]] double bias_a(std::size_t axis) const {
    return bearing(axis).magnet.bias_current_a;
  }
};

}  // namespace levitas::diagnosis
