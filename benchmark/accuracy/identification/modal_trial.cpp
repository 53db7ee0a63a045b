#include "benchmark/accuracy/identification/modal_trial.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "benchmark/accuracy/perturbed_rig.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::accuracy {
namespace {

using Index = Eigen::Index;

Mismatch UnknownOf(const RigidBodyOff& rigid) {
  Mismatch off;
  off.current_gain = 0.08;
  off.displacement_stiffness = 0.08;
  off.sensor_gain = 0.03;
  off.modal_frequency = 0.03;
  off.modal_damping = 0.4;
  off.modal_shape = 0.04;
  // Known to the method, or of no effect on what it can tell.
  off.amplifier_bandwidth = off.sensor_bandwidth = off.sensor_position_m = 0.0;
  off.rotor_mass = rigid.mass;
  off.transverse_inertia = rigid.inertia;
  return off;
}

double RigidMass(const plant::PlantModel& model) { return model.rigid().col(0).squaredNorm(); }

double Mean(const session::Column& column) {
  double sum = 0.0;
  for (const double value : column) sum += value;
  return sum / static_cast<double>(column.size());
}

/// Where the rotor stands at the magnets of one plane, from where it stands at the sensors: between
/// them it sags. The magnets' forces balance the static ones on the rigid modes, the bending modes
/// give way to both.
Eigen::VectorXd AtMagnets(const plant::PlantModel& model, const Eigen::VectorXd& at_sensors_m,
                          Index plane) {
  const auto& w = model.parameters().modes.frequency_rad_per_s;
  const Index n = w.size();
  const auto bearings = static_cast<Index>(model.bearings().size());
  Eigen::MatrixXd actuator(n, bearings);
  Eigen::MatrixXd sensor(n, bearings);
  for (Index b = 0; b < bearings; ++b) {
    const auto& shapes = model.bearings()[static_cast<std::size_t>(b)];
    actuator.col(b) = Eigen::Map<const Eigen::VectorXd>(shapes.actuator_shape.data(), n);
    sensor.col(b) = Eigen::Map<const Eigen::VectorXd>(shapes.sensor_shape.data(), n);
  }
  const Eigen::Map<const Eigen::VectorXd> load(model.gravity().data() + plane * n, n);
  const Eigen::VectorXd force = actuator.topRows(2).partialPivLu().solve(-load.head(2));
  const Eigen::VectorXd bent = (actuator.bottomRows(n - 2) * force + load.tail(n - 2))
                                   .cwiseQuotient(w.tail(n - 2).cwiseAbs2());
  const Eigen::VectorXd rigid = sensor.topRows(2).transpose().partialPivLu().solve(
      at_sensors_m - sensor.bottomRows(n - 2).transpose() * bent);
  return actuator.topRows(2).transpose() * rigid + actuator.bottomRows(n - 2).transpose() * bent;
}

ModalTruth Truth(const plant::PlantModel& model, const session::Recording& record) {
  const auto& modes = model.parameters().modes;
  const auto& bearings = model.config().bearings;
  const auto axes = static_cast<Index>(2 * bearings.size());
  const Index bending = modes.frequency_rad_per_s.size() - 2;
  ModalTruth truth{modes.frequency_rad_per_s.tail(bending) / (2.0 * std::numbers::pi),
                   modes.damping_ratio.tail(bending), Eigen::VectorXd(axes), Eigen::VectorXd(axes)};
  Eigen::VectorXd at_sensors_m(axes);
  for (Index axis = 0; axis < axes; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto& reading = model.effects().readings[a];
    // Where the rotor rests: the probe's own offset is not the rotor's.
    at_sensors_m[axis] = (Mean(record.position_m[a]) - reading.offset_m) / reading.gain;
  }
  Eigen::VectorXd at_magnets_m(axes);
  for (Index plane = 0; plane < 2; ++plane) {
    const auto own = Eigen::seqN(plane, axes / 2, 2);
    at_magnets_m(own) = AtMagnets(model, at_sensors_m(own), plane);
  }
  for (Index axis = 0; axis < axes; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto& bearing = bearings[a / 2];
    const auto& e = model.effects().bearings[a / 2].axis[a % 2];
    const double k = bearing.magnet.force_constant_n_m2_per_a2;
    const double s0 = bearing.magnet.gap_m;
    const double i0 = bearing.magnet.bias_current_a;
    const auto& reading = model.effects().readings[a];
    const double x = at_magnets_m[axis];
    const double i = e.gain * Mean(record.current_a[a]);
    const double up = (i0 + i) / (s0 - x);
    const double down = (i0 - i) / (s0 + x);
    const double ki_n_per_a = e.gain * 2.0 * k * (up / (s0 - x) + down / (s0 + x));
    const double ks_n_per_m =
        2.0 * k * (up * up / (s0 - x) + down * down / (s0 + x)) + e.stiffness_n_per_m;
    truth.ki_product[axis] = ki_n_per_a * reading.gain / RigidMass(model);
    truth.ks_product[axis] = ks_n_per_m / RigidMass(model);
  }
  return truth;
}

Eigen::VectorXd Relative(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  return (found.array() / truth.array() - 1.0).abs();
}

}  // namespace

