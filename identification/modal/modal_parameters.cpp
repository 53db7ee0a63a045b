#include "identification/modal/modal_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

struct Writer {
  ModalStart& start;
  void Put(Index at, std::string name, double value, double prior) const {
    start.vector[at] = value;
    start.prior[at] = prior;
    start.names[static_cast<std::size_t>(at)] = std::move(name);
  }
};

const plant::BearingConfig& Bearing(const plant::PlantConfig& rig, Index b) {
  return rig.bearings[static_cast<std::size_t>(b)];
}

std::string AxisName(const plant::PlantConfig& rig, Index axis) {
  return Bearing(rig, axis / 2).name + (axis % 2 == 0 ? "_x" : "_y");
}

/// Rigid body behind the two rigid modes of the reduced model: they are a rotation of
/// (1/sqrt(m), (z - zc)/sqrt(It)) among themselves.
struct RigidBody {
  double mass_kg, centre_z_m, inertia_kg_m2;
};

RigidBody RigidBodyOf(const plant::PlantModel& model) {
  // |unit shift|^2 = m, |unit slope about z = 0|^2 = It + m zc^2, their product = m zc.
  const Eigen::VectorXd shift = model.rigid().col(0);
  const Eigen::VectorXd slope = model.rigid().col(1);
  const double mass = shift.squaredNorm();
  const double centre = shift.dot(slope) / mass;
  const Eigen::VectorXd tilt = slope - centre * shift;
  return {mass, centre, tilt.squaredNorm()};
}

void PutRotor(const plant::PlantConfig& rig, const plant::PlantModel& model, const Writer& to) {
  const ModalLayout& at = to.start.frame.layout;
  const RigidBody body = RigidBodyOf(model);
  to.start.frame.nominal_mass_kg = body.mass_kg;
  to.Put(at.mass, "mass", std::log(body.mass_kg), 0.005);
  to.Put(at.centre, "centre_z", body.centre_z_m / 0.1, 0.005);
  to.Put(at.inertia, "transverse_inertia", std::log(body.inertia_kg_m2), 0.01);
  const auto& modes = model.parameters().modes;
  const Index known = modes.frequency_rad_per_s.size() - 2;
  const double scale = std::sqrt(body.mass_kg);
  for (Index i = 0; i < at.bending; ++i) {
    const bool has = i < known;
    const double w = has ? modes.frequency_rad_per_s[2 + i] : 1.0;
    const double z = has ? std::max(modes.damping_ratio[2 + i], 1e-4) : 0.003;
    to.Put(at.frequency + i, fmt::format("frequency_{}", i + 1), std::log(w), 0.3);
    to.Put(at.damping + i, fmt::format("damping_{}", i + 1), std::log(z), 2.0);
    for (Index plane = 0; plane < 2 * at.bearings; ++plane) {
      const bool actuator = plane < at.bearings;
      const Index b = actuator ? plane : plane - at.bearings;
      const auto& shapes = model.bearings()[static_cast<std::size_t>(b)];
      const auto& row = actuator ? shapes.actuator_shape : shapes.sensor_shape;
      const double value =
          has ? scale * row[static_cast<std::size_t>(2 + i)] : (plane % 2 == 0 ? 0.3 : -0.3);
      to.Put(at.shape_at(i, plane),
             fmt::format("deflection_{}_{}_{}", i + 1, actuator ? "actuator" : "sensor",
                         Bearing(rig, b).name),
             value, has ? 0.1 : 1.0);
    }
  }
  // Gyroscopic matrix in (tilt, bending modes): the tilt as a unit vector of the rigid modes.
  const Eigen::VectorXd tilt = (model.rigid().col(1) - body.centre_z_m * model.rigid().col(0)) /
                               std::sqrt(body.inertia_kg_m2);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(modes.frequency_rad_per_s.size(), at.bending + 1);
  basis.col(0) = tilt;
  for (Index i = 0; i < std::min(known, at.bending); ++i) basis(2 + i, 1 + i) = 1.0;
  const Eigen::MatrixXd g = basis.transpose() * modes.gyroscopic * basis;
  for (Index i = 0; i <= at.bending; ++i) {
    for (Index j = 0; j <= i; ++j) {
      to.Put(at.gyroscopic_at(i, j), fmt::format("gyroscopic_{}_{}", i, j), g(i, j), 0.3);
    }
  }
}

void PutBeyond(const plant::PlantModel& model, const Writer& to) {
  const ModalLayout& at = to.start.frame.layout;
  const auto& frequency = model.parameters().modes.frequency_rad_per_s;
  const Index first = std::min<Index>(at.modes(), frequency.size());
  const Index count = frequency.size() - first;
  ModesBeyond& beyond = to.start.frame.beyond;
  beyond.frequency_rad_per_s = frequency.tail(count);
  beyond.actuator.resize(count, at.bearings);
  beyond.sensor.resize(count, at.bearings);
  for (Index b = 0; b < at.bearings; ++b) {
    const auto& shapes = model.bearings()[static_cast<std::size_t>(b)];
    for (Index i = 0; i < count; ++i) {
      const auto mode = static_cast<std::size_t>(first + i);
      beyond.actuator(i, b) = shapes.actuator_shape[mode];
      beyond.sensor(i, b) = shapes.sensor_shape[mode];
    }
  }
}

