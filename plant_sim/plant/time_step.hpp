#pragma once
// One substep of the rotor under all its forces: the inner loop of every simulation.
//
// Scheme     exponential trapezoid (ETD2RK): modal oscillators exact, all other forces taken as
//            linear in time over the substep, from the start to a predicted end.
//            docs/derivations.md (34)-(37), with the measurements that chose it.
// Thread     one Motion per thread. No allocation, no throw.

#include <vector>

#include "common/axes.hpp"
#include "plant_sim/plant/drive.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/plant/train_step.hpp"

namespace levitas::plant {

/// Coil currents of every axis at one instant.
struct Currents {
  AxisArray control_a{};
  AxisArray bias_a{};
};

/// Where the bearing housings stand and how fast they move, per axis; only if any moves.
struct Housings {
  AxisArray position_m{};
  AxisArray velocity_m_per_s{};
};

/// Rotation as the forces need it at one instant.
struct Spin {
  double speed_rad_per_s{};
  double unbalance_real{};  ///< real and imaginary part of (W^2 - j W') e^{j angle}, (13)
  double unbalance_imaginary{};
  const TrainPose* train{nullptr};  ///< of geared shafts, which have more than one speed
  double cosine{1.0};               ///< of the angle
  double sine{};
};

/// The rotor angle as a unit vector; the end of one substep is the start of the next.
struct Heading {
  double cosine{1.0};
  double sine{};
};

[[nodiscard]] Heading MakeHeading(const Rotation& rotation) noexcept;
[[nodiscard]] Spin MakeSpin(const Rotation& rotation, const Heading& heading) noexcept;

/// Forces found on the way, for those who ask.
struct ForceReport {
  double contact_n{};       ///< largest normal force since it was last set to zero
  double friction_n_m{};    ///< torque of all contacts on the rotation of the first shaft, now
  double slip_rad_per_s{};  ///< largest change of its speed at which a contact would stop sliding
  AxisArray
      bearing_n{};  ///< on the rotor by each bearing, of the latest instant; with effects only
};

/// What a contact does besides its force. Shaft s turns at ratio times the speed of the first: its
/// torque counts there `ratio` times, since the powers are equal.
void Report(const support::Touchdown& ring, const support::Contact& contact, double ratio,
            ForceReport& report) noexcept;

/// Modal accelerations besides those of the free oscillators, over PlantModel::coordinates().
/// `housings` is null when none moves.
void ModalForces(const PlantModel& model, const Currents& currents, const Spin& spin,
                 const double* position, const double* velocity, double* acceleration,
                 ForceReport& report, const Housings* housings = nullptr) noexcept;

/// Storage of the step, made once.
struct Workspace {
  explicit Workspace(const PlantModel& model)
      : start(model.coordinates()),
        end(model.coordinates()),
        position(model.coordinates()),
        velocity(model.coordinates()) {}
  std::vector<double> start, end, position, velocity;
};

/// Sum over the modes of shape times modal coordinate.
[[nodiscard]] double AtPlane(const std::vector<double>& shape, const double* modal) noexcept;
/// The same in both planes.
void AtPlanes(const PlantModel& model, const std::vector<double>& shape, const double* position,
              double& x_m, double& y_m) noexcept;

/// Advances modal displacement and velocity (coordinates() of each, contiguous) by one substep, and
/// the housings with them.
void StepRotor(const PlantModel& model, const StepTable& table, const Currents& start_currents,
               const Currents& end_currents, const Spin& start_spin, const Spin& end_spin,
               double* position, double* velocity, Workspace& work, ForceReport& report,
               Housings* housings = nullptr) noexcept;

}  // namespace levitas::plant
