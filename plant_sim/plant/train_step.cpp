#include "plant_sim/plant/train_step.hpp"

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "plant_sim/plant/modal_sum.hpp"

namespace levitas::plant {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

void Project(const std::vector<double>& shape, double force,
             double* __restrict acceleration) noexcept {
  const double* __restrict at = shape.data();
  const std::size_t size = shape.size();
  for (std::size_t i = 0; i < size; ++i) acceleration[i] += at[i] * force;
}

// Force u (W^2 - j W') exp(j angle) of each shaft with its own W, (13).
void AddUnbalance(const TrainModel& train, const TrainPose& pose, std::size_t modes,
                  double* acceleration) noexcept {
  if (pose.speed_rad_per_s == 0.0 && pose.acceleration_rad_per_s2 == 0.0) return;
  for (std::size_t s = 0; s < train.shafts; ++s) {
    const ShaftUnbalance& u = train.unbalance[s];
    const double speed = u.ratio * pose.speed_rad_per_s;
    const gear::Vector factor =
        gear::Turned({speed * speed, -u.ratio * pose.acceleration_rad_per_s2}, pose.heading[s]);
    const double* __restrict real = u.real.data();
    const double* __restrict imaginary = u.imaginary.data();
    double* __restrict in_x = acceleration;
    double* __restrict in_y = acceleration + modes;
    for (std::size_t i = 0; i < modes; ++i) in_x[i] += factor.x * real[i] - factor.y * imaginary[i];
    for (std::size_t i = 0; i < modes; ++i) in_y[i] += factor.x * imaginary[i] + factor.y * real[i];
  }
}

// turn^power for a unit vector, by squaring: a fifth of the cost of its sine and cosine.
gear::Vector Power(gear::Vector turn, int power) noexcept {
  gear::Vector result{1.0, 0.0};
  for (; power > 0; power /= 2) {
    if (power % 2 == 1) result = gear::Turned(result, turn);
    turn = gear::Turned(turn, turn);
  }
  return result;
}

// A phasor of a coupling at the present angle of its shaft.
gear::Vector Turning(const CouplingModel& coupling, const gear::Vector& phasor,
                     const TrainPose& pose) noexcept {
  const gear::Vector& heading = pose.heading[coupling.shaft];
  const gear::Vector sense{heading.x, coupling.order < 0 ? -heading.y : heading.y};
  return gear::Turned(phasor, Power(sense, std::abs(coupling.order)));
}

// Uneven rotation of the wheels as a displacement of the teeth along n, (G18).
void AddRotationErrors(const TrainModel& train, std::size_t mesh, const TrainPose& pose,
                       gear::Prescribed& imposed) noexcept {
  for (const CouplingModel& coupling : train.couplings) {
    if (coupling.mesh != mesh || coupling.base_radius_m == 0.0) continue;
    const gear::Vector& n = train.meshes[mesh].law.normal;
    const gear::Vector error_m =
        coupling.base_radius_m * Turning(coupling, coupling.rotation_rad, pose);
    const double rate_rad_per_s = coupling.order * coupling.ratio * pose.speed_rad_per_s;
    imposed.displacement_m = imposed.displacement_m + error_m.x * n;
    imposed.rate_m_per_s = imposed.rate_m_per_s + (-rate_rad_per_s * error_m.y) * n;
  }
}

// What misaligned couplings push, and the torque of those whose spring is there, (G17), (G19).
void AddCouplings(const TrainModel& train, const TrainPose& pose, std::size_t modes,
                  double* acceleration) noexcept {
  for (const CouplingModel& coupling : train.couplings) {
    const gear::Vector force_n = Turning(coupling, coupling.force_n, pose);
    Project(coupling.shape, force_n.x, acceleration);
    Project(coupling.shape, force_n.y, acceleration + modes);
    Project(coupling.twist, Turning(coupling, coupling.rotation_rad, pose).x,
            acceleration + 2 * modes);
  }
}

// Run-out of a wheel as a prescribed displacement.
gear::Prescribed Runout(const WheelModel& wheel, const TrainPose& pose) noexcept {
  const gear::Vector at_m = gear::Turned(wheel.runout_m, pose.heading[wheel.shaft]);
  const double speed = wheel.ratio * pose.speed_rad_per_s;
  return {at_m, {-speed * at_m.y, speed * at_m.x}};
}

// What the teeth are displaced by apart from the motion of the shafts, (G1).
gear::Prescribed Imposed(const MeshModel& mesh, const TrainPose& pose,
                         const gear::Vector& tooth) noexcept {
  const double tooth_rad_per_s =
      mesh.law.driving_teeth * std::abs(mesh.driving.ratio) * pose.speed_rad_per_s;
  const gear::Prescribed error = mesh.error.At(tooth, tooth_rad_per_s);
  const gear::Prescribed driving = Runout(mesh.driving, pose);
  const gear::Prescribed driven = Runout(mesh.driven, pose);
  return {driving.displacement_m - driven.displacement_m - error.displacement_m,
          driving.rate_m_per_s - driven.rate_m_per_s - error.rate_m_per_s};
}

void AddMesh(const MeshModel& mesh, const TrainPose& pose, std::size_t index, std::size_t modes,
             const double* position, const double* velocity, double* acceleration) noexcept {
  const gear::Vector& n = mesh.law.normal;
  const double twist_m = ModalSum(mesh.twist, position + 2 * modes);
  const double twist_m_per_s = ModalSum(mesh.twist, velocity + 2 * modes);
  const gear::Prescribed& imposed = pose.prescribed[index];
  const gear::Vector delta_m =
      gear::Vector{ModalSum(mesh.shape, position), ModalSum(mesh.shape, position + modes)} +
      twist_m * n + imposed.displacement_m;
  const gear::Vector rate =
      gear::Vector{ModalSum(mesh.shape, velocity), ModalSum(mesh.shape, velocity + modes)} +
      twist_m_per_s * n + imposed.rate_m_per_s;
  // Both wheels in their own sense of rotation.
  const double sense = mesh.driven.ratio < 0.0 ? -1.0 : 1.0;
  const gear::Engagement engagement{pose.mesh[index], -sense * pose.shaft_rad[mesh.driving.shaft],
                                    sense * pose.shaft_rad[mesh.driven.shaft]};
  const gear::Vector force = gear::MeshForce(mesh.law, engagement, delta_m, rate);
  Project(mesh.shape, -force.x, acceleration);
  Project(mesh.shape, -force.y, acceleration + modes);
  Project(mesh.twist, -gear::Dot(force, n), acceleration + 2 * modes);
}

}  // namespace

