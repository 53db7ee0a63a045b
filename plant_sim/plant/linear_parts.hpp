#pragma once
// The pieces of the linear model: what each part of the rig adds to x' = A x.
// Equations of linear_model.hpp; states as StateLayout. Thread: any.

#include <Eigen/Core>
#include <vector>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::plant {

/// Free modes and gyroscopic coupling.
void AddRotor(const PlantModel& model, double speed_rad_per_s, Eigen::MatrixXd& a);
/// Springs and rotating dampers on the shaft.
void AddShaftEffects(const PlantModel& model, double speed_rad_per_s, Eigen::MatrixXd& a);
/// Force of a bearing per current that makes flux and per displacement, in the rig's axes.
struct Slopes {
  Eigen::Matrix2d current{Eigen::Matrix2d::Zero()};
  Eigen::Matrix2d displacement{Eigen::Matrix2d::Zero()};
};
/// Of the centred rotor with the bias alone in both coils.
[[nodiscard]] Slopes SlopesAtCentre(const PlantModel& model, std::size_t bearing);

/// F = ki i + ks x of both axes of a bearing, what the iron remembers, and the housing.
void AddMagnets(const PlantModel& model, std::size_t bearing, const Slopes& slopes,
                Eigen::MatrixXd& a);
/// One newton along a plane (0 x, 1 y) at a bearing: on the rotor, and back on its housing.
[[nodiscard]] Eigen::VectorXd Reaction(const PlantModel& model, std::size_t bearing, int plane,
                                       Eigen::Index states);
/// Displacement along a plane at the magnet, relative to its housing.
[[nodiscard]] Eigen::RowVectorXd SeenByMagnet(const PlantModel& model, std::size_t bearing,
                                              int plane, Eigen::Index states);
/// The current that makes flux on an axis, as a row; with it the lags' own equations into `a`.
[[nodiscard]] Eigen::RowVectorXd Flux(const PlantModel& model, std::size_t axis,
                                      Eigen::MatrixXd& a);
/// Sensors of a bearing: filters of first or second order, curves by their slope at the centre.
void AddSensors(const PlantModel& model, std::size_t bearing, Eigen::MatrixXd& a);

/// The model with given slopes of its magnets.
[[nodiscard]] LinearModel LineariseWith(const PlantModel& model, double speed_rad_per_s,
                                        const std::vector<Slopes>& slopes);

}  // namespace levitas::plant
