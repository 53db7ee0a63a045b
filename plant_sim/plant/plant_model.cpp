#include "plant_sim/plant/plant_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plant_sim/effect/strength.hpp"
#include "plant_sim/plant/check_config.hpp"
#include "plant_sim/plant/coils_of.hpp"
#include "plant_sim/plant/eigen_index.hpp"
#include "plant_sim/plant/magnet_of.hpp"

namespace levitas::plant {
namespace {}  // namespace

PlantParameters Reduce(const PlantConfig& config) {
  CheckConfig(config);
  if (!config.shafts.empty()) {
    TrainModes train = ReduceTrain(config);
    return {config, std::move(train.bending), std::move(train.torsion),
            std::move(train.first_torsion_row)};
  }
  std::vector<double> planes;
  for (const auto& bearing : config.bearings) {
    planes.push_back(bearing.actuator_z_m);
    planes.push_back(bearing.sensor_z_m);
  }
  for (const auto& mass : config.unbalance) planes.push_back(mass.z_m);
  if (config.rotor.given) return {config, rotor::FromGivenModes(*config.rotor.given, planes)};
  const auto model = rotor::Assemble(config.rotor, planes);
  return {config,
          rotor::Reduce(model, config.rotor.modes_per_plane, config.rotor.modal_damping_ratio)};
}

PlantModel::PlantModel(PlantParameters parameters) : parameters_(std::move(parameters)) {
  CheckConfig(parameters_.config);
  const auto modes = static_cast<std::size_t>(parameters_.modes.frequency_rad_per_s.size());
  for (std::size_t i = 0; i < modes; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    CheckMode(i, parameters_.modes.frequency_rad_per_s[at], parameters_.modes.damping_ratio[at]);
  }
  const std::size_t axes = 2 * config().bearings.size();
  const auto twists = static_cast<std::size_t>(parameters_.torsion.frequency_rad_per_s.size());
  layout_.modes = modes;
  layout_.twists = twists;
  layout_.q_y = modes;
  layout_.q_t = 2 * modes;
  layout_.v_x = coordinates();
  layout_.v_y = layout_.v_x + modes;
  layout_.coil_current = 2 * coordinates();
  layout_.sensor = layout_.coil_current + axes;
  const bool second_order = std::ranges::any_of(config().bearings, [](const BearingConfig& b) {
    return b.sensor.filter == SensorFilter::kButterworth2;
  });
  layout_.sensor_rates = second_order ? axes : 0;
  layout_.effects = layout_.size = layout_.sensor + axes + layout_.sensor_rates;
  train_ =
      BuildTrain(config(), {parameters_.modes, parameters_.torsion, parameters_.first_torsion_row});
  gears_ = PrepareGears(parameters_, train_);
  entry_shapes_ = MakeEntryShapes(parameters_);
  effects_ = PrepareEffects(parameters_, layout_);
  now_ = PrepareRig(parameters_);
  BuildRotor();
  BuildBearings();
  ReserveSteps();
  std::vector<double> strengths;
  strengths.reserve(config().effects.size());
  most_delay_samples_ = config().delay_samples;
  for (const auto& entry : config().effects) {
    strengths.push_back(effect::StrengthAt(entry, 0.0));
    if (entry.id == effect::Id::kExtraDelay) {
      most_delay_samples_ += entry.values[0] * 1e9 / static_cast<double>(config().period_ns);
    }
  }
  SetStrengths(strengths);
}

void PlantModel::SetStrengths(std::span<const double> strengths) noexcept {
  ApplyEffects(parameters_, entry_shapes_, strengths, now_, effects_);
  ApplyToGears(parameters_, strengths, gears_, train_);
  RefreshShapes();
  RefreshRotor();
  RefreshDelay();
  RefreshSteps();
}

void PlantModel::BuildRotor() {
  const auto& rotor = parameters_.modes;
  const std::size_t modes = layout_.modes;
  gyroscopic_.resize(modes * modes);
  gravity_.resize(2 * modes);
  unbalance_.resize(2 * modes);
  nominal_rigid_ = Eigen::MatrixX2d::Zero(static_cast<Eigen::Index>(modes), 2);
  rigid_ = nominal_rigid_;
  if (train_.shafts > 0) return;  // see train_model.hpp; the shafts count from their loaded rest

  for (const auto& mass : config().unbalance) {
    unbalance_shapes_.push_back(ToVector(rotor.ShapeAt(mass.z_m)));
  }
  nominal_rigid_ = rotor.rigid;
  rigid_ = nominal_rigid_;
}

void PlantModel::RefreshRotor() noexcept {
  const auto& rotor = parameters_.modes;
  const std::size_t modes = layout_.modes;
  for (std::size_t i = 0; i < gyroscopic_.size(); ++i) {
    gyroscopic_[i] = now_.gyroscopic_ratio * rotor.gyroscopic.data()[i];
  }
  rigid_ = std::sqrt(now_.mass_ratio) * nominal_rigid_;
  gravity_direction_ = {std::cos(config().gravity_direction_rad),
                        std::sin(config().gravity_direction_rad)};
  // Phi^T M e: flexible modes are orthogonal to a translation, gravity does not excite them, (12).
  std::fill(gravity_.begin(), gravity_.end(), 0.0);
  std::fill(unbalance_.begin(), unbalance_.end(), 0.0);
  const auto rigid_modes = static_cast<std::size_t>(rotor.rigid_modes);
  for (std::size_t i = 0; i < rigid_modes && train_.shafts == 0; ++i) {
    const double weight = config().gravity_m_per_s2 * rigid_(static_cast<Eigen::Index>(i), 0);
    gravity_[i] = weight * gravity_direction_[0];
    gravity_[modes + i] = weight * gravity_direction_[1];
  }
  for (std::size_t m = 0; m < unbalance_shapes_.size(); ++m) {
    const UnbalanceMass& mass = config().unbalance[m];
    for (std::size_t i = 0; i < modes; ++i) {
      unbalance_[i] += unbalance_shapes_[m][i] * mass.moment_kg_m * std::cos(mass.phase_rad);
      unbalance_[modes + i] +=
          unbalance_shapes_[m][i] * mass.moment_kg_m * std::sin(mass.phase_rad);
    }
  }
  const double rigid = RigidScale();
  for (std::size_t i = 0; i < 2 * modes; ++i) {
    const double scale = i % modes < rigid_modes ? rigid : 1.0;
    unbalance_[i] = scale * (unbalance_[i] + now_.unbalance[i]);
    gravity_[i] += scale * now_.static_load[i];
  }
}

void PlantModel::BuildBearings() {
  for (const auto& b : config().bearings) {
    BearingModel model;
    model.magnet = MagnetOf(b.magnet);
    model.x_only = b.x_only;
    model.far_gap_m = b.magnet.exponential ? b.magnet.exponential->far_gap_m : b.magnet.gap_m;
    model.coils = CoilsOf(b);
    if (const auto& voltage = b.amplifier.voltage) {
      model.warming_1_per_s = voltage->warming_1_per_s;
      // What limits the current is the voltage.
      model.magnet.max_coil_current_a = std::numeric_limits<double>::max();
    }
    model.amplifier = {b.magnet.max_coil_current_a,
                       amplifier::ConverterStep(b.magnet.max_coil_current_a, b.amplifier.dac_bits)};
    model.converter = {b.sensor.noise_rms_m,
                       amplifier::ConverterStep(b.sensor.range_m, b.sensor.adc_bits),
                       b.sensor.range_m};
    model.filter = b.sensor.filter;
    model.characteristic = sensor::Characteristic(b.sensor.characteristic);
    model.touchdown = {b.touchdown.clearance_m, b.touchdown.stiffness_n_per_m,
                       b.touchdown.damping_n_s_per_m, b.touchdown.friction,
                       b.touchdown.journal_radius_m};
    if (train_.shafts > 0) model.speed_ratio = train_.ratio[b.shaft];
    model.has_touchdown = b.touchdown.stiffness_n_per_m > 0.0;
    model.actuator_shape = ToVector(parameters_.modes.ShapeAt(b.actuator_z_m, b.shaft));
    model.sensor_shape = ToVector(parameters_.modes.ShapeAt(b.sensor_z_m, b.shaft));
    nominal_shapes_.push_back(model.actuator_shape);
    nominal_shapes_.push_back(model.sensor_shape);
    bearings_.push_back(std::move(model));
  }
}

double PlantModel::RigidScale() const noexcept {
  return now_.mass_ratio == 1.0 ? 1.0 : 1.0 / std::sqrt(now_.mass_ratio);
}

void PlantModel::RefreshShapes() noexcept {
  for (std::size_t b = 0; b < bearings_.size(); ++b) {
    const auto& actuator = nominal_shapes_[2 * b];
    const auto& sensor = nominal_shapes_[2 * b + 1];
    std::copy(actuator.begin(), actuator.end(), bearings_[b].actuator_shape.begin());
    std::copy(sensor.begin(), sensor.end(), bearings_[b].sensor_shape.begin());
  }
  const auto& entries = config().effects;
  for (std::size_t e = 0; e < entries.size(); ++e) {
    if (entries[e].id != effect::Id::kSensorPosition) continue;
    const double share = now_.sensor_shift_share[entries[e].bearing];
    auto& shape = bearings_[entries[e].bearing].sensor_shape;
    for (std::size_t i = 0; i < shape.size(); ++i) {
      shape[i] =
          share == 1.0 ? entry_shapes_[e][i] : shape[i] + share * (entry_shapes_[e][i] - shape[i]);
    }
  }
  const double rigid = RigidScale();
  if (rigid == 1.0) return;
  for (BearingModel& bearing : bearings_) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(parameters_.modes.rigid_modes); ++i) {
      bearing.actuator_shape[i] *= rigid;
      bearing.sensor_shape[i] *= rigid;
    }
  }
}

}  // namespace levitas::plant
