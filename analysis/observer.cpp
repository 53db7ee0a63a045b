#include "analysis/observer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/riccati.hpp"
#include "numerics/dense/factorisations.hpp"
#include "plant_sim/magnet/magnet.hpp"
#include "plant_sim/plant/bearing_frame.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::analysis {
namespace {

double ForcePerCurrent(const plant::PlantModel& model, Eigen::Index axis) {
  const auto bearing = static_cast<std::size_t>(axis / 2);
  return magnet::ForcePerCurrent(model.bearings()[bearing].magnet,
                                 model.config().bearings[bearing].magnet.bias_current_a);
}

/// How one newton at each actuator plane enters the state. Not by way of the coil's current: behind
/// eddy currents that is the small part of it which is immediate.
Eigen::MatrixXd ForceInput(const plant::PlantModel& model) {
  const plant::StateLayout& layout = model.layout();
  const auto axes = static_cast<Eigen::Index>(model.channels());
  Eigen::MatrixXd input = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(layout.size), axes);
  for (Eigen::Index axis = 0; axis < axes; ++axis) {
    const auto& shape = model.bearings()[static_cast<std::size_t>(axis / 2)].actuator_shape;
    const auto first = static_cast<Eigen::Index>(axis % 2 == 0 ? layout.v_x : layout.v_y);
    input.col(axis).segment(first, static_cast<Eigen::Index>(shape.size())) =
        Eigen::Map<const Eigen::VectorXd>(shape.data(), static_cast<Eigen::Index>(shape.size()));
  }
  return input;
}

/// Sizes of the states' errors, so that the Riccati equation works on numbers of order one.
Eigen::VectorXd Scales(const plant::PlantModel& model, double reading_m) {
  constexpr double kTypicalRate = 500.0;    // [1/s] levitated rotor and its first modes
  constexpr double kTypicalCurrentA = 0.1;  // [A]
  constexpr double kTypicalForceN = 1.0;    // [N]
  const plant::StateLayout& layout = model.layout();
  const auto axes = static_cast<Eigen::Index>(model.axes());
  const auto channels = static_cast<Eigen::Index>(model.channels());
  const auto modes = static_cast<Eigen::Index>(layout.modes);
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(layout.size) + channels);
  scale.segment(static_cast<Eigen::Index>(layout.q_x), modes).setConstant(reading_m);
  scale.segment(static_cast<Eigen::Index>(layout.q_y), modes).setConstant(reading_m);
  scale.segment(static_cast<Eigen::Index>(layout.v_x), modes).setConstant(reading_m * kTypicalRate);
  scale.segment(static_cast<Eigen::Index>(layout.v_y), modes).setConstant(reading_m * kTypicalRate);
  scale.segment(static_cast<Eigen::Index>(layout.coil_current), axes).setConstant(kTypicalCurrentA);
  scale.segment(static_cast<Eigen::Index>(layout.sensor), axes).setConstant(reading_m);
  scale.tail(channels).setConstant(kTypicalForceN);
  return scale;
}

/// Time after which the powers of the error's transition matrix stay below 1 %: bracketed by
/// repeated squaring, then bisected with the squares at hand. Needs no eigenvalues.
double SettlingTime(const Eigen::MatrixXd& transition, double period_s) {
  constexpr double kSettled = 0.01;
  constexpr std::size_t kMostSquarings = 30;
  std::vector<Eigen::MatrixXd> squares{transition};
  while (squares.back().norm() > kSettled && squares.size() < kMostSquarings) {
    squares.push_back(squares.back() * squares.back());
  }
  Eigen::MatrixXd power = Eigen::MatrixXd::Identity(transition.rows(), transition.cols());
  double samples = 0.0;
  for (std::size_t k = squares.size(); k-- > 0;) {
    const Eigen::MatrixXd further = power * squares[k];
    if (further.norm() <= kSettled) continue;
    power = further;
    samples += std::ldexp(1.0, static_cast<int>(k));
  }
  return (samples + 1.0) * period_s;
}

/// The linear model with the unknown forces as extra states, and its noises.
struct Augmented {
  Eigen::MatrixXd a, c, q, r;
};

Augmented Augment(const plant::LinearModel& model, const Eigen::MatrixXd& force_step,
                  const Eigen::VectorXd& reading_m, const Eigen::VectorXd& full_force_n,
                  const ObserverTuning& tuning) {
  const Eigen::Index states = model.a.rows();
  const Eigen::Index axes = force_step.cols();
  Augmented out;
  out.a = Eigen::MatrixXd::Identity(states + axes, states + axes);
  out.a.topLeftCorner(states, states) = model.a;
  out.a.topRightCorner(states, axes) = force_step;
  out.c = Eigen::MatrixXd::Zero(axes, states + axes);
  out.c.leftCols(states) = model.c.topRows(axes);  // a guided rotor is read in x alone
  out.q = Eigen::MatrixXd::Zero(states + axes, states + axes);
  const Eigen::MatrixXd noise = force_step * (tuning.force_noise_share * full_force_n).asDiagonal();
  out.q.topLeftCorner(states, states) = noise * noise.transpose();
  out.q.diagonal().tail(axes) = (tuning.force_drift_share * full_force_n).cwiseAbs2();
  out.r = reading_m.cwiseAbs2().asDiagonal();
  return out;
}

}  // namespace

