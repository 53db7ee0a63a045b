#pragma once
// The unknowns of a rig in modal coordinates, as one vector with names, priors and what is fitted.
//
// Model     mass-normalised modes of each plane, docs/derivations.md (9)-(12): two rigid ones from
//           mass, centre and inertia (shapes 1/sqrt(m) and (z - zc)/sqrt(It), planes where the rig
//           file says), m bending ones with free deflections at actuator and sensor planes.
// Vector    positive numbers as logarithms, deflections times sqrt(m_nominal): steps of like size.
// Prior     standard deviation of a parameter about the rig file: wide, so that the data decide
//           where they can; it only holds directions that such data do not identify.
// Units     SI in `Rotor` and `Physical`; the vector is dimensionless but for the delay (samples).
// Thread    any.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "plant_sim/plant/plant_config.hpp"

namespace levitas::identification {

/// Where each unknown stands in the vector; nb bearings, axes = 2 nb, m bending modes.
struct ModalLayout {
  Eigen::Index bearings{};
  Eigen::Index bending{};
  Eigen::Index mass{}, centre{}, inertia{};
  Eigen::Index frequency{};   ///< m: ln(rad/s)
  Eigen::Index damping{};     ///< m: ln
  Eigen::Index shape{};       ///< m x 2 nb, by modes: actuator planes, then sensor planes
  Eigen::Index ki{};          ///< per axis: ln(N/A)
  Eigen::Index ks{};          ///< per axis: ln(N/m)
  Eigen::Index gain{};        ///< per axis: ln
  Eigen::Index delay{};       ///< samples
  Eigen::Index amplifier{};   ///< per bearing: ln(Hz)
  Eigen::Index sensor{};      ///< per bearing: ln(Hz)
  Eigen::Index gyroscopic{};  ///< lower triangle by rows, tilt first, then the bending modes
  Eigen::Index size{};

  ModalLayout(Eigen::Index bearing_count, Eigen::Index bending_modes);
  [[nodiscard]] Eigen::Index axes() const noexcept { return 2 * bearings; }
  [[nodiscard]] Eigen::Index modes() const noexcept { return 2 + bending; }
  [[nodiscard]] Eigen::Index shape_at(Eigen::Index mode, Eigen::Index plane) const noexcept {
    return shape + mode * 2 * bearings + plane;
  }
  [[nodiscard]] Eigen::Index gyroscopic_at(Eigen::Index row, Eigen::Index column) const noexcept {
    const Eigen::Index high = row > column ? row : column;
    const Eigen::Index low = row > column ? column : row;
    return gyroscopic + high * (high + 1) / 2 + low;
  }
};

/// Modes of the rig file above those that are fitted: their compliance is felt in the band.
struct ModesBeyond {
  Eigen::VectorXd frequency_rad_per_s;
  Eigen::MatrixXd actuator, sensor;  ///< modes x bearings [1/sqrt(kg)]
};

/// Known parameters of the rig, which are not fitted.
struct ModalFrame {
  ModalLayout layout;
  Eigen::VectorXd actuator_z_m;
  Eigen::VectorXd sensor_z_m;
  double period_s{};
  double nominal_mass_kg{};
  Eigen::VectorXd bias_current_a,
      gap_m;  ///< per bearing: what the magnets' nonlinearity scales with
  ModesBeyond beyond;
};

/// Vector in physical numbers.
struct Physical {
  double mass_kg{}, centre_z_m{}, inertia_kg_m2{};
  Eigen::VectorXd frequency_rad_per_s;           ///< all modes, the rigid ones 0
  Eigen::VectorXd damping_ratio;                 ///< all modes
  Eigen::MatrixXd actuator;                      ///< modes x bearings [1/sqrt(kg)]
  Eigen::MatrixXd sensor;                        ///< modes x bearings
  Eigen::VectorXd ki_n_per_a, ks_n_per_m, gain;  ///< per axis
  double delay_samples{};
  Eigen::VectorXd amplifier_hz, sensor_hz;  ///< per bearing
  Eigen::MatrixXd gyroscopic;               ///< modes x modes, symmetric, [1]
};

[[nodiscard]] Physical ToPhysical(const ModalFrame& frame, const Eigen::VectorXd& vector);

struct ModalStart {
  ModalFrame frame;
  Eigen::VectorXd vector;  ///< the rig file's numbers
  Eigen::VectorXd prior;   ///< standard deviations
  std::vector<std::string> names;
};

/// From a rig file, with its first `bending_modes` bending modes; modes that the file does not have
/// start at 1 rad/s, far below the band, with small deflections of alternating sign.
[[nodiscard]] ModalStart StartFromRig(const plant::PlantConfig& rig, Eigen::Index bending_modes);

}  // namespace levitas::identification
