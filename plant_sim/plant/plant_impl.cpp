#include "plant_sim/plant/plant_impl.hpp"

#include <algorithm>
#include <numbers>

#include "plant_sim/plant/applied_effects/effect_signals.hpp"

namespace levitas::plant {

void Plant::Impl::AllowChanges() {
  if (own) return;
  own = std::make_shared<PlantModel>(*model);
  model = own;
}

void Plant::Impl::Separate() {
  if (!own) return;
  own = std::make_shared<PlantModel>(*own);
  model = own;
}

void Plant::Impl::FollowSchedule() noexcept {
  const double time_s = static_cast<double>(cycle) * PeriodSeconds();
  bool changed = false;
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    if (!follows_schedule[i]) continue;
    const double now = effect::StrengthAt(model->config().effects[i], time_s);
    changed = changed || now != strengths[i];
    strengths[i] = now;
  }
  if (changed) own->SetStrengths(strengths);
}

void Plant::Impl::Energise(bool on) noexcept {
  CoilCommand command;
  command.enabled = on;
  bias_a = {};
  std::size_t axis = 0;
  for (const auto& bearing : model->config().bearings) {
    for (int i = 0; on && i < 2; ++i) {
      bias_a[axis + static_cast<std::size_t>(i)] = bearing.magnet.bias_current_a;
      command.coils[axis + static_cast<std::size_t>(i)] = {0.0, bearing.magnet.bias_current_a};
    }
    axis += 2;
  }
  std::fill(queue.begin(), queue.end(), command);
  std::fill_n(state.begin() + static_cast<std::ptrdiff_t>(model->layout().coil_current),
              model->axes(), 0.0);
}

CoilCommand Plant::Impl::Limited(const PlantCommand& command) const noexcept {
  CoilCommand limited;
  limited.enabled = command.amplifiers_enabled;
  const AxisArray control_a = probes.CommandedCurrents({command.control_current_a}).at;
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    const double offset_a = model->effects().bearings[axis / 2].axis[axis % 2].command_offset_a;
    limited.coils[axis] =
        amplifier::LimitedCommand(model->bearings()[axis / 2].amplifier, command.amplifiers_enabled,
                                  control_a[axis] + offset_a, command.bias_current_a);
  }
  return limited;
}

bool Plant::Impl::FrameLost() noexcept {
  const EffectModel& effects = model->effects();
  if (effects.drop_probability <= 0.0) return false;
  if (burst_left == 0 && chance.Uniform() < effects.drop_probability) {
    burst_left = effects.drop_burst;
  }
  if (burst_left == 0) return false;
  --burst_left;
  return true;
}

void Plant::Impl::Rotate(const PlantCommand& command, double duration_s) noexcept {
  const DriveConfig& drive = model->config().drive;
  if (command.drive_enabled) {
    Drive(rotation, command.speed_set_point_rad_per_s,
          std::min(command.acceleration_limit_rad_per_s2, drive.max_acceleration_rad_per_s2),
          duration_s);
  } else {
    Coast(rotation, drive, duration_s);
  }
}

AxisArray Plant::Impl::SensorPositions() const noexcept {
  AxisArray seen_m{};
  for (std::size_t b = 0; b < model->bearings().size(); ++b) {
    AtPlanes(*model, model->bearings()[b].sensor_shape, state.data(), seen_m[2 * b],
             seen_m[2 * b + 1]);
  }
  if (model->effects().views) View(*model, heading.cosine, heading.sine, state.data(), seen_m);
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    const sensor::Characteristic& curve = model->bearings()[axis / 2].characteristic;
    if (!curve.straight()) seen_m[axis] = curve(seen_m[axis]);
  }
  return seen_m;
}

void Plant::Impl::FollowDisplacements(const StepTable& table, const AxisArray& seen_m,
                                      const AxisArray& now_m) noexcept {
  const StateLayout& at = model->layout();
  for (std::size_t a = 0; a < model->axes(); ++a) {
    double& filtered = state[at.sensor + a];
    if (model->bearings()[a / 2].filter == SensorFilter::kButterworth2) {
      // s'' + 2 z w s' + w^2 s = w^2 g p, which is a mode that w^2 g p accelerates.
      const ModeStep& step = table.second_order[a];
      const ReadingEffects& reading = model->effects().readings[a];
      const double w = 2.0 * std::numbers::pi * reading.bandwidth_hz;
      const double start = w * w * reading.gain * seen_m[a];
      const double change = w * w * reading.gain * (now_m[a] - seen_m[a]);
      double& rate = state[at.sensor_rate() + a];
      const double before = filtered;
      filtered = step.xx * before + step.xv * rate + step.x0 * start + step.x1 * change;
      rate = step.vx * before + step.vv * rate + step.v0 * start + step.v1 * change;
      continue;
    }
    const sensor::FilterStep& filter = table.sensor[a];
    filtered = filter.decay * filtered + filter.start * seen_m[a] + filter.end * now_m[a];
  }
}

