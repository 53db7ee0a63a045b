#include "report/signature/orbit.hpp"

#include <cmath>
#include <memory>
#include <numbers>

#include "plant_sim/plant/plant_model.hpp"

namespace levitas::signature {

Turning Turn(const plant::PlantParameters& rig, const Motion& motion, const Control& control) {
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
  Turning turning;
  turning.reading_m.reserve(static_cast<std::size_t>(count));
  turning.current_a.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < settle + count; ++i) {
    const SensorFrame frame = plant.Sample();
    if (control) control(frame, command);
    if (i >= settle) {
      turning.reading_m.emplace_back(frame.position_m[0], frame.position_m[1]);
      turning.current_a.emplace_back(command.control_current_a[0], command.control_current_a[1]);
    }
    plant.Advance(command);
  }
  return turning;
}

}  // namespace levitas::signature
