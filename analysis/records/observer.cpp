#include "analysis/records/observer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analysis/reading_noise.hpp"
#include "analysis/records/riccati.hpp"
#include "numerics/factors/factors.hpp"
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
  scale
      .segment(static_cast<Eigen::Index>(layout.sensor_rate()),
               static_cast<Eigen::Index>(layout.sensor_rates))
      .setConstant(reading_m * kTypicalRate);
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

/// The linear model in units in which states, forces and readings are of order one.
class ScaledModel {
 public:
  ScaledModel(const plant::PlantConfig& nominal, double speed_rad_per_s);

  /// Makes the noises those of a tuning.
  void Tune(const ObserverTuning& tuning);
  [[nodiscard]] Eigen::MatrixXd Stationary() const { return StationaryCovariance(a_, c_, q_, r_); }
  [[nodiscard]] CovarianceSteps Steps(std::size_t most) const { return {a_, c_, q_, r_, most}; }
  /// A covariance with the unknown forces known to be zero.
  [[nodiscard]] Eigen::MatrixXd WithoutForce(Eigen::MatrixXd p) const;
  /// The gain where the states' errors have covariance p. Without its settling time.
  [[nodiscard]] ObserverGain GainOf(const Eigen::MatrixXd& p) const;
  [[nodiscard]] double SettlingOf(const Eigen::MatrixXd& p) const {
    return SettlingTime(a_ - a_ * ScaledGain(p) * c_, period_s_);
  }

 private:
  [[nodiscard]] Eigen::MatrixXd ScaledGain(const Eigen::MatrixXd& p) const {
    return (c_ * p * c_.transpose() + r_).llt().solve(c_ * p).transpose();
  }

  plant::LinearModel sampled_;
  double period_s_;
  Eigen::VectorXd reading_m_, full_force_n_;  ///< noise; ki i0
  Eigen::VectorXd scale_;
  Eigen::MatrixXd a_, c_, q_, r_;
};

ScaledModel::ScaledModel(const plant::PlantConfig& nominal, double speed_rad_per_s)
    : period_s_(static_cast<double>(nominal.period_ns) * 1e-9) {
  const plant::PlantModel reduced(nominal);
  const auto axes = static_cast<Eigen::Index>(reduced.channels());
  plant::LinearModel continuous = plant::Linearise(reduced, speed_rad_per_s);
  continuous.b = ForceInput(reduced);
  sampled_ = plant::Discretise(continuous, period_s_, 0.0);
  reading_m_.resize(axes);
  full_force_n_.resize(axes);
  for (Eigen::Index axis = 0; axis < axes; ++axis) {
    const auto& bearing = nominal.bearings[static_cast<std::size_t>(axis / 2)];
    reading_m_[axis] = ReadingNoise(bearing.sensor);
    full_force_n_[axis] = ForcePerCurrent(reduced, axis) * bearing.magnet.bias_current_a;
  }
  scale_ = Scales(reduced, reading_m_.maxCoeff());
}

void ScaledModel::Tune(const ObserverTuning& tuning) {
  const Augmented model = Augment(sampled_, sampled_.b, reading_m_, full_force_n_, tuning);
  const Eigen::VectorXd unscale = scale_.cwiseInverse();
  const Eigen::VectorXd unread = reading_m_.cwiseInverse();
  a_ = unscale.asDiagonal() * model.a * scale_.asDiagonal();
  c_ = unread.asDiagonal() * model.c * scale_.asDiagonal();
  q_ = unscale.asDiagonal() * model.q * unscale.asDiagonal();
  r_ = unread.asDiagonal() * model.r * unread.asDiagonal();
}

Eigen::MatrixXd ScaledModel::WithoutForce(Eigen::MatrixXd p) const {
  p.rightCols(reading_m_.size()).setZero();
  p.bottomRows(reading_m_.size()).setZero();
  return p;
}

