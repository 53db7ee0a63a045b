#pragma once
// Timoshenko beam finite elements of a rotor, in one plane of the complex coordinate r = x + j y.
//
// Equation    M r'' - j W G r' + K r = f, per node deflection and slope (r, r'); W rotor speed,
//             positive from x to y; G collects polar inertia. Derivation: docs/derivations.md.
// Sources     Nelson (1980), Timoshenko element with rotary inertia and gyroscopic effect;
//             Cowper (1966), shear coefficient 6(1+v)/(7+6v).

#include <Eigen/Core>
#include <vector>

#include "plant_sim/rotor/rotor_config.hpp"

namespace levitas::rotor {

struct FiniteElementModel {
  std::vector<double> node_z_m;
  Eigen::MatrixXd mass;        ///< [kg, kg m, kg m2], 2 per node: deflection, slope
  Eigen::MatrixXd gyroscopic;  ///< per unit speed, symmetric
  Eigen::MatrixXd stiffness;   ///< [N/m, N, N m]
  double total_mass_kg{};
};

/// A ring as the disc it is.
[[nodiscard]] Disc ToDisc(const Ring& ring);

/// Nodes fall on every section end, disc, ring and each z of `planes_m`.
[[nodiscard]] FiniteElementModel Assemble(const RotorConfig& config,
                                          const std::vector<double>& planes_m);

struct WhirlFrequencies {
  std::vector<double> backward_hz;  ///< magnitudes, ascending, flexible modes only
  std::vector<double> forward_hz;
};

/// Undamped free-free whirl frequencies of the full model at a speed, the first `count` of each.
[[nodiscard]] WhirlFrequencies FreeWhirl(const FiniteElementModel& model, double speed_rad_per_s,
                                         std::size_t count);

struct ModalRotor;
/// The same of a rotor in modal coordinates.
[[nodiscard]] WhirlFrequencies FreeWhirl(const ModalRotor& modal, double speed_rad_per_s,
                                         std::size_t count);

/// Modal coordinates of one plane, mass-normalised: q'' + 2 z w q' + w^2 q - j W G q' = Phi^T f.
struct ModalRotor {
  Eigen::VectorXd frequency_rad_per_s;  ///< 0 for the rigid modes, which come first
  Eigen::VectorXd damping_ratio;
  Eigen::MatrixXd gyroscopic;  ///< Phi^T G Phi
  Eigen::MatrixXd shapes;      ///< deflection at each node of the model, nodes x modes
  Eigen::MatrixXd slopes;      ///< slope at each node, nodes x modes
  std::vector<double> node_z_m;
  double total_mass_kg{};
  std::vector<std::size_t> node_shaft;  ///< shaft that each node is on; empty: all on shaft 0
  Eigen::Index rigid_modes{2};          ///< 1 for a rotor that cannot tilt
  Eigen::MatrixX2d rigid;  ///< modal coordinates of a unit shift and of a unit slope about z = 0

  /// Row of `shapes` at a plane that is a node (within 1e-9 m); throws std::invalid_argument else.
  [[nodiscard]] Eigen::RowVectorXd ShapeAt(double z_m, std::size_t shaft = 0) const;
};

[[nodiscard]] ModalRotor Reduce(const FiniteElementModel& model, std::size_t modes_per_plane,
                                double modal_damping_ratio);

/// The same from given modes, with a node at each of `planes_m`. A rigid body of mass m, transverse
/// inertia It and polar inertia Ip about zc: shapes 1/sqrt(m) and (z - zc)/sqrt(It), gyroscopic
/// Ip/It and the entries given; a mode of modal mass M: shape/sqrt(M). Throws std::invalid_argument
/// for impossible numbers.
[[nodiscard]] ModalRotor FromGivenModes(const GivenRotor& rotor, std::vector<double> planes_m);

}  // namespace levitas::rotor
