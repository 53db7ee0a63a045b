#include "plant_sim/plant/check_config.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "plant_sim/plant/train_model.hpp"
#include "plant_sim/sensor/characteristic.hpp"

namespace levitas::plant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// low <= value <= high; a comparison with NaN fails, so it is refused too.
void Within(const std::string& name, double value, double low, double high) {
  if (value >= low && value <= high && std::isfinite(value)) return;
  throw std::invalid_argument(fmt::format("{} = {}, allowed {} to {}; correct the rig description",
                                          name, value, low, high));
}

void Positive(const std::string& name, double value) {
  Within(name, value, std::numeric_limits<double>::min(), kInfinity);
}

void NotNegative(const std::string& name, double value) { Within(name, value, 0.0, kInfinity); }

void CheckBearing(const BearingConfig& b, const std::string& at) {
  if (const auto& law = b.magnet.exponential) {
    Positive(at + "magnet.force_n_per_a2", law->force_n_per_a2);
    Positive(at + "magnet.decay_m", law->decay_m);
    NotNegative(at + "magnet.far_gap_m", law->far_gap_m);
  } else {
    Positive(at + "magnet.force_constant_n_m2_per_a2", b.magnet.force_constant_n_m2_per_a2);
  }
  Positive(at + "magnet.gap_m", b.magnet.gap_m);
  Positive(at + "magnet.max_coil_current_a", b.magnet.max_coil_current_a);
  Within(at + "magnet.bias_current_a", b.magnet.bias_current_a, 0.0, b.magnet.max_coil_current_a);
  if (const auto& coil = b.amplifier.voltage) {
    Positive(at + "amplifier.steady", coil->steady);
    Within(at + "amplifier.offset_a", coil->offset_a, -kInfinity, kInfinity);
    Positive(at + "amplifier.time_constant_s", coil->time_constant_s);
    Positive(at + "amplifier.decay_m", coil->decay_m);
    Within(at + "amplifier.motion_emf", coil->motion_emf, -kInfinity, kInfinity);
    Within(at + "amplifier.dead_band_a", coil->dead_band_a, 0.0, b.magnet.max_coil_current_a);
    Within(at + "amplifier.curvature", coil->curvature, -1.0, 1.0);
    NotNegative(at + "amplifier.iron_1_per_a2", coil->iron_1_per_a2);
    Within(at + "amplifier.warming_1_per_s", coil->warming_1_per_s, -kInfinity, kInfinity);
    Positive(at + "amplifier.away_steady_ratio", coil->away_steady_ratio);
    Positive(at + "amplifier.away_time_constant_ratio", coil->away_time_constant_ratio);
  } else {
    Positive(at + "amplifier.bandwidth_hz", b.amplifier.bandwidth_hz);
  }
  NotNegative(at + "amplifier.slew_a_per_s", b.amplifier.slew_a_per_s);
  Within(at + "amplifier.dac_bits", b.amplifier.dac_bits, 0, 32);
  Positive(at + "sensor.bandwidth_hz", b.sensor.bandwidth_hz);
  NotNegative(at + "sensor.noise_rms_m", b.sensor.noise_rms_m);
  Within(at + "sensor.adc_bits", b.sensor.adc_bits, 0, 32);
  NotNegative(at + "sensor.range_m", b.sensor.range_m);
  if (b.sensor.adc_bits > 0) Positive(at + "sensor.range_m (with adc_bits)", b.sensor.range_m);
  sensor::CheckCharacteristic(at + "sensor.characteristic", b.sensor.characteristic);
  Within(at + "sensor.gain", b.sensor.gain, -kInfinity, kInfinity);
  Within(at + "touchdown.clearance_m", b.touchdown.clearance_m, 0.0, b.magnet.gap_m);
  NotNegative(at + "touchdown.stiffness_n_per_m", b.touchdown.stiffness_n_per_m);
  NotNegative(at + "touchdown.damping_n_s_per_m", b.touchdown.damping_n_s_per_m);
  NotNegative(at + "touchdown.friction", b.touchdown.friction);
  NotNegative(at + "touchdown.journal_radius_m", b.touchdown.journal_radius_m);
}

