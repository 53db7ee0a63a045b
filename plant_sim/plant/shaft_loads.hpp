#pragma once
// What geared shafts load: the housing behind their bearings, and their own torsion.
//
// Housing  of each shaft what its own stiffness, supports and dampers push with, less the force of
//          its magnets, which stand on the housing: h = sum (K r + C r') - sum F. A lumped shaft
//          stands on rigid bearings, with K r the force of its bending on its disc. Teeth push both
//          shafts and no housing. Frame: bearing frame; [N].
// Torsion  of each shaft of inertias the torque of the spring behind each but the last,
//          M = k (theta_next - theta) [N m], relative to the rest of the model: without the mean
//          that the drive brings.
// Gauges   where a shaft has them: torque and twist of its springs as they are, without noise.
// Thread   any; allocates, Gauge does not. Failure: none; a rig with one rotor has neither.
// Not done contact forces of touchdown bearings; the housing's own motion.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/train_model.hpp"

namespace levitas::plant {

class ShaftLoads {
 public:
  explicit ShaftLoads(const PlantModel& model);

  /// One per shaft, at the plant's present state; the plant is one of that model.
  [[nodiscard]] std::vector<gear::Vector> Housing(const Plant& plant) const;
  /// One per name of twisted().
  [[nodiscard]] std::vector<double> Torques(const Plant& plant) const;
  /// Of the springs that gauges measure, as rotor::GaugedCouplings lists them: torque [N m] and
  /// twist [rad] at the present state. Both have room for all of them.
  void Gauge(const Plant& plant, std::span<double> torque_n_m,
             std::span<double> twist_rad) const noexcept;
  /// "motor to pinion".
  [[nodiscard]] const std::vector<std::string>& twisted() const noexcept { return twisted_; }

 private:
  struct Spring {
    std::vector<double> twist;  ///< theta_next - theta per torsional mode
    double stiffness_n_m_per_rad{};
    bool gauged{};
  };
  struct Foot {
    std::size_t shaft{};
    std::vector<double> shape;  ///< displacement per mode
    double kx{}, ky{}, cx{}, cy{};
  };

  std::size_t shafts_{};
  StateLayout layout_;
  std::vector<std::vector<double>> bending_;  ///< per shaft: force per modal displacement [N]
  std::vector<Foot> feet_;
  std::vector<Spring> springs_;
  std::vector<std::string> twisted_;
  std::vector<std::size_t> shaft_of_bearing_;
};

}  // namespace levitas::plant