ObserverGain ScaledModel::GainOf(const Eigen::MatrixXd& p) const {
  const Eigen::Index axes = reading_m_.size();
  const Eigen::MatrixXd unscaled =
      scale_.asDiagonal() * ScaledGain(p) * reading_m_.cwiseInverse().asDiagonal();
  ObserverGain gain;
  gain.force_step = sampled_.b;
  gain.state = unscaled.topRows(unscaled.rows() - axes);
  gain.force_n_per_m = unscaled.bottomRows(axes);
  const Eigen::MatrixXd innovation = c_ * p * c_.transpose() + r_;
  for (Eigen::Index axis = 0; axis < axes; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    gain.sensor_noise_m[i] = reading_m_[axis];
    gain.expected_innovation_m[i] = reading_m_[axis] * std::sqrt(innovation(axis, axis));
  }
  return gain;
}

/// Further away than this from the stationary gain it is not worth a stage of its own.
bool IsNear(const ObserverGain& gain, const ObserverGain& stationary) {
  constexpr double kNear = 0.02;
  const auto near = [](const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
    return (one - other).norm() <= kNear * other.norm();
  };
  return near(gain.state, stationary.state) && near(gain.force_n_per_m, stationary.force_n_per_m);
}

}  // namespace

ObserverGain DesignObserver(const plant::PlantConfig& nominal, const ObserverTuning& tuning) {
  ScaledModel model(nominal, tuning.speed_rad_per_s);
  model.Tune(tuning);
  const Eigen::MatrixXd p = model.Stationary();
  ObserverGain gain = model.GainOf(p);
  gain.settling_s = model.SettlingOf(p);
  return gain;
}

std::vector<StagedGain> DesignSettling(const plant::PlantConfig& nominal,
                                       const ObserverTuning& from, const ObserverTuning& to) {
  constexpr std::size_t kFirst = 4;  // powers of two of samples
  constexpr std::size_t kLast = 13;
  ScaledModel model(nominal, to.speed_rad_per_s);
  model.Tune(from);
  Eigen::MatrixXd p = model.WithoutForce(model.Stationary());
  model.Tune(to);
  const Eigen::MatrixXd stationary = model.Stationary();
  ObserverGain last = model.GainOf(stationary);
  last.settling_s = model.SettlingOf(stationary);
  const CovarianceSteps steps = model.Steps(kLast);
  std::vector<StagedGain> stages;
  std::uint64_t from_sample = 0;
  // Each stage is twice as long as the one before and has the gain of its middle.
  for (std::size_t power = kFirst; power < kLast; ++power) {
    const Eigen::MatrixXd middle = steps.After(p, power - 1);
    ObserverGain gain = model.GainOf(middle);
    if (IsNear(gain, last)) break;
    gain.settling_s = last.settling_s;
    stages.push_back({from_sample, std::move(gain)});
    p = steps.After(middle, power - 1);
    from_sample += std::uint64_t{1} << power;
  }
  stages.push_back({from_sample, std::move(last)});
  return stages;
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
    : Observer(
          std::make_shared<const plant::PlantModel>(plant::InBearingFrame(WithSpeedImposed(plant))),
          std::move(gain)) {}

plant::PlantConfig WithSpeedImposed(plant::PlantConfig plant) {
  plant.drive.max_acceleration_rad_per_s2 = std::numeric_limits<double>::max();
  return plant;
}

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
  // The recorded rotation is imposed sample by sample: a drive that asks for the speed that it has,
  // or is on its way from it.
  plant_.SetSpeed(sample.speed_rad_per_s, sample.angle_rad);
  plant::PlantCommand command = sample.command;
  command.drive_enabled = true;
  constexpr double kAhead = 1.0;  // [s]
  command.speed_set_point_rad_per_s =
      sample.speed_rad_per_s + kAhead * sample.acceleration_rad_per_s2;
  command.acceleration_limit_rad_per_s2 = std::abs(sample.acceleration_rad_per_s2);
  plant_.Advance(command);
  x.noalias() += gain_->force_step * force_n_;
  return innovation_m;
}

}  // namespace levitas::analysis