void CheckWheel(const gear::Wheel& wheel, std::size_t shafts, const std::string& at) {
  Within(at + "shaft", static_cast<double>(wheel.shaft), 0.0, static_cast<double>(shafts) - 1.0);
  Within(at + "teeth", wheel.teeth, 1, 100'000);
  NotNegative(at + "base_radius_m", wheel.base_radius_m);
  NotNegative(at + "runout_m", wheel.runout_m);
  Within(at + "runout_phase_rad", wheel.runout_phase_rad, -kInfinity, kInfinity);
  NotNegative(at + "eccentric_mass_kg", wheel.eccentric_mass_kg);
}

void CheckGear(const gear::GearPair& pair, std::size_t shafts, const std::string& at) {
  CheckWheel(pair.driving, shafts, at + "driving.");
  CheckWheel(pair.driven, shafts, at + "driven.");
  Positive(at + "stiffness_n_per_m", pair.stiffness_n_per_m);
  NotNegative(at + "damping_n_s_per_m", pair.damping_n_s_per_m);
  NotNegative(at + "driving_torque_n_m", pair.driving_torque_n_m);
  NotNegative(at + "backlash_m", pair.imperfection.backlash_m);
  NotNegative(at + "friction", pair.imperfection.friction);
  for (const auto& crack : pair.imperfection.cracks) Within(at + "crack.depth", crack.depth, 0, 1);
}

// Geared shafts: what refers to what, and no weight, which the alignment under load contains.
void CheckTrain(const PlantConfig& config) {
  const std::size_t shafts = config.shafts.size();
  Within("number of shafts", static_cast<double>(shafts), 1, kMaxShafts);
  Within("number of gears", static_cast<double>(config.gears.size()), 0, kMaxGears);
  Within("gravity_m_per_s2 (with shafts, which count from their loaded rest)",
         config.gravity_m_per_s2, 0.0, 0.0);
  for (std::size_t i = 0; i < config.gears.size(); ++i) {
    CheckGear(config.gears[i], shafts, fmt::format("gears[{}].", i));
  }
  const double last = static_cast<double>(shafts) - 1.0;
  for (const auto& b : config.bearings) {
    Within("shaft of a bearing", static_cast<double>(b.shaft), 0.0, last);
  }
  for (const auto& mass : config.unbalance) {
    Within("shaft of an unbalance", static_cast<double>(mass.shaft), 0.0, last);
  }
}

}  // namespace

void CheckConfig(const PlantConfig& config) {
  Positive("period_ns", static_cast<double>(config.period_ns));
  Within("delay_samples", config.delay_samples, 0.0, 64.0);
  Within("substeps", config.substeps, 1, 10'000);
  // Shafts that stand on supports of their own need no magnet.
  Within("number of bearings", static_cast<double>(config.bearings.size()),
         config.shafts.empty() ? 1.0 : 0.0, kMaxAxes / 2.0);
  if (!config.shafts.empty()) CheckTrain(config);
  for (std::size_t i = 0; i < config.bearings.size(); ++i) {
    CheckBearing(config.bearings[i], fmt::format("bearings[{}].", i));
  }
  for (const auto& bearing : config.bearings) {
    if (!bearing.x_only || config.bearings.size() == 1) continue;
    throw std::invalid_argument(
        "x_only is for a rig with one bearing; give the others' y axes too");
  }
  for (std::size_t i = 0; i < 2 * config.bearings.size(); ++i) {
    for (const auto* polarity : {&config.sensor_polarity, &config.actuator_polarity}) {
      if (std::abs((*polarity)[i]) == 1.0) continue;
      throw std::invalid_argument(fmt::format(
          "{}_polarity[{}] = {}, allowed +1 or -1",
          polarity == &config.sensor_polarity ? "sensor" : "actuator", i, (*polarity)[i]));
    }
  }
  for (const auto& mass : config.unbalance) {
    Within("unbalance moment_kg_m", mass.moment_kg_m, 0.0, kInfinity);
    Within("unbalance phase_rad", mass.phase_rad, -kInfinity, kInfinity);
  }
  Within("gravity_m_per_s2", config.gravity_m_per_s2, 0.0, kInfinity);
  Within("gravity_direction_rad", config.gravity_direction_rad, -kInfinity, kInfinity);
  NotNegative("drive.max_acceleration_rad_per_s2", config.drive.max_acceleration_rad_per_s2);
  NotNegative("drive.coast_down_1_per_s", config.drive.coast_down_1_per_s);
  NotNegative("drive.coast_down_rad_per_s2", config.drive.coast_down_rad_per_s2);
  NotNegative("drive.polar_inertia_kg_m2", config.drive.polar_inertia_kg_m2);
  CheckEffects(config);
}

void CheckMode(std::size_t mode, double frequency_rad_per_s, double damping_ratio) {
  const std::string at = fmt::format("rotor.modes[{}].", mode);
  NotNegative(at + "frequency (rad/s)", frequency_rad_per_s);
  Within(at + "damping_ratio", damping_ratio, 0.0, 0.999);
}

}  // namespace levitas::plant
