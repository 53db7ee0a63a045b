#pragma once
// What a simulated rig is, without what it does: reduced rotor and every constant of a time step.
//
// Use        immutable and shared by all copies of a Plant. To change a parameter, copy
//            parameters(), change it (parameter_access.hpp names them all), build a new model:
//            microseconds, since the finite elements are not touched.
// Failure    construction throws std::invalid_argument for an impossible description.
// Thread     any number of readers.

#include <array>
#include <vector>

#include "plant_sim/amplifier/amplifier.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/rotor/finite_element.hpp"
#include "plant_sim/sensor/sensor.hpp"
#include "plant_sim/support/touchdown.hpp"

namespace levitas::plant {

/// The rig after modal reduction: the numbers that can be set by name. `config.rotor` only says
/// where `modes` came from.
struct PlantParameters {
  PlantConfig config;
  rotor::ModalRotor modes;
  rotor::ModalTorsion torsion{};                  ///< of geared shafts; empty for one rotor
  std::vector<Eigen::Index> first_torsion_row{};  ///< of each shaft, in torsion.shapes
};

/// Finite elements and modal reduction. Throws std::invalid_argument.
[[nodiscard]] PlantParameters Reduce(const PlantConfig& config);

/// Constants of one step length. Arrays run over the modes of both planes: x plane, then y plane;
/// behind them the torsional modes.
struct StepTable {
  int substeps{};
  double duration_s{};  ///< of one substep
  std::vector<double> xx, xv, vx, vv, x0, v0, x1, v1;
  std::vector<amplifier::Step> amplifier;  ///< per bearing
  std::vector<sensor::FilterStep> sensor;  ///< per bearing
};

/// One bearing as the time step needs it.
struct BearingModel {
  magnet::Magnet magnet;
  amplifier::Limits amplifier;
  sensor::Converter converter;
  support::Touchdown touchdown;
  bool has_touchdown{};
  std::vector<double> actuator_shape;  ///< per mode
  std::vector<double> sensor_shape;    ///< per mode
};

class PlantModel {
 public:
  explicit PlantModel(const PlantConfig& config) : PlantModel(Reduce(config)) {}
  explicit PlantModel(PlantParameters parameters);

  [[nodiscard]] const PlantParameters& parameters() const noexcept { return parameters_; }
  [[nodiscard]] const PlantConfig& config() const noexcept { return parameters_.config; }
  [[nodiscard]] const StateLayout& layout() const noexcept { return layout_; }
  [[nodiscard]] std::size_t axes() const noexcept { return 2 * bearings_.size(); }
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
  /// Phi^T G Phi by columns, per unit speed.
  [[nodiscard]] const std::vector<double>& gyroscopic() const noexcept { return gyroscopic_; }
  /// Constant modal force of gravity, x plane then y plane.
  [[nodiscard]] const std::vector<double>& gravity() const noexcept { return gravity_; }
  /// Modal unbalance, complex: real parts, then imaginary parts [sqrt(kg) m].
  [[nodiscard]] const std::vector<double>& unbalance() const noexcept { return unbalance_; }
  /// Modal coordinates of a rigid displacement: unit translation, and unit slope about z = 0.
  [[nodiscard]] const Eigen::MatrixX2d& rigid() const noexcept { return rigid_; }

 private:
  void BuildRotor();
  void BuildBearings();
  void BuildSteps();

  PlantParameters parameters_;
  StateLayout layout_;
  std::vector<BearingModel> bearings_;
  std::array<StepTable, 2> steps_;
  std::size_t whole_delay_{};
  std::vector<double> gyroscopic_, gravity_, unbalance_;
  Eigen::MatrixX2d rigid_;
  TrainModel train_;
};

}  // namespace levitas::plant
