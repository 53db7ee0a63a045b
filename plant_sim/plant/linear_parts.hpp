#pragma once
// The pieces of the linear model: what each part of the rig adds to x' = A x.
// Equations of linear_model.hpp; states as StateLayout. Thread: any.

#include <Eigen/Core>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {

/// Free modes and gyroscopic coupling.
void AddRotor(const PlantModel& model, double speed_rad_per_s, Eigen::MatrixXd& a);
/// Springs and rotating dampers on the shaft.
void AddShaftEffects(const PlantModel& model, double speed_rad_per_s, Eigen::MatrixXd& a);
/// F = ki i + ks x of both axes of a bearing, what the iron remembers, and the housing.
void AddMagnets(const PlantModel& model, std::size_t bearing, Eigen::MatrixXd& a);
/// First-order sensors of a bearing.
void AddSensors(const PlantModel& model, std::size_t bearing, Eigen::MatrixXd& a);

}  // namespace levitas::plant