void Plant::Impl::FollowCurrents(const StepTable& table, const CoilCommand& command) noexcept {
  double* control = state.data() + model->layout().coil_current;
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    if (model->bearings()[axis / 2].on_voltage()) {
      FollowVoltage(axis, table.duration_s, command, control[axis]);
      continue;
    }
    amplifier::Follow(table.amplifier[axis], command.coils[axis], control[axis], bias_a[axis]);
  }
}

void Plant::Impl::FollowVoltage(std::size_t axis, double duration_s, const CoilCommand& command,
                                double& control_a) noexcept {
  const BearingModel& bearing = model->bearings()[axis / 2];
  const StateLayout& at = model->layout();
  AxisArray place_m{};
  AxisArray rate_m_per_s{};
  AtPlanes(*model, bearing.actuator_shape, state.data() + at.q_x, place_m[0], place_m[1]);
  AtPlanes(*model, bearing.actuator_shape, state.data() + at.v_x, rate_m_per_s[0], rate_m_per_s[1]);
  const double rate = rate_m_per_s[axis % 2];
  const double middle_m = place_m[axis % 2] + 0.5 * duration_s * rate;
  const amplifier::CoilPair& asked = command.coils[axis];
  const double warm =
      amplifier::Warmed(bearing.warming_1_per_s, static_cast<double>(cycle) * PeriodSeconds());
  const double towards_a =
      amplifier::Follow(bearing.coils[0], bias_a[axis] + control_a, asked.bias_a + asked.control_a,
                        command.enabled, bearing.magnet.gap_m - middle_m, -rate, duration_s, warm);
  const double away_a =
      amplifier::Follow(bearing.coils[1], bias_a[axis] - control_a, asked.bias_a - asked.control_a,
                        command.enabled, bearing.far_gap_m + middle_m, rate, duration_s, warm);
  control_a = 0.5 * (towards_a - away_a);
  bias_a[axis] = 0.5 * (towards_a + away_a);
}

Currents Plant::Impl::CurrentsNow() const noexcept {
  Currents now{{}, bias_a};
  std::copy_n(state.data() + model->layout().coil_current, model->axes(), now.control_a.data());
  return now;
}

void Plant::Impl::Integrate(const StepTable& table, const CoilCommand& coils,
                            const PlantCommand& command) noexcept {
  const StateLayout& at = model->layout();
  if (table.substeps == 0) return;
  const bool memory = model->effects().memory;
  Housings housings;
  Housings* const moving = model->effects().housings ? &housings : nullptr;
  AxisArray seen_m = SensorPositions();
  for (int substep = 0; substep < table.substeps; ++substep) {
    Currents start = CurrentsNow();
    FollowCurrents(table, coils);
    Currents end = CurrentsNow();
    if (memory) Remember(table, start, end);
    Rotation before = rotation;
    Rotate(command, table.duration_s);
    before.acceleration_rad_per_s2 = rotation.acceleration_rad_per_s2;
    Spin start_spin = MakeSpin(before, heading);
    if (rotation.angle_rad != before.angle_rad) heading = MakeHeading(rotation);
    Spin end_spin = MakeSpin(rotation, heading);
    TrainPose start_pose;
    if (model->train().shafts > 0) {
      pose.outside = outside.empty() ? nullptr : outside.data();
      start_pose = pose;
      start_pose.acceleration_rad_per_s2 = rotation.acceleration_rad_per_s2;
      Follow(model->train(), rotation, pose);
      start_spin.train = &start_pose;
      end_spin.train = &pose;
    }
    if (moving != nullptr) LoadHousings(housings);
    StepRotor(*model, table, start, end, start_spin, end_spin, state.data() + at.q_x,
              state.data() + at.v_x, work, report, moving);
    if (moving != nullptr) StoreHousings(housings);
    if (report.friction_n_m != 0.0) {
      Brake(rotation, model->config().drive.polar_inertia_kg_m2, report.friction_n_m,
            report.slip_rad_per_s, table.duration_s);
    }
    const AxisArray now_m = SensorPositions();
    FollowDisplacements(table, seen_m, now_m);
    seen_m = now_m;
  }
}

