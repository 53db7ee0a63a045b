#include "plant_sim/plant/shaft_loads.hpp"

#include "plant_sim/plant/modal_sum.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "plant_sim/rotor/torsion_springs.hpp"

namespace levitas::plant {
namespace {

/// m phi w^2: the row of M Phi W^2, the stiffness of the modes as force on the disc, of a lumped
/// shaft; a beam is free, and its supports hold it.
std::vector<double> BendingRow(const PlantConfig& config, const TrainModes& modes,
                               std::size_t shaft) {
  std::vector<double> row(static_cast<std::size_t>(modes.bending.frequency_rad_per_s.size()), 0.0);
  const rotor::Shaft& of = config.shafts[shaft];
  if (of.is_beam) return row;
  const auto shape = modes.bending.ShapeAt(of.lumped.z_m, shaft);
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double omega = modes.bending.frequency_rad_per_s[at];
    row[i] = of.lumped.mass_kg * shape[at] * omega * omega;
  }
  return row;
}

}  // namespace

ShaftLoads::ShaftLoads(const PlantModel& model)
    : shafts_(model.config().shafts.size()), layout_(model.layout()) {
  const PlantConfig& config = model.config();
  if (shafts_ == 0) return;
  const TrainModes modes = ReduceTrain(config);
  std::size_t foot = 0;
  const TrainModel& train = model.train();
  for (std::size_t s = 0; s < shafts_; ++s) {
    const rotor::Shaft& shaft = config.shafts[s];
    bending_.push_back(BendingRow(config, modes, s));
    const std::size_t feet =
        shaft.supports.size() + (!shaft.is_beam && shaft.lumped.damping_n_s_per_m > 0.0 ? 1 : 0);
    for (std::size_t k = 0; k < feet; ++k, ++foot) {
      const SupportModel& support = train.supports[foot];
      feet_.push_back({s, support.shape, support.stiffness_x_n_per_m, support.stiffness_y_n_per_m,
                       support.damping_x_n_s_per_m, support.damping_y_n_s_per_m});
    }
  }
  for (const rotor::TorsionSpring& from : rotor::TorsionSprings(config.shafts)) {
    Spring spring{train.inertias[from.inertia + 1].twist, from.stiffness_n_m_per_rad,
                  from.gauges.fitted};
    for (std::size_t t = 0; t < spring.twist.size(); ++t) {
      spring.twist[t] -= train.inertias[from.inertia].twist[t];
    }
    springs_.push_back(std::move(spring));
    twisted_.push_back(from.name);
  }
  for (const BearingConfig& bearing : config.bearings) shaft_of_bearing_.push_back(bearing.shaft);
}

std::vector<gear::Vector> ShaftLoads::Housing(const Plant& plant) const {
  std::vector<gear::Vector> force(shafts_);
  const double* state = plant.state().data();
  const double* x = state + layout_.q_x;
  const double* y = state + layout_.q_y;
  for (std::size_t s = 0; s < shafts_; ++s) {
    force[s] = {ModalSum(bending_[s], x), ModalSum(bending_[s], y)};
  }
  for (const Foot& foot : feet_) {
    force[foot.shaft] =
        force[foot.shaft] + gear::Vector{foot.kx * ModalSum(foot.shape, x) +
                                             foot.cx * ModalSum(foot.shape, state + layout_.v_x),
                                         foot.ky * ModalSum(foot.shape, y) +
                                             foot.cy * ModalSum(foot.shape, state + layout_.v_y)};
  }
  const AxisArray magnet_n = plant.MagnetForce();
  for (std::size_t b = 0; b < shaft_of_bearing_.size(); ++b) {
    force[shaft_of_bearing_[b]] =
        force[shaft_of_bearing_[b]] + gear::Vector{-magnet_n[2 * b], -magnet_n[2 * b + 1]};
  }
  return force;
}

std::vector<double> ShaftLoads::Torques(const Plant& plant) const {
  std::vector<double> torque;
  for (const Spring& spring : springs_) {
    torque.push_back(spring.stiffness_n_m_per_rad *
                     ModalSum(spring.twist, plant.state().data() + layout_.q_t));
  }
  return torque;
}

void ShaftLoads::Gauge(const Plant& plant, std::span<double> torque_n_m,
                       std::span<double> twist_rad) const noexcept {
  std::size_t at = 0;
  for (const Spring& spring : springs_) {
    if (!spring.gauged) continue;
    twist_rad[at] = ModalSum(spring.twist, plant.state().data() + layout_.q_t);
    torque_n_m[at] = spring.stiffness_n_m_per_rad * twist_rad[at];
    ++at;
  }
}

}  // namespace levitas::plant
