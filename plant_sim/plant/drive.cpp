#include "plant_sim/plant/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace levitas::plant {

double Wrapped(double angle_rad) noexcept {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (angle_rad >= 0.0 && angle_rad < kTurn) return angle_rad;
  const double wrapped = angle_rad - kTurn * std::floor(angle_rad / kTurn);
  return wrapped < kTurn ? wrapped : 0.0;  // a tiny negative angle rounds up to a whole turn
}

void Drive(Rotation& rotation, double set_point_rad_per_s, double limit_rad_per_s2,
           double duration_s) noexcept {
  const double most = limit_rad_per_s2 * duration_s;
  const double change = std::clamp(set_point_rad_per_s - rotation.speed_rad_per_s, -most, most);
  const double start = rotation.speed_rad_per_s;
  rotation.speed_rad_per_s = std::abs(change) < most ? set_point_rad_per_s : start + change;
  rotation.acceleration_rad_per_s2 = change / duration_s;
  rotation.angle_rad = Wrapped(rotation.angle_rad + (start + 0.5 * change) * duration_s);
}

void Coast(Rotation& rotation, const DriveConfig& drive, double duration_s) noexcept {
  const double start = std::abs(rotation.speed_rad_per_s);
  const double c = drive.coast_down_1_per_s;
  const double d = drive.coast_down_rad_per_s2;
  rotation.acceleration_rad_per_s2 = 0.0;
  if (start == 0.0) return;
  double moving_s = duration_s;
  if (d > 0.0) moving_s = std::min(moving_s, c > 0.0 ? std::log1p(c * start / d) / c : start / d);
  const bool stands = moving_s < duration_s;
  double end = start - d * moving_s;
  double turned = (start - 0.5 * d * moving_s) * moving_s;
  if (c > 0.0) {
    const double gone = -std::expm1(-c * moving_s);
    end = start - (start + d / c) * gone;
    turned = ((start + d / c) * gone - d * moving_s) / c;
  }
  if (stands) end = 0.0;
  const double sign = std::copysign(1.0, rotation.speed_rad_per_s);
  rotation.speed_rad_per_s = sign * end;
  rotation.angle_rad = Wrapped(rotation.angle_rad + sign * turned);
  rotation.acceleration_rad_per_s2 = sign * (end - start) / duration_s;
}

void Brake(Rotation& rotation, double polar_inertia_kg_m2, double torque_n_m, double slip_rad_per_s,
           double duration_s) noexcept {
  if (!(polar_inertia_kg_m2 > 0.0)) return;
  rotation.speed_rad_per_s +=
      std::clamp(torque_n_m / polar_inertia_kg_m2 * duration_s, -slip_rad_per_s, slip_rad_per_s);
}

}  // namespace levitas::plant
