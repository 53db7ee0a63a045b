#pragma once
// The numbers of a rig that terms need, taken once from the plant's model.
//
// Thread  immutable after construction.

#include <memory>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "diagnosis/mesh_view.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::diagnosis {

struct RigView {
  RigView(const RigNumbers& numbers, const plant::PlantConfig& plant);

  RigNumbers numbers;
  std::shared_ptr<const plant::PlantModel> model;
  std::size_t axes{};
  std::size_t modes{};  ///< per plane
  double period_s{};
  std::vector<double> omega_rad_per_s;  ///< per mode, 0 for the rigid ones
  std::vector<double> damping_ratio;
  std::vector<MeshView> meshes;  ///< empty for a rig with one rotor

  [[nodiscard]] bool geared() const noexcept { return !model->config().shafts.empty(); }
  /// Shape of the modes at a plane of the one rotor, and its slope.
  [[nodiscard]] std::vector<double> Shape(double z_m) const;
  [[nodiscard]] std::vector<double> Slope(double z_m) const;
  [[nodiscard]] const plant::BearingConfig& bearing(std::size_t axis) const {
    return model->config().bearings[axis / 2];
  }
  [[nodiscard]] const plant::BearingModel& magnet(std::size_t axis) const {
    return model->bearings()[axis / 2];
  }
  [[nodiscard]] double bias_a(std::size_t axis) const {
    return bearing(axis).magnet.bias_current_a;
  }
};

}  // namespace levitas::diagnosis
