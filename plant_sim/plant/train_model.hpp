#pragma once
// Geared shafts as the time step needs them: shafts turning at fixed ratios, their supports, their
// gears. Empty for a rig with one rotor.
//
// Coordinates  the modes of all shafts side by side, the same in both planes, then the torsional
//              modes. A shape is a row over the modes of one plane, a twist one over the torsional
//              modes. docs/derivations.md (G13)-(G15).
// Rotation     shaft s turns at ratio_s times the speed of the first; -z1/z2 through a gear pair.
// Failure      std::invalid_argument naming the shaft or gear. Thread: any; constant afterwards.

#include <Eigen/Core>
#include <vector>

#include "plant_sim/gear/mesh.hpp"
#include "plant_sim/gear/transmission_error.hpp"
#include "plant_sim/plant/plant_config.hpp"
#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/rotor/torsion_line.hpp"

namespace levitas::plant {

inline constexpr std::size_t kMaxShafts = 4;
inline constexpr std::size_t kMaxGears = 3;

/// Modal coordinates of all shafts; gyroscopic matrices carry the ratio of their shaft.
struct TrainModes {
  rotor::ModalRotor bending;
  rotor::ModalTorsion torsion;
  std::vector<Eigen::Index> first_torsion_row;  ///< of each shaft, in torsion.shapes
};

/// Speed of each shaft over that of the first.
[[nodiscard]] std::vector<double> SpeedRatios(const PlantConfig& config);
[[nodiscard]] TrainModes ReduceTrain(const PlantConfig& config);

struct ShaftUnbalance {
  double ratio{};
  std::vector<double> real, imaginary;  ///< modal, over all modes [sqrt(kg) m]
};

struct SupportModel {
  std::vector<double> shape;
  double stiffness_x_n_per_m{}, stiffness_y_n_per_m{};
  double damping_x_n_s_per_m{}, damping_y_n_s_per_m{};
};

struct TwistDamper {
  std::vector<double> twist;
  double damping_n_m_s_per_rad{};
};

/// Of a shaft whose torsion is inertias on springs: where a torque from outside can act.
struct TwistInertia {
  std::string name;
  std::vector<double> twist;
};

struct WheelModel {
  std::size_t shaft{};
  double ratio{};
  gear::Vector runout_m;  ///< at angle 0
};

struct MeshModel {
  gear::MeshLaw law;
  gear::TransmissionError error;
  WheelModel driving, driven;
  std::vector<double> shape;  ///< displacement of the driving wheel minus that of the driven one
  std::vector<double> twist;  ///< base radius times rotation, both wheels
  std::vector<double> driving_shape, driven_shape;  ///< displacement of each wheel
};

/// A misaligned coupling of one shaft: a force and an uneven rotation at a multiple of the shaft's
/// own turns, (G17)-(G19). The phasors stand at angle 0 and turn with the shaft.
struct CouplingModel {
  std::size_t shaft{};
  double ratio{};
  int order{};                ///< negative: against the shaft's sense of rotation
  std::vector<double> shape;  ///< of the plane that it pushes
  gear::Vector force_n;
  gear::Vector rotation_rad;  ///< its real part is the error of rotation
  std::size_t mesh{};
  double base_radius_m{};     ///< of the wheel on this shaft; 0: the spring below is twisted
  std::vector<double> twist;  ///< torque of the coupling's spring per error [N m/rad]; may be empty
};

struct TrainModel {
  std::size_t shafts{};  ///< 0: the rig has one rotor and none of this
  std::size_t twists{};  ///< torsional modes of all shafts
  std::vector<double> ratio;
  double turns_per_repeat{1.0};  ///< turns of the first shaft after which all stand alike
  std::vector<ShaftUnbalance> unbalance;
  std::vector<SupportModel> supports;
  std::vector<TwistDamper> dampers;
  std::vector<TwistInertia> inertias;  ///< of all shafts, one shaft after the other
  std::vector<MeshModel> meshes;
  std::vector<CouplingModel> couplings;  ///< that are misaligned
  /// Modal coordinates of one plane that bring the bearings to given places with least strain.
  Eigen::MatrixXd placement;
};

[[nodiscard]] TrainModel BuildTrain(const PlantConfig& config, const TrainModes& modes);

}  // namespace levitas::plant
