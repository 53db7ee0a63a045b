#include "plant_sim/plant/plant_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "plant_sim/plant/check_config.hpp"
#include "plant_sim/plant/mode_step.hpp"

namespace levitas::plant {
namespace {

std::vector<double> ToVector(const Eigen::RowVectorXd& row) {
  return {row.data(), row.data() + row.size()};
}

// Delays closer than this to a whole sample count as whole: a rounding error, not a step of its
// own.
constexpr double kWholeSample = 1e-9;

}  // namespace

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
  layout_.size = layout_.sensor + axes;
  train_ =
      BuildTrain(config(), {parameters_.modes, parameters_.torsion, parameters_.first_torsion_row});
  BuildRotor();
  BuildBearings();
  BuildSteps();
}

void PlantModel::BuildRotor() {
  const auto& rotor = parameters_.modes;
  const std::size_t modes = layout_.modes;
  gyroscopic_.assign(rotor.gyroscopic.data(), rotor.gyroscopic.data() + rotor.gyroscopic.size());

  gravity_.assign(2 * modes, 0.0);
  unbalance_.assign(2 * modes, 0.0);
  rigid_ = Eigen::MatrixX2d::Zero(static_cast<Eigen::Index>(modes), 2);
  if (train_.shafts > 0) return;  // see train_model.hpp; the shafts count from their loaded rest

  // The rigid modes span translation and slope; invert that relation at both shaft ends.
  const Eigen::Index last = rotor.shapes.rows() - 1;
  Eigen::Matrix2d ends;
  ends << rotor.shapes(0, 0), rotor.shapes(0, 1), rotor.shapes(last, 0), rotor.shapes(last, 1);
  Eigen::Matrix2d wanted;
  wanted << 1.0, rotor.node_z_m.front(), 1.0, rotor.node_z_m.back();
  rigid_.topRows(2) = ends.inverse() * wanted;

  // Phi^T M e: flexible modes are orthogonal to a translation, gravity does not excite them, (12).
  for (std::size_t i = 0; i < 2; ++i) {
    const double weight = config().gravity_m_per_s2 * rigid_(static_cast<Eigen::Index>(i), 0);
    gravity_[i] = weight * std::cos(config().gravity_direction_rad);
    gravity_[modes + i] = weight * std::sin(config().gravity_direction_rad);
  }
  for (const auto& mass : config().unbalance) {
    const auto shape = ToVector(rotor.ShapeAt(mass.z_m));
    for (std::size_t i = 0; i < modes; ++i) {
      unbalance_[i] += shape[i] * mass.moment_kg_m * std::cos(mass.phase_rad);
      unbalance_[modes + i] += shape[i] * mass.moment_kg_m * std::sin(mass.phase_rad);
    }
  }
}

void PlantModel::BuildBearings() {
  for (const auto& b : config().bearings) {
    BearingModel model;
    model.magnet = {b.magnet.force_constant_n_m2_per_a2, b.magnet.gap_m,
                    b.magnet.max_coil_current_a};
    model.amplifier = {b.magnet.max_coil_current_a,
                       amplifier::ConverterStep(b.magnet.max_coil_current_a, b.amplifier.dac_bits)};
    model.converter = {b.sensor.noise_rms_m,
                       amplifier::ConverterStep(b.sensor.range_m, b.sensor.adc_bits),
                       b.sensor.range_m};
    model.touchdown = {b.touchdown.clearance_m, b.touchdown.stiffness_n_per_m,
                       b.touchdown.damping_n_s_per_m, b.touchdown.friction,
                       b.touchdown.journal_radius_m};
    model.has_touchdown = b.touchdown.stiffness_n_per_m > 0.0;
    model.actuator_shape = ToVector(parameters_.modes.ShapeAt(b.actuator_z_m, b.shaft));
    model.sensor_shape = ToVector(parameters_.modes.ShapeAt(b.sensor_z_m, b.shaft));
    bearings_.push_back(std::move(model));
  }
}

void PlantModel::BuildSteps() {
  const double period_s = static_cast<double>(config().period_ns) * 1e-9;
  double whole = std::floor(config().delay_samples);
  double fraction = config().delay_samples - whole;
  if (fraction > 1.0 - kWholeSample) whole += 1.0;
  if (fraction < kWholeSample || fraction > 1.0 - kWholeSample) fraction = 0.0;
  whole_delay_ = static_cast<std::size_t>(whole);

  const int substeps = config().substeps;
  const std::array<double, 2> share{fraction, 1.0 - fraction};
  for (std::size_t part = 0; part < 2; ++part) {
    StepTable& table = steps_[part];
    if (share[part] == 0.0) continue;
    table.substeps = std::max(1, static_cast<int>(std::lround(substeps * share[part])));
    table.duration_s = share[part] * period_s / table.substeps;
    // Both planes carry the same numbers, so that one loop runs over all modes.
    for (std::size_t i = 0; i < coordinates(); ++i) {
      const bool twists = i >= 2 * layout_.modes;
      const auto mode =
          static_cast<Eigen::Index>(twists ? i - 2 * layout_.modes : i % layout_.modes);
      const ModeStep step =
          twists ? MakeModeStep(parameters_.torsion.frequency_rad_per_s[mode],
                                parameters_.torsion.damping_ratio[mode], table.duration_s)
                 : MakeModeStep(parameters_.modes.frequency_rad_per_s[mode],
                                parameters_.modes.damping_ratio[mode], table.duration_s);
      table.xx.push_back(step.xx);
      table.xv.push_back(step.xv);
      table.vx.push_back(step.vx);
      table.vv.push_back(step.vv);
      table.x0.push_back(step.x0);
      table.v0.push_back(step.v0);
      table.x1.push_back(step.x1);
      table.v1.push_back(step.v1);
    }
    for (const auto& b : config().bearings) {
      table.amplifier.push_back(amplifier::MakeStep(b.amplifier.bandwidth_hz,
                                                    b.amplifier.slew_a_per_s, table.duration_s));
      table.sensor.push_back(
          sensor::MakeFilterStep(b.sensor.bandwidth_hz, b.sensor.gain, table.duration_s));
    }
  }
}

}  // namespace levitas::plant
