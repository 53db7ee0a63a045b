#pragma once
// Geared shafts in the linear model: torsional modes, supports and the mean mesh, added to its A.
//
// Equation   docs/derivations.md (G16). Thread: any; allocates.

#include <Eigen/Core>

namespace levitas::plant {

class PlantModel;

/// `a` is ordered as StateLayout. Nothing is added for a rig with one rotor.
void AddTrain(const PlantModel& model, Eigen::MatrixXd& a);

/// Row over all coordinates (x plane, y plane, torsion) that gives the displacement of gear pair
/// `mesh` along the direction (x, y).
[[nodiscard]] Eigen::RowVectorXd MeshRow(const PlantModel& model, std::size_t mesh, double x,
                                         double y);

}  // namespace levitas::plant
