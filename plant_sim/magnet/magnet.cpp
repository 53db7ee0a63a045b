#include "plant_sim/magnet/magnet.hpp"

#include <cmath>
#include <numbers>

namespace levitas::magnet {

AxisLaw LawOfPoles(double turns, double pole_area_m2, double half_pole_angle_rad,
                   double pole_gap_m) {
  constexpr double kVacuumPermeability = 4.0e-7 * std::numbers::pi;  // [H/m]
  const double along = std::cos(half_pole_angle_rad);
  return {kVacuumPermeability * turns * turns * pole_area_m2 / (4.0 * along), pole_gap_m / along};
}

}  // namespace levitas::magnet
