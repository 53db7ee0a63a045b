#pragma once
// Torsion of a shaft: inertias on a line of springs, in modal coordinates.
//
// Equation   J th'' + K th = torque, per inertia; of a beam: G Ip/l per element, its inertia shared
//            consistently, discs and rings with their polar inertia. Free but for ground stiffness.
//            docs/derivations.md (G11)-(G12).
// Units      rad, kg m2, N m/rad. Thread: any; allocates. Failure: std::invalid_argument.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/rotor/shaft_config.hpp"

namespace levitas::rotor {

/// Mass-normalised torsional modes: q'' + 2 z w q' + w^2 q = Theta^T torque.
struct ModalTorsion {
  Eigen::VectorXd frequency_rad_per_s;  ///< 0: the shaft turns as a whole
  Eigen::VectorXd damping_ratio;
  Eigen::MatrixXd shapes;        ///< rotation of each inertia or node, places x modes
  std::vector<double> node_z_m;  ///< of a beam; empty for inertias
};

/// Inertias and springs as given.
[[nodiscard]] ModalTorsion ReduceTorsion(const Torsion& torsion);
/// "motor to pinion": the springs that gauges measure, shaft by shaft; the order of every record.
[[nodiscard]] std::vector<std::string> GaugedCouplings(const std::vector<Shaft>& shafts);
/// Of a beam on the same nodes as its bending model.
[[nodiscard]] ModalTorsion ReduceTorsion(const RotorConfig& beam,
                                         const std::vector<double>& node_z_m, double damping_ratio);

}  // namespace levitas::rotor