double ReadingNoise(const plant::SensorConfig& sensor) {
  const double step_m =
      sensor.adc_bits > 0 ? 2.0 * sensor.range_m / std::ldexp(1.0, sensor.adc_bits) : 0.0;
  return std::sqrt(sensor.noise_rms_m * sensor.noise_rms_m + step_m * step_m / 12.0);
}

ObserverGain DesignObserver(const plant::PlantConfig& nominal, const ObserverTuning& tuning) {
  const plant::PlantModel reduced(nominal);
  const double period_s = static_cast<double>(nominal.period_ns) * 1e-9;
  const auto axes = static_cast<Eigen::Index>(reduced.channels());
  plant::LinearModel continuous = plant::Linearise(reduced, tuning.speed_rad_per_s);
  continuous.b = ForceInput(reduced);
  const plant::LinearModel sampled = plant::Discretise(continuous, period_s, 0.0);

  ObserverGain gain;
  gain.force_step = sampled.b;
  Eigen::VectorXd reading_m(axes);
  Eigen::VectorXd full_force_n(axes);  // ki i0
  for (Eigen::Index axis = 0; axis < axes; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    reading_m[axis] = gain.sensor_noise_m[i] = ReadingNoise(nominal.bearings[i / 2].sensor);
    full_force_n[axis] =
        ForcePerCurrent(reduced, axis) * nominal.bearings[i / 2].magnet.bias_current_a;
  }
  const Augmented model = Augment(sampled, gain.force_step, reading_m, full_force_n, tuning);
  const Eigen::VectorXd scale = Scales(reduced, reading_m.maxCoeff());
  const Eigen::VectorXd unscale = scale.cwiseInverse();
  const Eigen::VectorXd unread = reading_m.cwiseInverse();
  const Eigen::MatrixXd a = unscale.asDiagonal() * model.a * scale.asDiagonal();
  const Eigen::MatrixXd c = unread.asDiagonal() * model.c * scale.asDiagonal();
  const Eigen::MatrixXd q = unscale.asDiagonal() * model.q * unscale.asDiagonal();
  const Eigen::MatrixXd r = unread.asDiagonal() * model.r * unread.asDiagonal();
  const Eigen::MatrixXd p = StationaryCovariance(a, c, q, r);

  const Eigen::MatrixXd innovation = c * p * c.transpose() + r;
  const Eigen::MatrixXd k = innovation.llt().solve(c * p).transpose();
  gain.settling_s = SettlingTime(a - a * k * c, period_s);
  const Eigen::MatrixXd unscaled = scale.asDiagonal() * k * unread.asDiagonal();
  gain.state = unscaled.topRows(unscaled.rows() - axes);
  gain.force_n_per_m = unscaled.bottomRows(axes);
  for (Eigen::Index axis = 0; axis < axes; ++axis) {
    gain.expected_innovation_m[static_cast<std::size_t>(axis)] =
        reading_m[axis] * std::sqrt(innovation(axis, axis));
  }
  return gain;
}

Observer::Observer(std::shared_ptr<const plant::PlantModel> model,
                   std::shared_ptr<const ObserverGain> gain)
    : plant_(std::move(model), 0),
      gain_(std::move(gain)),
      force_n_(Eigen::VectorXd::Zero(gain_->force_n_per_m.rows())),
      innovation_m_(force_n_) {
  if (!plant::IsInBearingFrame(plant_.model().config())) {
    throw std::invalid_argument("an observer's model has probes and coils wired straight");
  }
}

Observer::Observer(const plant::PlantConfig& plant, std::shared_ptr<const ObserverGain> gain)
    : Observer(std::make_shared<const plant::PlantModel>(plant::InBearingFrame(plant)),
               std::move(gain)) {}

void Observer::Restart(const AxisArray& position_m) {
  AxisArray place_m = position_m;
  const plant::PlantConfig& config = plant_.model().config();
  const auto& bearings = config.bearings;
  if (bearings.size() == 2 && config.shafts.empty()) {
    // A rigid rotor through both sensor planes, read off at the actuator planes.
    const double first_z_m = bearings[0].sensor_z_m;
    const double span_m = bearings[1].sensor_z_m - first_z_m;
    for (std::size_t axis = 0; axis < 2 * bearings.size(); ++axis) {
      const double share = (bearings[axis / 2].actuator_z_m - first_z_m) / span_m;
      const std::size_t plane = axis % 2;
      place_m[axis] = position_m[plane] + share * (position_m[plane + 2] - position_m[plane]);
    }
  }
  plant_.PlaceAtRest(place_m);
}

AxisArray Observer::Step(const RecordedSample& sample, const AxisArray& added_m) noexcept {
  const AxisArray predicted_m = plant_.SensorOutput();
  AxisArray innovation_m{};
  for (Eigen::Index axis = 0; axis < innovation_m_.size(); ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    innovation_m[i] = sample.position_m[i] - (predicted_m[i] + added_m[i]);
    innovation_m_[axis] = innovation_m[i];
  }
  const std::span<double> state = plant_.mutable_state();
  Eigen::Map<Eigen::VectorXd> x(state.data(), gain_->state.rows());
  x.noalias() += gain_->state * innovation_m_;
  force_n_.noalias() += gain_->force_n_per_m * innovation_m_;
  // The recorded rotation is imposed sample by sample: a drive that asks for the speed it has.
  plant_.SetSpeed(sample.speed_rad_per_s, sample.angle_rad);
  plant::PlantCommand command = sample.command;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = sample.speed_rad_per_s;
  plant_.Advance(command);
  x.noalias() += gain_->force_step * force_n_;
  return innovation_m;
}

}  // namespace levitas::analysis
