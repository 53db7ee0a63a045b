#include "report/signature/orbit.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::signature {

std::vector<std::complex<double>> Orbit(const plant::PlantParameters& rig, const Motion& motion,
                                        const Control& control) {
  const double speed_rad_per_s = 2.0 * std::numbers::pi * motion.speed_hz;
  plant::Plant plant(std::make_shared<const plant::PlantModel>(rig), 1);
  plant.SetSpeed(speed_rad_per_s, 0.0);
  const double period_s = static_cast<double>(rig.config.period_ns) * 1e-9;
  const auto settle = static_cast<int>(std::lround(motion.settle_s / period_s));
  const auto count = static_cast<int>(std::lround(motion.turns / motion.speed_hz / period_s));
  plant::PlantCommand command;
  command.bias_current_a = rig.config.bearings.front().magnet.bias_current_a;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed_rad_per_s;
  command.acceleration_limit_rad_per_s2 = 1.0;
  std::vector<std::complex<double>> orbit;
  orbit.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < settle + count; ++i) {
    const SensorFrame frame = plant.Sample();
    if (control) control(frame, command);
    if (i >= settle) orbit.emplace_back(frame.position_m[0], frame.position_m[1]);
    plant.Advance(command);
  }
  return orbit;
}

}  // namespace levitas::signature
