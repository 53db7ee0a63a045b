#pragma once
// What a simulated rig is, without what it does: reduced rotor and every constant of a time step.
//
// Use        immutable and shared by all copies of a Plant. To change a parameter, copy
//            parameters(), change it (parameter_access.hpp names them all), build a new model:
//            microseconds, since the finite elements are not touched.
// Effects    act through effects() and through the numbers below, which are those of the rig with
//            its effects at their present strength; parameters() stays as it was given.
// Failure    construction throws std::invalid_argument for an impossible description.
// Thread     any number of readers.

#include <array>
#include <span>
#include <vector>

#include "plant_sim/amplifier/amplifier.hpp"
#include "plant_sim/amplifier/voltage_coil.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/applied_effects/apply_effects.hpp"
#include "plant_sim/plant/applied_effects/effect_model.hpp"
#include "plant_sim/plant/applied_effects/gear_effects.hpp"
#include "plant_sim/plant/mode_step.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/sensor/characteristic.hpp"
#include "plant_sim/sensor/sensor.hpp"
#include "plant_sim/support/touchdown.hpp"

namespace levitas::plant {

/// Finite elements and modal reduction. Throws std::invalid_argument.
[[nodiscard]] PlantParameters Reduce(const PlantConfig& config);

/// What holds the y direction of a rotor whose only bearing acts in x: stiff, and damped enough to
/// come to rest within a few of its periods.
inline constexpr double kGuideFrequencyHz = 1000.0;
inline constexpr double kGuideDamping = 0.5;

/// Constants of one step length. Arrays run over the modes of both planes: x plane, then y plane;
/// behind them the torsional modes.
struct StepTable {
  int substeps{};
  double duration_s{};  ///< of one substep
  std::vector<double> xx, xv, vx, vv, x0, v0, x1, v1;
  std::vector<amplifier::Step> amplifier;  ///< per axis
  std::vector<sensor::FilterStep> sensor;  ///< per axis
  std::vector<ModeStep> second_order;      ///< per axis; empty where all filters are of first order
  std::vector<sensor::FilterStep> eddy;    ///< per axis and lag; empty without eddy currents
  std::vector<ModeStep> housing;           ///< per bearing; empty when none moves
};

/// One bearing as the time step needs it.
struct BearingModel {
  magnet::Magnet magnet;
  amplifier::Limits amplifier;
  /// Of a rig without current loops: towards +x, and away from it.
  std::array<amplifier::VoltageCoil, 2> coils;
  double warming_1_per_s{};  ///< of both
  bool x_only{};             ///< no force in y, where a guide holds the rotor
  double far_gap_m{};        ///< of the coil away from +x, the rotor centred
  sensor::Converter converter;
  SensorFilter filter{};
  sensor::Characteristic characteristic;
  support::Touchdown touchdown;
  bool has_touchdown{};
  double speed_ratio{1.0};             ///< of its shaft: speed over that of the first, (G15)
  std::vector<double> actuator_shape;  ///< per mode
  std::vector<double> sensor_shape;    ///< per mode

  [[nodiscard]] bool on_voltage() const noexcept { return coils[0].time_constant_s > 0.0; }
};

class PlantModel {
 public:
  explicit PlantModel(const PlantConfig& config) : PlantModel(Reduce(config)) {}
  explicit PlantModel(PlantParameters parameters);

