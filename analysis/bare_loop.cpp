#include "analysis/bare_loop.hpp"

#include <algorithm>

#include "plant_sim/plant/bearing_frame.hpp"

namespace levitas::analysis {
namespace {

law::LawConfig AtPeriodOf(const plant::PlantConfig& rig, law::LawConfig law) {
  law.period_s = static_cast<double>(rig.period_ns) * 1e-9;
  return law;
}

}  // namespace

plant::PlantConfig WithoutNoise(const plant::PlantConfig& given) {
  plant::PlantConfig rig = plant::InBearingFrame(given);
  for (auto& bearing : rig.bearings) {
    bearing.amplifier.dac_bits = 0;
    bearing.sensor.noise_rms_m = 0.0;
    bearing.sensor.adc_bits = 0;
  }
  return rig;
}

BareLoop::BareLoop(const plant::PlantConfig& rig, const law::LawConfig& law)
    : plant_(WithoutNoise(rig), 1), law_(AtPeriodOf(rig, law)) {
  const auto& magnet = rig.bearings.front().magnet;
  const double room_a =
      std::min(magnet.bias_current_a, magnet.max_coil_current_a - magnet.bias_current_a);
  limit_a_ = law.current_limit_a > 0.0 ? law.current_limit_a : room_a;
  command_.bias_current_a = magnet.bias_current_a;
  command_.drive_enabled = true;
  command_.acceleration_limit_rad_per_s2 = rig.drive.max_acceleration_rad_per_s2;
}

void BareLoop::PlaceAtRest(const AxisArray& actuator_position_m) noexcept {
  plant_.PlaceAtRest(actuator_position_m);
}

void BareLoop::Turn(double speed_rad_per_s, double angle_rad) noexcept {
  plant_.SetSpeed(speed_rad_per_s, angle_rad);
  command_.speed_set_point_rad_per_s = speed_rad_per_s;
  law_.JumpTo(speed_rad_per_s);
}

AxisArray BareLoop::Step(const AxisArray& excitation_a, const AxisArray& excitation_m) noexcept {
  AxisArray error_m{};
  const AxisArray seen_m = plant_.SensorOutput();
  for (std::size_t axis = 0; axis < axes(); ++axis) {
    error_m[axis] = -seen_m[axis] - excitation_m[axis];
  }
  const law::LawOutput out =
      law_.Step(command_.speed_set_point_rad_per_s, error_m, excitation_a, limit_a_);
  command_.control_current_a = out.control_current_a;
  plant_.Advance(command_);
  return seen_m;
}

}  // namespace levitas::analysis
