#pragma once
// The rig as balancing sees it: its linear model at the point where the record stands, with inputs
// for unbalance at planes of the shaft, as a function of what a rig file does not know exactly.
//
// Model      x' = (A0 + w A1) x + B i + H w^2 U e^{j w t},  y = C x, i the commanded control
//            currents behind delay and hold, U [kg m] complex, one per plane: the direction of the
//            heavy spot from the rotor's own x axis, which stands at the recorded angle. Along x
//            an unbalance acts with U, along y with -j U. docs/derivations.md (13), (41).
// Unknowns   relative deviations of ki and ks per axis, frequency, damping (logarithm), gyroscopic
//            effect and mass of the rotor, bandwidths per bearing, gain per probe; metres of a
//            probe's place, samples of the delay. Each with the standard deviation that the rig
//            file's `tolerances` state.
// Point      of recorded means: currents and places at the magnets, bias included.
// Frame      bearing frame; units SI. Thread: any; allocates.
// Failure    BadInput: geared shafts, a lone axis, coils on a voltage, a plane off the shaft.

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/operating_point.hpp"
#include "plant_sim/plant/plant_parameters.hpp"

namespace levitas::balancing {

enum class UnknownKind : std::uint8_t {
  kCurrentGain,
  kStiffness,
  kModeFrequency,
  kModeDamping,
  kGyroscopic,
  kMass,
  kAmplifierBandwidth,
  kSensorBandwidth,
  kSensorGain,
  kSensorPosition,
  kDelay
};

struct Unknown {
  UnknownKind kind{};
  std::size_t index{};  ///< axis, flexible mode (0: the first) or bearing
  double deviation{};   ///< standard, of the healthy rig
};

/// "ki de_x", "frequency of mode 1"
[[nodiscard]] std::string NameOf(const Unknown& unknown, const RigNumbers& rig);

struct RigMatrices {
  Eigen::MatrixXd a0, a1;       ///< states x states, per rad/s
  Eigen::MatrixXd b, c;         ///< states x axes, axes x states
  Eigen::MatrixXcd unbalance;   ///< H: states x planes
  Eigen::MatrixXd push;         ///< states x axes: one newton at the magnet of an axis
  Eigen::MatrixXd seen;         ///< axes x states: displacement at the magnet
  Eigen::Index coil_current{};  ///< first state of the control currents in the coils
  double delay_s{};
};

/// What a record says of the point about which the model is linear.
struct RecordedPoint {
  Eigen::VectorXd position_m, current_a;  ///< means per axis, at the sensors
  double bias_current_a{};
};

class BalanceRig {
 public:
  BalanceRig(const configuration::RigFile& rig, const RecordedPoint& point,
             std::vector<double> planes_z_m);

  [[nodiscard]] const std::vector<Unknown>& unknowns() const noexcept { return unknowns_; }
  /// `place`: one number per unknown, 0 = as in the rig file.
  [[nodiscard]] RigMatrices At(const Eigen::VectorXd& place) const;
  /// First harmonic of an axis' magnet force for these amplitudes, less what its slopes at the
  /// point say [N]: 1.5 (x/s0)^2 of ks x at rest.
  [[nodiscard]] std::complex<double> ForceBeyondSlopes(Eigen::Index axis,
                                                       std::complex<double> current_a,
                                                       std::complex<double> displacement_m) const;
  [[nodiscard]] Eigen::Index axes() const noexcept { return axes_; }
  [[nodiscard]] Eigen::Index planes() const noexcept {
    return static_cast<Eigen::Index>(planes_z_m_.size());
  }
  [[nodiscard]] double period_s() const noexcept { return period_s_; }
  [[nodiscard]] const configuration::RigFile& rig() const noexcept { return rig_; }
  /// Deflection of each mode at each plane [1/sqrt(kg)], modes x planes, of the rig file.
  [[nodiscard]] const Eigen::MatrixXd& shapes() const noexcept { return shapes_; }
  [[nodiscard]] const Eigen::VectorXd& frequency_rad_per_s() const noexcept {
    return nominal_.modes.frequency_rad_per_s;
  }
  /// Largest |deflection| of each mode along the shaft [1/sqrt(kg)].
  [[nodiscard]] Eigen::VectorXd largest_deflection() const {
    return nominal_.modes.shapes.cwiseAbs().colwise().maxCoeff().transpose();
  }
  [[nodiscard]] Eigen::Index rigid_modes() const noexcept { return nominal_.modes.rigid_modes; }
  /// Centre of mass: where a rigid shift and a rigid tilt are orthogonal.
  [[nodiscard]] double centre_z_m() const;
  [[nodiscard]] double mass_kg() const noexcept { return nominal_.modes.total_mass_kg; }
  /// Force of an axis' magnet per ampere and per metre, of the rig file at the point.
  [[nodiscard]] double gap_m(Eigen::Index axis) const {
    return nominal_.config.bearings[static_cast<std::size_t>(axis / 2)].magnet.gap_m;
  }
  [[nodiscard]] const Eigen::VectorXd& ki_n_per_a() const noexcept { return ki_; }
  [[nodiscard]] const Eigen::VectorXd& ks_n_per_m() const noexcept { return ks_; }

 private:
  void ListUnknowns();
  [[nodiscard]] bool MayMove(std::size_t bearing, double deviation_m) const;

  configuration::RigFile rig_;
  std::vector<double> planes_z_m_;
  plant::PlantParameters nominal_;
  plant::OperatingPoint point_;
  std::vector<Unknown> unknowns_;
  std::vector<magnet::Magnet> magnets_;  ///< per bearing
  Eigen::MatrixXd shapes_;
  Eigen::VectorXd ki_, ks_;
  Eigen::Index axes_{};
  double period_s_{};
};

}  // namespace levitas::balancing
