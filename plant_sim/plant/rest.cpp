#include "plant_sim/plant/rest.hpp"

#include <array>
#include <cmath>

#include "plant_sim/plant/time_step.hpp"

namespace levitas::plant {
namespace {

using PerBearing = std::array<double, kMaxAxes / 2>;

struct Line {
  double offset;
  double slope;
};

// The straight line through values at the actuator planes.
Line Fit(const PlantModel& model, const PerBearing& value) noexcept {
  const auto& bearings = model.config().bearings;
  const auto count = static_cast<double>(bearings.size());
  double mean_z = 0.0;
  double mean = 0.0;
  for (std::size_t b = 0; b < bearings.size(); ++b) {
    mean_z += bearings[b].actuator_z_m / count;
    mean += value[b] / count;
  }
  double spread = 0.0;
  double product = 0.0;
  for (std::size_t b = 0; b < bearings.size(); ++b) {
    const double dz = bearings[b].actuator_z_m - mean_z;
    spread += dz * dz;
    product += dz * (value[b] - mean);
  }
  const double slope = spread > 0.0 ? product / spread : 0.0;
  return {mean - slope * mean_z, slope};
}

void AddLine(const PlantModel& model, const Line& line, double* modal) noexcept {
  for (Eigen::Index row = 0; row < model.parameters().modes.rigid_modes; ++row) {
    modal[row] += line.offset * model.rigid()(row, 0) + line.slope * model.rigid()(row, 1);
  }
}

// Bearing forces that carry the weight: equal to it in sum and in moment, (38). With more than two
// bearings the distribution that varies linearly along the shaft.
PerBearing Reactions(const PlantModel& model) noexcept {
  const auto& bearings = model.config().bearings;
  const double weight_n = model.config().gravity_m_per_s2 * model.parameters().modes.total_mass_kg;
  // Translation modal coordinates t and slope coordinates s: t.t = mass, t.s = mass times centre.
  const auto& rigid = model.rigid();
  const double centre_m = rigid.col(0).dot(rigid.col(1)) / rigid.col(0).squaredNorm();
  double mean_z = 0.0;
  const auto count = static_cast<double>(bearings.size());
  for (const auto& b : bearings) mean_z += b.actuator_z_m / count;
  double spread = 0.0;
  for (const auto& b : bearings) spread += std::pow(b.actuator_z_m - mean_z, 2);
  PerBearing reaction{};
  for (std::size_t b = 0; b < bearings.size(); ++b) {
    const double dz = bearings[b].actuator_z_m - mean_z;
    reaction[b] = weight_n / count;
    if (spread > 0.0) reaction[b] += weight_n * (centre_m - mean_z) * dz / spread;
  }
  return reaction;
}

}  // namespace

void PlaceRigidly(const PlantModel& model, const AxisArray& actuator_position_m,
                  std::span<double> state) noexcept {
  const StateLayout& at = model.layout();
  for (std::size_t plane = 0; plane < 2; ++plane) {
    PerBearing value{};
    for (std::size_t b = 0; b < model.bearings().size(); ++b) {
      value[b] = actuator_position_m[2 * b + plane];
    }
    double* modal = state.data() + (plane == 0 ? at.q_x : at.q_y);
    if (model.train().shafts > 0) {
      const Eigen::MatrixXd& placement = model.train().placement;
      for (std::size_t i = 0; i < at.modes; ++i) {
        modal[i] = 0.0;
        for (std::size_t b = 0; b < model.bearings().size(); ++b) {
          modal[i] +=
              placement(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(b)) * value[b];
        }
      }
      continue;
    }
    for (std::size_t i = 0; i < at.modes; ++i) modal[i] = 0.0;
    AddLine(model, Fit(model, value), modal);
  }
}

void PlaceInTouchdown(const PlantModel& model, std::span<double> state) noexcept {
  PlaceRigidly(model, {}, state);
  const StateLayout& at = model.layout();
  if (model.config().gravity_m_per_s2 == 0.0) return;
  for (const auto& b : model.bearings()) {
    if (!b.has_touchdown) return;
  }
  // Along the direction of gravity: the shaft bends under the reactions, then is laid, as a rigid
  // body, onto the two bearings. The y plane gets the same shape, scaled by the direction.
  const PerBearing reaction_n = Reactions(model);
  double* modal = state.data() + at.q_x;
  const auto rigid_modes = static_cast<std::size_t>(model.parameters().modes.rigid_modes);
  for (std::size_t i = rigid_modes; i < at.modes; ++i) {
    const double w = model.parameters().modes.frequency_rad_per_s[static_cast<Eigen::Index>(i)];
    for (std::size_t b = 0; b < model.bearings().size(); ++b) {
      modal[i] -= model.bearings()[b].actuator_shape[i] * reaction_n[b] / (w * w);
    }
  }
  PerBearing missing_m{};
  for (std::size_t b = 0; b < model.bearings().size(); ++b) {
    const auto& touchdown = model.bearings()[b].touchdown;
    // A bearing that has to hold the shaft down touches it on the other side.
    const double seat_m =
        std::copysign(touchdown.clearance_m + std::abs(reaction_n[b]) / touchdown.stiffness_n_per_m,
                      reaction_n[b]);
    missing_m[b] = seat_m - AtPlane(model.bearings()[b].actuator_shape, modal);
  }
  AddLine(model, Fit(model, missing_m), modal);
  const double c = std::cos(model.config().gravity_direction_rad);
  const double s = std::sin(model.config().gravity_direction_rad);
  for (std::size_t i = 0; i < at.modes; ++i) {
    state[at.q_y + i] = s * modal[i];
    state[at.q_x + i] = c * modal[i];
  }
}

}  // namespace levitas::plant