  [[nodiscard]] const PlantParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const PlantConfig& config() const noexcept { return parameters_.config; }
  [[nodiscard]] const StateLayout& layout() const noexcept { return layout_; }
  [[nodiscard]] std::size_t axes() const noexcept { return 2 * bearings_.size(); }
  /// A lone bearing that acts in x only: its y coils carry their bias and are never commanded, its
  /// y probe is never read, a guide holds the rotor.
  [[nodiscard]] bool guided() const noexcept {
    return !config().bearings.empty() && config().bearings.front().x_only;
  }
  /// What a frame holds.
  [[nodiscard]] std::size_t channels() const noexcept { return guided() ? 1 : axes(); }
  [[nodiscard]] const std::vector<BearingModel>& bearings() const noexcept { return bearings_; }
  /// Before and after the instant, within a period, at which the delayed command changes; the first
  /// has no substeps when the delay is a whole number of samples.
  [[nodiscard]] const std::array<StepTable, 2>& steps() const noexcept { return steps_; }
  /// Modal coordinates in all: both planes and torsion.
  [[nodiscard]] std::size_t coordinates() const noexcept {
    return 2 * layout_.modes + layout_.twists;
  }
  /// Geared shafts; `shafts` is 0 for a rig with one rotor.
  [[nodiscard]] const TrainModel& train() const noexcept { return train_; }
  [[nodiscard]] std::size_t whole_delay() const noexcept { return whole_delay_; }
  /// Of the rig and of extra_delay together; the most that any strength can make of it.
  [[nodiscard]] double delay_samples() const noexcept { return now_.delay_samples; }
  [[nodiscard]] double most_delay_samples() const noexcept { return most_delay_samples_; }
  /// Frequencies [rad/s] and damping ratios of the modes.
  [[nodiscard]] const std::vector<double>& frequency() const noexcept {
    return now_.frequency_rad_per_s;
  }
  [[nodiscard]] const std::vector<double>& damping_ratio() const noexcept {
    return now_.damping_ratio;
  }
  [[nodiscard]] double amplifier_bandwidth_hz(std::size_t axis) const noexcept {
    return now_.amplifier_bandwidth_hz[axis];
  }
  [[nodiscard]] const EffectModel& effects() const noexcept { return effects_; }
  /// Strengths of the entries of config().effects, and all numbers with them. No allocation.
  void SetStrengths(std::span<const double> strengths) noexcept;
  /// Phi^T G Phi by columns, per unit speed.
  [[nodiscard]] const std::vector<double>& gyroscopic() const noexcept { return gyroscopic_; }
  /// Constant modal force of gravity and static loads, x plane then y plane.
  [[nodiscard]] const std::vector<double>& gravity() const noexcept { return gravity_; }
  [[nodiscard]] double gravity_direction_x() const noexcept { return gravity_direction_[0]; }
  [[nodiscard]] double gravity_direction_y() const noexcept { return gravity_direction_[1]; }
  /// Modal unbalance, complex: real parts, then imaginary parts [sqrt(kg) m].
  [[nodiscard]] const std::vector<double>& unbalance() const noexcept { return unbalance_; }
  /// Modal coordinates of a rigid displacement: unit translation, and unit slope about z = 0.
  [[nodiscard]] const Eigen::MatrixX2d& rigid() const noexcept { return rigid_; }

 private:
  void BuildRotor();
  void BuildBearings();
  void ReserveSteps();
  void RefreshRotor() noexcept;
  void RefreshShapes() noexcept;
  void RefreshDelay() noexcept;
  void RefreshSteps() noexcept;
  void RefreshStep(StepTable& table, double share) noexcept;
  /// Of the rigid modes' shapes: a heavier rotor moves less.
  [[nodiscard]] double RigidScale() const noexcept;

  PlantParameters parameters_;
  StateLayout layout_;
  std::vector<BearingModel> bearings_;
  std::array<StepTable, 2> steps_;
  std::size_t whole_delay_{};
  double most_delay_samples_{};
  std::vector<double> gyroscopic_, gravity_, unbalance_;
  Eigen::MatrixX2d rigid_, nominal_rigid_;
  std::array<double, 2> gravity_direction_{};
  double fraction_{};                                ///< of a sample, of the delay
  std::vector<std::vector<double>> nominal_shapes_;  ///< actuator, sensor of each bearing
  std::vector<std::vector<double>> unbalance_shapes_;
  EntryShapes entry_shapes_;
  RigNow now_;
  EffectModel effects_;
  TrainModel train_;
  NominalGears gears_;
};

}  // namespace levitas::plant
