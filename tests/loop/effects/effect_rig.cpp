#include "tests/loop/effects/effect_rig.hpp"

#include "tests/support/test_rigs.hpp"

namespace levitas::plant::test {

effect::EffectConfig ClearOn(const PlantConfig& rig, effect::Id id) {
  double own = 1.0;
  switch (id) {
    case effect::Id::kAmplifierBandwidth:
      own = rig.bearings[0].amplifier.bandwidth_hz;
      break;
    case effect::Id::kSensorBandwidth:
      own = rig.bearings[0].sensor.bandwidth_hz;
      break;
    case effect::Id::kSensorNoise:
      own = 1e-6;
      break;
    case effect::Id::kModalFrequency:
      own = 90.0;  // first bending of the flexible rotor
      break;
    case effect::Id::kModalDamping:
      own = rig.rotor.modal_damping_ratio;
      break;
    default:
      break;
  }
  return effect::ClearEntry(id, own);
}

PlantCommand SimpleLaw::operator()(const SensorFrame& frame) noexcept {
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = speed_rad_per_s;
  command.acceleration_limit_rad_per_s2 = 1e6;
  for (std::size_t axis = 0; axis < frame.axes; ++axis) {
    const double y_m = frame.position_m[axis];
    command.control_current_a[axis] =
        excitation_a[axis] - 4000.0 * y_m - 3.0 * (y_m - last_m_[axis]) * 1e4;
    last_m_[axis] = y_m;
  }
  return command;
}

SensorFrame StepOnce(Plant& plant, SimpleLaw& law) noexcept {
  const SensorFrame frame = plant.Sample();
  plant.Advance(law(frame));
  return frame;
}

std::vector<SensorFrame> RunLevitated(Plant& plant, double speed_rad_per_s, int periods) {
  SimpleLaw law;
  law.speed_rad_per_s = speed_rad_per_s;
  plant.SetSpeed(speed_rad_per_s, 0.0);
  std::vector<SensorFrame> frames;
  frames.reserve(static_cast<std::size_t>(periods));
  for (int i = 0; i < periods; ++i) frames.push_back(StepOnce(plant, law));
  return frames;
}

std::shared_ptr<const PlantModel> Quiet() {
  static const auto model = std::make_shared<const PlantModel>(levitas::test::QuietFlexibleRotor());
  return model;
}

std::shared_ptr<const PlantModel> QuietWith(const effect::EffectConfig& entry) {
  PlantParameters parameters = Quiet()->parameters();
  parameters.config.effects.push_back(entry);
  return std::make_shared<const PlantModel>(std::move(parameters));
}

std::vector<effect::Id> AllIds() {
  std::vector<effect::Id> ids;
  for (const effect::Row& row : effect::EntryRows()) {
    if (row.place != effect::Place::kGear) ids.push_back(row.id);
  }
  return ids;
}

}  // namespace levitas::plant::test
