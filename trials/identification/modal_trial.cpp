#include "trials/identification/modal_trial.hpp"

#include <cmath>
#include <numbers>

#include "plant_sim/plant/plant_model.hpp"
#include "trials/true_rig.hpp"

namespace levitas::trials {
namespace {

using Index = Eigen::Index;

Mismatch Unknown() {
  Mismatch off;
  off.current_gain = 0.08;
  off.displacement_stiffness = 0.08;
  off.sensor_gain = 0.03;
  off.modal_frequency = 0.03;
  off.modal_damping = 0.4;
  off.modal_shape = 0.04;
  // Known to the method, or of no effect on what it can tell.
  off.amplifier_bandwidth = off.sensor_bandwidth = off.sensor_position_m = 0.0;
  off.rotor_mass = 0.0;
  return off;
}

/// Means of dF/di and dF/dx over the rows taken standing.
struct WorkingPoint {
  double ki_n_per_a{}, ks_n_per_m{};
};

WorkingPoint MeanSlopes(const identification::Record& record, std::size_t axis,
                        const plant::BearingConfig& bearing, double ki_ratio) {
  const double k = bearing.magnet.force_constant_n_m2_per_a2;
  const double s0 = bearing.magnet.gap_m;
  const double i0 = bearing.magnet.bias_current_a;
  const double pass =
      1.0 - std::exp(-2.0 * std::numbers::pi * bearing.amplifier.bandwidth_hz * record.period_s);
  WorkingPoint sum;
  double count = 0.0;
  double coil_a = record.current_a[axis].front();
  for (std::size_t n = 0; n < record.rows(); ++n) {
    if (std::abs(record.speed_rad_per_s[n]) > 1.0) continue;
    coil_a += pass * (record.current_a[axis][n] - coil_a);
    const double i = ki_ratio * coil_a;
    const double towards_m = s0 - record.position_m[axis][n];
    const double away_m = s0 + record.position_m[axis][n];
    sum.ki_n_per_a +=
        2.0 * k * ki_ratio * ((i0 + i) / (towards_m * towards_m) + (i0 - i) / (away_m * away_m));
    sum.ks_n_per_m += 2.0 * k *
                      (std::pow((i0 + i), 2) / std::pow(towards_m, 3) +
                       std::pow((i0 - i), 2) / std::pow(away_m, 3));
    count += 1.0;
  }
  return {sum.ki_n_per_a / count, sum.ks_n_per_m / count};
}

double RigidMass(const plant::PlantModel& model) { return model.rigid().col(0).squaredNorm(); }

ModalTruth Truth(const plant::PlantModel& model, const identification::Record& record) {
  const auto& modes = model.parameters().modes;
  const auto& bearings = model.config().bearings;
  const auto axes = static_cast<Index>(2 * bearings.size());
  const Index bending = modes.frequency_rad_per_s.size() - 2;
  ModalTruth truth{modes.frequency_rad_per_s.tail(bending) / (2.0 * std::numbers::pi),
                   modes.damping_ratio.tail(bending), Eigen::VectorXd(axes), Eigen::VectorXd(axes)};
  for (Index axis = 0; axis < axes; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto& bearing = bearings[a / 2];
    const auto& e = model.effects().bearings[a / 2].axis[a % 2];
    const WorkingPoint at = MeanSlopes(record, a, bearing, e.gain);
    const double gain = model.effects().readings[a].gain;
    truth.ki_product[axis] = at.ki_n_per_a * gain / RigidMass(model);
    truth.ks_product[axis] = (at.ks_n_per_m + e.stiffness_n_per_m) / RigidMass(model);
  }
  return truth;
}

Eigen::VectorXd Relative(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  return (found.array() / truth.array() - 1.0).abs();
}

}  // namespace

ModalTrial MakeModalTrial(const config::RigFile& nominal, const ExcitationPlan& plan) {
  Random random(plan.seed);
  const plant::PlantParameters truth = TrueRig(nominal.plant, Unknown(), {}, random);
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

}  // namespace levitas::trials