void Follow(const TrainModel& train, const Rotation& rotation, TrainPose& pose) noexcept {
  const double passed = std::round((pose.angle_rad - rotation.angle_rad) / kTurn);
  pose.turns += passed;
  pose.turns -= train.turns_per_repeat * std::floor(pose.turns / train.turns_per_repeat);
  pose.angle_rad = rotation.angle_rad;
  pose.speed_rad_per_s = rotation.speed_rad_per_s;
  pose.acceleration_rad_per_s2 = rotation.acceleration_rad_per_s2;
  const double total_rad = pose.angle_rad + kTurn * pose.turns;
  for (std::size_t s = 0; s < train.shafts; ++s) {
    pose.shaft_rad[s] = train.ratio[s] * total_rad;
    pose.heading[s] = {std::cos(pose.shaft_rad[s]), std::sin(pose.shaft_rad[s])};
  }
  for (std::size_t m = 0; m < train.meshes.size(); ++m) {
    const MeshModel& mesh = train.meshes[m];
    const gear::Vector& at = pose.heading[mesh.driving.shaft];
    const gear::Vector forward{at.x, mesh.driving.ratio < 0.0 ? -at.y : at.y};
    pose.mesh[m] = Power(forward, mesh.law.driving_teeth);
    pose.prescribed[m] = Imposed(mesh, pose, pose.mesh[m]);
    AddRotationErrors(train, m, pose, pose.prescribed[m]);
  }
}

void AddTrain(const TrainModel& train, const TrainPose& pose, std::size_t modes,
              const double* position, const double* velocity, double* acceleration) noexcept {
  for (std::size_t i = 0; i < train.twists; ++i) {
    acceleration[2 * modes + i] = pose.outside != nullptr ? pose.outside[i] : 0.0;
  }
  AddUnbalance(train, pose, modes, acceleration);
  AddCouplings(train, pose, modes, acceleration);
  for (const SupportModel& support : train.supports) {
    const double x_n = -support.stiffness_x_n_per_m * ModalSum(support.shape, position) -
                       support.damping_x_n_s_per_m * ModalSum(support.shape, velocity);
    const double y_n = -support.stiffness_y_n_per_m * ModalSum(support.shape, position + modes) -
                       support.damping_y_n_s_per_m * ModalSum(support.shape, velocity + modes);
    Project(support.shape, x_n, acceleration);
    Project(support.shape, y_n, acceleration + modes);
  }
  for (const TwistDamper& damper : train.dampers) {
    Project(damper.twist,
            -damper.damping_n_m_s_per_rad * ModalSum(damper.twist, velocity + 2 * modes),
            acceleration + 2 * modes);
  }
  for (std::size_t m = 0; m < train.meshes.size(); ++m) {
    AddMesh(train.meshes[m], pose, m, modes, position, velocity, acceleration);
  }
}

}  // namespace levitas::plant