ModalTrial MakeModalTrial(const configuration::RigFile& nominal, const ExcitationPlan& plan,
                          const RigidBodyOff& rigid) {
  Random random(plan.seed);
  const plant::PlantParameters truth = PerturbedRig(nominal.plant, UnknownOf(rigid), {}, random);
  const plant::PlantModel model(truth);
  ModalTrial trial{SimulateCampaign(nominal, truth, plan), {}};
  trial.truth = Truth(model, trial.record);
  return trial;
}

ModalErrors Compare(const ModalTruth& truth, const identification::Physical& found) {
  const Index bending = found.frequency_rad_per_s.size() - 2;
  ModalErrors errors;
  errors.frequency = Relative(found.frequency_rad_per_s.tail(bending) / (2.0 * std::numbers::pi),
                              truth.frequency_hz.head(bending));
  errors.damping = Relative(found.damping_ratio.tail(bending), truth.damping_ratio.head(bending));
  errors.ki_product =
      Relative(found.ki_n_per_a.cwiseProduct(found.gain) / found.mass_kg, truth.ki_product);
  errors.ks_product = Relative(found.ks_n_per_m / found.mass_kg, truth.ks_product);
  errors.deflection_per_ampere =
      Relative(found.ki_n_per_a.cwiseProduct(found.gain).cwiseQuotient(found.ks_n_per_m),
               truth.ki_product.cwiseQuotient(truth.ks_product));
  return errors;
}

ModalScores Score(const ModalTruth& truth, const identification::ModalResult& found) {
  const identification::Physical& rig = found.rig;
  const auto& at = found.start.frame.layout;
  const Eigen::VectorXd& deviation = found.uncertainty.deviation;
  const auto score = [](const Eigen::VectorXd& value, const Eigen::VectorXd& true_value,
                        const Eigen::VectorXd& sigma) -> Eigen::VectorXd {
    return (value.array() / true_value.array()).log() / sigma.array();
  };
  const Index n = at.bending;
  return {score(rig.frequency_rad_per_s.tail(n) / (2.0 * std::numbers::pi),
                truth.frequency_hz.head(n), deviation.segment(at.frequency, n)),
          score(rig.damping_ratio.tail(n), truth.damping_ratio.head(n),
                deviation.segment(at.damping, n)),
          score(rig.ki_n_per_a.cwiseProduct(rig.gain) / rig.mass_kg, truth.ki_product,
                found.uncertainty.products.head(at.axes())),
          score(rig.ks_n_per_m / rig.mass_kg, truth.ks_product,
                found.uncertainty.products.tail(at.axes()))};
}

}  // namespace levitas::accuracy
