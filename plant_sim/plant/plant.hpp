#pragma once
// A simulated rig as a library: steps one sampling period at a time.
//
// Equation   modal rotor  q'' + D q' + L q + W G J q' = Phi^T f  (both planes;
//            docs/derivations.md), true nonlinear magnet force, amplifier, touchdown contact,
//            gravity, unbalance.
// Time       Sample() reads the sensors at t_n; Advance(command) integrates t_n -> t_n+1. The
//            command computed from sample n acts `delay_samples` periods after t_n; its drive part
//            acts at once.
// Start      bias current at its design value, as if levitated; RestInTouchdown() de-energises.
// Frame      bearing frame; readings and commands are those of the wires, by ProbeMap. A model that
//            never meets wires has straight ones (bearing_frame.hpp).
// Use        cheap to copy, no globals, no allocation in Sample and Advance, deterministic for a
//            seed. One instance per thread; many instances may run in parallel.
// Driving    open loop: give any command. Closed loop: feed Sample() to a controller. Observer
//            corrected: add a correction to mutable_state() between Sample and Advance.
// Failure    construction throws std::invalid_argument for an impossible description; a state that
//            is no longer finite stays so and is reported by finite().

#include <memory>
#include <span>
#include <string_view>

#include "common/frames.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::plant {

/// Command to the amplifiers and the drive, already decoded: what CurrentFrame carries.
struct PlantCommand {
  AxisArray control_current_a{};
  double bias_current_a{};
  bool amplifiers_enabled{true};
  bool drive_enabled{};
  double speed_set_point_rad_per_s{};
  double acceleration_limit_rad_per_s2{};
};

/// Where the state vector keeps what (indices into Plant::state()).
struct StateLayout {
  std::size_t modes{};         ///< per plane
  std::size_t q_x{}, q_y{};    ///< modal displacement, x plane and y plane
  std::size_t v_x{}, v_y{};    ///< modal velocity
  std::size_t coil_current{};  ///< control current in the coils, one per axis
  std::size_t sensor{};        ///< filtered position, one per axis
  std::size_t effects{};       ///< states of effects, if any: see effect_model.hpp
  std::size_t size{};
  std::size_t twists{};  ///< torsional modes of geared shafts
  std::size_t q_t{};     ///< their displacement, right behind q_y; their velocity right behind v_y
  std::size_t sensor_rates{};  ///< number of states behind `sensor`: d/dt of the filtered position,
                               ///< one per axis where any filter is of second order, else 0
  [[nodiscard]] std::size_t sensor_rate() const noexcept { return effects - sensor_rates; }
};

class PlantModel;  // reduced rotor and derived constants, shared by copies

class Plant {
 public:
  /// Builds the model (finite elements, modal reduction) and puts the rotor at rest in the centre.
  Plant(const PlantConfig& config, std::uint64_t seed);
  /// The same on a model that exists already: for many runs, or with parameters of one's own.
  Plant(std::shared_ptr<const PlantModel> model, std::uint64_t seed);
  Plant(const Plant&);
  Plant& operator=(const Plant&);
  Plant(Plant&&) noexcept;
  Plant& operator=(Plant&&) noexcept;
  ~Plant();

  /// Sensor frame at the present instant, noise and quantisation included. Call once per period.
  [[nodiscard]] SensorFrame Sample() noexcept;
  /// Noise-free sensor output (filtered position [m], polarity applied) at the present instant.
  [[nodiscard]] AxisArray SensorOutput() const noexcept;
  /// Integrates one period with the command that answers the latest sample.
  void Advance(const PlantCommand& command) noexcept;

  /// Rigid displacement and rest: the actuator planes stand at the given places (two bearings),
  /// or the single bearing's plane without tilt; sensor filters settled, velocities zero.
  void PlaceAtRest(const AxisArray& actuator_position_m) noexcept;
  /// Puts the rotor into the touchdown bearings where gravity holds it.
  void RestInTouchdown() noexcept;
  /// With gears the angle is unwrapped: a jump of more than half a turn counts as one revolution.
  void SetSpeed(double speed_rad_per_s, double angle_rad) noexcept;

  /// Changes of effects while it runs. The first gives this plant a model of its own (allocates, so
  /// call it before the loop); effects with a time of their own have it from the start. The second
  /// sets the strength (0 to 1) of entry `index` of config().effects from the next Advance on, ends
  /// the entry's own schedule, and does nothing but return false without the first, or for an
  /// index or a strength that is not there. Microseconds, no allocation.
  void AllowEffectChanges();
  bool SetEffectStrength(std::size_t index, double strength) noexcept;

  /// Torques from outside (a load step, an impact) on the torsional inertias of geared shafts. The
  /// first before the loop: it allocates. The second sets that on model().train().inertias[index]
  /// [N m], in the sense in which the first shaft turns, from the next Advance on, and does nothing
  /// but return false without the first, and for an index or a torque that is not there.
  void AllowTorques();
  bool SetTorque(std::size_t index, double torque_n_m) noexcept;

  [[nodiscard]] const StateLayout& layout() const noexcept;
  [[nodiscard]] std::span<const double> state() const noexcept;
  [[nodiscard]] std::span<double> mutable_state() noexcept;
  [[nodiscard]] double speed_rad_per_s() const noexcept;
  [[nodiscard]] double angle_rad() const noexcept;
  [[nodiscard]] std::uint64_t cycle() const noexcept;
  [[nodiscard]] bool finite() const noexcept;
  /// Displacement at the actuator planes [m] and coil force [N], bearing frame.
  [[nodiscard]] AxisArray ActuatorPosition() const noexcept;
  [[nodiscard]] AxisArray MagnetForce() const noexcept;
  /// Largest normal contact force [N] of any touchdown bearing during the last period; 0 = free.
  [[nodiscard]] double ContactForce() const noexcept;

  [[nodiscard]] const PlantModel& model() const noexcept;
  [[nodiscard]] const std::shared_ptr<const PlantModel>& shared_model() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::plant