AxisArray Plant::Impl::PositionInMagnets(double ahead_s) const noexcept {
  const StateLayout& at = model->layout();
  AxisArray position_m{};
  AxisArray rate_m_per_s{};
  for (std::size_t axis = 0; axis < model->axes(); axis += 2) {
    const std::vector<double>& shape = model->bearings()[axis / 2].actuator_shape;
    AtPlanes(*model, shape, state.data() + at.q_x, position_m[axis], position_m[axis + 1]);
    AtPlanes(*model, shape, state.data() + at.v_x, rate_m_per_s[axis], rate_m_per_s[axis + 1]);
  }
  if (model->effects().housings) {
    Housings housings;
    LoadHousings(housings);
    for (std::size_t axis = 0; axis < model->axes(); ++axis) {
      position_m[axis] -= housings.position_m[axis];
      rate_m_per_s[axis] -= housings.velocity_m_per_s[axis];
    }
  }
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    position_m[axis] += ahead_s * rate_m_per_s[axis];
  }
  return SeenByMagnets(model->effects(), position_m);
}

void Plant::Impl::Remember(const StepTable& table, Currents& start, Currents& end) noexcept {
  const EffectModel& effects = model->effects();
  // The rotor has not moved yet: its place at the end is that of an even motion, off by the square
  // of the substep, which is the order of the rotor's own step.
  const MagnetInput before{start.control_a, PositionInMagnets(0.0)};
  const MagnetInput after{end.control_a, PositionInMagnets(table.duration_s)};
  start.control_a = Magnetising(effects, before, state.data());
  AdvanceMemory(effects, table, before, after, state.data());
  end.control_a = Magnetising(effects, after, state.data());
}

void Plant::Impl::LoadHousings(Housings& housings) const noexcept {
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    const std::size_t at = model->effects().bearings[axis / 2].housing_state;
    if (at == kNoState) continue;
    housings.position_m[axis] = state[at + axis % 2];
    housings.velocity_m_per_s[axis] = state[at + 2 + axis % 2];
  }
}

void Plant::Impl::StoreHousings(const Housings& housings) noexcept {
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    const std::size_t at = model->effects().bearings[axis / 2].housing_state;
    if (at == kNoState) continue;
    state[at + axis % 2] = housings.position_m[axis];
    state[at + 2 + axis % 2] = housings.velocity_m_per_s[axis];
  }
}

void Plant::Impl::SettleMemory() noexcept {
  const EffectModel& effects = model->effects();
  if (!effects.memory) return;
  plant::SettleMemory(effects, {CurrentsNow().control_a, PositionInMagnets(0.0)}, state.data());
}

void Plant::Impl::SettleSensors() noexcept {
  const AxisArray seen_m = SensorPositions();
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    state[model->layout().sensor + axis] = model->effects().readings[axis].gain * seen_m[axis];
    if (model->layout().sensor_rates > 0) state[model->layout().sensor_rate() + axis] = 0.0;
  }
}

AxisArray Plant::Impl::Outputs() const noexcept {
  AxisArray output_m{};
  std::copy_n(state.data() + model->layout().sensor, model->axes(), output_m.data());
  if (model->effects().outputs) {
    AddOutputs(model->effects(), model->axes(), static_cast<double>(cycle) * PeriodSeconds(),
               output_m);
  }
  return output_m;
}

double Plant::Impl::Read(std::size_t axis, double output_m) noexcept {
  sensor::Converter converter = model->bearings()[axis / 2].converter;
  double normal = random.Normal();
  if (model->effects().outputs) {
    const ReadingEffects& reading = model->effects().readings[axis];
    converter.noise_rms_m = reading.noise_rms_m;
    const double a = reading.noise_memory;
    if (a > 0.0) normal = a * colour[axis] + std::sqrt(1.0 - a * a) * normal;
    colour[axis] = normal;
  }
  return sensor::Convert(converter, output_m, normal);
}

void Plant::Impl::Jitter(AxisArray& output_m) noexcept {
  const double late_s = model->effects().jitter_s * chance.Normal();
  const AxisArray seen_m = SensorPositions();
  for (std::size_t axis = 0; axis < model->axes(); ++axis) {
    const ReadingEffects& reading = model->effects().readings[axis];
    const double rate_1_per_s = 2.0 * std::numbers::pi * reading.bandwidth_hz;
    const bool second_order = model->bearings()[axis / 2].filter == SensorFilter::kButterworth2;
    output_m[axis] +=
        late_s * (second_order ? state[model->layout().sensor_rate() + axis]
                               : rate_1_per_s * (reading.gain * seen_m[axis] -
                                                 state[model->layout().sensor + axis]));
  }
}

}  // namespace levitas::plant
