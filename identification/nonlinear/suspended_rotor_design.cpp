#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "identification/nonlinear/suspended_rotor_fit.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

Index WholeDelay(const plant::PlantConfig& rig) {
  const double delay = rig.delay_samples;
  if (delay != std::floor(delay)) {
    throw BadInput(fmt::format(
        "sampling.delay_samples = {}: this model takes whole samples; give the nearest", delay));
  }
  return static_cast<Index>(delay);
}

std::vector<RotorMode> ModesOf(const plant::PlantModel& rig) {
  const auto bearings = static_cast<Index>(rig.bearings().size());
  std::vector<RotorMode> modes;
  for (std::size_t r = 0; r < rig.layout().modes; ++r) {
    RotorMode mode{rig.frequency()[r] / (2.0 * std::numbers::pi), rig.damping_ratio()[r],
                   Eigen::VectorXd(bearings), Eigen::VectorXd(bearings)};
    for (Index b = 0; b < bearings; ++b) {
      const plant::BearingModel& bearing = rig.bearings()[static_cast<std::size_t>(b)];
      const double bias_a =
          rig.config().bearings[static_cast<std::size_t>(b)].magnet.bias_current_a;
      mode.out[b] = bearing.actuator_shape[r];
      mode.in[b] = mode.out[b] * magnet::ForcePerCurrent(bearing.magnet, bias_a);
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace

SuspendedRotor DesignOf(const plant::PlantParameters& parameters, Index iron) {
  const plant::PlantModel rig(parameters);
  SuspendedRotor model;
  model.period_s = 1e-9 * static_cast<double>(rig.config().period_ns);
  model.delay = WholeDelay(rig.config());
  model.plane = {ModesOf(rig), ModesOf(rig)};
  model.sensor.resize(rig.axes());
  for (std::size_t a = 0; a < rig.axes(); ++a) {
    const plant::BearingConfig& bearing = rig.config().bearings[a / 2];
    if (bearing.sensor_z_m != bearing.actuator_z_m) {
      throw BadInput(
          fmt::format("bearing {}: sensor_z_mm = {:.6g}, actuator_z_mm = {:.6g}: this model takes "
                      "sensors in the "
                      "magnets' planes",
                      bearing.name, 1e3 * bearing.sensor_z_m, 1e3 * bearing.actuator_z_m));
    }
    model.axis.push_back({rig.amplifier_bandwidth_hz(a), bearing.magnet.bias_current_a,
                          bearing.magnet.gap_m, 0.0, 0.0, Eigen::VectorXd::Zero(iron)});
  }
  return model;
}

}  // namespace levitas::identification
