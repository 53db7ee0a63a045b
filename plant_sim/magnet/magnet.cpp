#include "plant_sim/magnet/magnet.hpp"

#include <cmath>
#include <numbers>

namespace levitas::magnet {

double ForceConstant(double turns, double pole_area_m2, double half_pole_angle_rad) {
  constexpr double kVacuumPermeability = 4.0e-7 * std::numbers::pi;  // [H/m]
  return kVacuumPermeability * turns * turns * pole_area_m2 * std::cos(half_pole_angle_rad) / 4.0;
}

}  // namespace levitas::magnet