void PutChain(const plant::PlantConfig& rig, const Writer& to) {
  const ModalLayout& at = to.start.frame.layout;
  for (Index axis = 0; axis < at.axes(); ++axis) {
    const auto& b = Bearing(rig, axis / 2);
    const magnet::Magnet magnet{b.magnet.force_constant_n_m2_per_a2, b.magnet.gap_m,
                                b.magnet.max_coil_current_a};
    const std::string name = AxisName(rig, axis);
    const double ki = magnet::ForcePerCurrent(magnet, b.magnet.bias_current_a);
    const double ks = magnet::NegativeStiffness(magnet, b.magnet.bias_current_a);
    to.Put(at.ki + axis, "ki_" + name, std::log(ki), 0.5);
    to.Put(at.ks + axis, "ks_" + name, std::log(ks), 0.5);
    to.Put(at.gain + axis, "sensor_gain_" + name, std::log(b.sensor.gain), 0.05);
  }
  to.Put(at.delay, "delay_samples", rig.delay_samples, 0.3);
  for (Index b = 0; b < at.bearings; ++b) {
    const auto& bearing = Bearing(rig, b);
    to.Put(at.amplifier + b, "amplifier_" + bearing.name, std::log(bearing.amplifier.bandwidth_hz),
           0.3);
    to.Put(at.sensor + b, "sensor_bandwidth_" + bearing.name, std::log(bearing.sensor.bandwidth_hz),
           0.3);
    to.start.frame.actuator_z_m[b] = bearing.actuator_z_m;
    to.start.frame.sensor_z_m[b] = bearing.sensor_z_m;
    to.start.frame.bias_current_a[b] = bearing.magnet.bias_current_a;
    to.start.frame.gap_m[b] = bearing.magnet.gap_m;
  }
}

}  // namespace

ModalLayout::ModalLayout(Index bearing_count, Index bending_modes)
    : bearings(bearing_count), bending(bending_modes) {
  mass = 0;
  centre = 1;
  inertia = 2;
  frequency = 3;
  damping = frequency + bending;
  shape = damping + bending;
  ki = shape + bending * 2 * bearings;
  ks = ki + axes();
  gain = ks + axes();
  delay = gain + axes();
  amplifier = delay + 1;
  sensor = amplifier + bearings;
  gyroscopic = sensor + bearings;
  size = gyroscopic + (bending + 1) * (bending + 2) / 2;
}

Physical ToPhysical(const ModalFrame& frame, const Eigen::VectorXd& v) {
  const ModalLayout& at = frame.layout;
  const Index n = at.modes();
  Physical p;
  p.mass_kg = std::exp(v[at.mass]);
  p.centre_z_m = 0.1 * v[at.centre];
  p.inertia_kg_m2 = std::exp(v[at.inertia]);
  p.frequency_rad_per_s = Eigen::VectorXd::Zero(n);
  p.damping_ratio = Eigen::VectorXd::Zero(n);
  p.frequency_rad_per_s.tail(at.bending) = v.segment(at.frequency, at.bending).array().exp();
  p.damping_ratio.tail(at.bending) = v.segment(at.damping, at.bending).array().exp();
  p.actuator.resize(n, at.bearings);
  p.sensor.resize(n, at.bearings);
  p.actuator.row(0).setConstant(1.0 / std::sqrt(p.mass_kg));
  p.sensor.row(0).setConstant(1.0 / std::sqrt(p.mass_kg));
  const double tilt = 1.0 / std::sqrt(p.inertia_kg_m2);
  p.actuator.row(1) = tilt * (frame.actuator_z_m.array() - p.centre_z_m).matrix().transpose();
  p.sensor.row(1) = tilt * (frame.sensor_z_m.array() - p.centre_z_m).matrix().transpose();
  const double scale = 1.0 / std::sqrt(frame.nominal_mass_kg);
  for (Index i = 0; i < at.bending; ++i) {
    for (Index b = 0; b < at.bearings; ++b) {
      p.actuator(2 + i, b) = scale * v[at.shape_at(i, b)];
      p.sensor(2 + i, b) = scale * v[at.shape_at(i, at.bearings + b)];
    }
  }
  p.ki_n_per_a = v.segment(at.ki, at.axes()).array().exp();
  p.ks_n_per_m = v.segment(at.ks, at.axes()).array().exp();
  p.gain = v.segment(at.gain, at.axes()).array().exp();
  p.delay_samples = v[at.delay];
  p.amplifier_hz = v.segment(at.amplifier, at.bearings).array().exp();
  p.sensor_hz = v.segment(at.sensor, at.bearings).array().exp();
  p.gyroscopic = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i <= at.bending; ++i) {
    for (Index j = 0; j <= at.bending; ++j) {
      p.gyroscopic(1 + i, 1 + j) = v[at.gyroscopic_at(i, j)];
    }
  }
  return p;
}

ModalStart StartFromRig(const plant::PlantConfig& rig, Index bending_modes) {
  const auto bearings = static_cast<Index>(rig.bearings.size());
  ModalStart start{{ModalLayout(bearings, bending_modes),
                    Eigen::VectorXd(bearings),
                    Eigen::VectorXd(bearings),
                    static_cast<double>(rig.period_ns) * 1e-9,
                    0.0,
                    Eigen::VectorXd(bearings),
                    Eigen::VectorXd(bearings),
                    {}},
                   {},
                   {},
                   {}};
  const Index size = start.frame.layout.size;
  start.vector = Eigen::VectorXd::Zero(size);
  start.prior = Eigen::VectorXd::Ones(size);
  start.names.resize(static_cast<std::size_t>(size));
  const plant::PlantModel model(rig);
  PutRotor(rig, model, {start});
  PutBeyond(model, {start});
  PutChain(rig, {start});
  return start;
}

}  // namespace levitas::identification
