#include "plant_sim/plant/linear_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "numerics/dense/exponential.hpp"
#include "plant_sim/plant/eigen_index.hpp"
#include "plant_sim/plant/find_operating_point.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/train_linear.hpp"

namespace levitas::plant {
namespace {

using Index = Eigen::Index;

struct Discrete {
  Eigen::MatrixXd a;
  Eigen::MatrixXd b;
};

// exp([A B; 0 0] h) = [exp(Ah), integral of exp(At) B; 0, I], (43).
Discrete Hold(const LinearModel& model, double duration_s) {
  const Index n = model.a.rows();
  const Index m = model.b.cols();
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n + m, n + m);
  block.topLeftCorner(n, n) = model.a * duration_s;
  block.topRightCorner(n, m) = model.b * duration_s;
  const Eigen::MatrixXd exponential = block.exp();
  return {exponential.topLeftCorner(n, n), exponential.topRightCorner(n, m)};
}

// Control current at last per control current commanded: of coils on a voltage the mean of both
// coils' slopes about the bias.
double CurrentPerCommand(const PlantModel& model, std::size_t bearing) {
  const BearingModel& at = model.bearings()[bearing];
  if (!at.on_voltage()) return 1.0;
  const double bias_a = model.config().bearings[bearing].magnet.bias_current_a;
  double sum = 0.0;
  for (const amplifier::VoltageCoil& coil : at.coils) {
    sum += coil.steady * amplifier::DrivenSlope(coil, bias_a);
  }
  return 0.5 * sum;
}

}  // namespace

LinearModel LineariseWith(const PlantModel& model, double speed_rad_per_s,
                          const std::vector<Slopes>& slopes) {
  const StateLayout& at = model.layout();
  LinearModel linear;
  linear.a = Eigen::MatrixXd::Zero(At(at.size), At(at.size));
  linear.b = Eigen::MatrixXd::Zero(At(at.size), At(model.axes()));
  linear.c = Eigen::MatrixXd::Zero(At(model.axes()), At(at.size));
  AddRotor(model, speed_rad_per_s, linear.a);
  AddShaftEffects(model, speed_rad_per_s, linear.a);
  AddTrain(model, linear.a);
  for (std::size_t bearing = 0; bearing < model.bearings().size(); ++bearing) {
    AddMagnets(model, bearing, slopes[bearing], linear.a);
    AddSensors(model, bearing, linear.a);
  }
  for (std::size_t axis = 0; axis < model.axes(); ++axis) {
    const Index coil = At(at.coil_current + axis);
    const double amplifier_rate = 2.0 * std::numbers::pi * model.amplifier_bandwidth_hz(axis);
    linear.a(coil, coil) = -amplifier_rate;
    linear.b(coil, At(axis)) = amplifier_rate * CurrentPerCommand(model, axis / 2);
    linear.c(At(axis), At(at.sensor + axis)) = 1.0;
  }
  return linear;
}

LinearModel Linearise(const PlantModel& model, double speed_rad_per_s) {
  std::vector<Slopes> slopes;
  for (std::size_t b = 0; b < model.bearings().size(); ++b) {
    slopes.push_back(SlopesAtCentre(model, b));
  }
  return LineariseWith(model, speed_rad_per_s, slopes);
}

LinearModel Linearise(const PlantModel& model, double speed_rad_per_s,
                      const OperatingPoint& point) {
  if (point.centred()) return Linearise(model, speed_rad_per_s);
  std::vector<Slopes> slopes;
  for (std::size_t b = 0; b < model.bearings().size(); ++b) {
    slopes.push_back(SlopesAt(model, b, point));
  }
  return LineariseWith(model, speed_rad_per_s, slopes);
}

LinearModel Linearise(const PlantConfig& config, double speed_rad_per_s) {
  return Linearise(PlantModel(config), speed_rad_per_s);
}

LinearModel Discretise(const LinearModel& continuous, double period_s, double delay_samples) {
  if (!(period_s > 0.0) || !(delay_samples >= 0.0)) {
    throw std::invalid_argument("Discretise: the period must be > 0, the delay >= 0");
  }
  const double whole = std::floor(delay_samples);
  const double fraction = delay_samples - whole;
  const Discrete early = Hold(continuous, fraction * period_s);
  const Discrete late = Hold(continuous, (1.0 - fraction) * period_s);
  const Index n = continuous.a.rows();
  const Index m = continuous.b.cols();
  // Old commands that still act, the oldest first: u[n-k], ..., u[n-1], (44).
  const Index kept = static_cast<Index>(whole) + (fraction > 0.0 ? 1 : 0);
  LinearModel sampled;
  sampled.a = Eigen::MatrixXd::Zero(n + kept * m, n + kept * m);
  sampled.b = Eigen::MatrixXd::Zero(n + kept * m, m);
  sampled.c = Eigen::MatrixXd::Zero(continuous.c.rows(), n + kept * m);
  sampled.c.leftCols(n) = continuous.c;
  sampled.a.topLeftCorner(n, n) = late.a * early.a;
  const Eigen::MatrixXd early_input = late.a * early.b;
  // Slot s of the line, or beyond its end the new command itself.
  const auto act = [&](Index slot, const Eigen::MatrixXd& input) {
    if (slot < kept) {
      sampled.a.block(0, n + slot * m, n, m) += input;
    } else {
      sampled.b.topRows(n) += input;
    }
  };
  if (fraction > 0.0) act(0, early_input);
  act(fraction > 0.0 ? 1 : 0, late.b);
  for (Index slot = 0; slot + 1 < kept; ++slot) {
    sampled.a.block(n + slot * m, n + (slot + 1) * m, m, m).setIdentity();
  }
  if (kept > 0) sampled.b.bottomRows(m).setIdentity();
  return sampled;
}

}  // namespace levitas::plant
