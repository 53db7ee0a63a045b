#pragma once
// What geared shafts add to the linear model of the derivatives: supports, dampers, mean meshes.
//
// Equation   q'' = ... - stiffness q - damping q' over the modes of both planes
//            (plant/train_linear), the meshes by the ratios that the terms in force give them.
// Thread     any; pure.

#include <Eigen/Core>

#include "diagnosis/model/linear_change.hpp"
#include "diagnosis/model/rig_view.hpp"

namespace levitas::diagnosis {

struct TrainCoupling {
  Eigen::MatrixXd stiffness, damping;  ///< 2 modes x 2 modes; empty for a rig with one rotor
};

[[nodiscard]] TrainCoupling CouplingOf(const RigView& rig, const LinearChange& change);

}  // namespace levitas::diagnosis
