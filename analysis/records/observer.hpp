#pragma once
// One-step-ahead observer: the nonlinear plant, driven by the recorded currents and corrected at
// every sample with a fixed gain.
//
// Model      x[n+1] = f(x[n], ic[n]) + E d[n],  d[n+1] = d[n] + drift,  y[n] = h(x[n]) + noise
//            f, h: plant::Plant, true magnet force included. d [N]: unknown force per axis at its
//            actuator plane, slowly varying, so that gravity or an offset that the rig file does
//            not have right does not bias every sample.
// Gain       stationary Kalman gain of the linear model at one speed and bias, computed once: it
//            does not depend on the parameters of the plant being tried, so the innovations are a
//            smooth function of them. Commands on their way (delay) are known and need no estimate.
// Noise      measurement: the sensor's noise_rms and the converter's step/sqrt(12). Process: white
//            force per axis (unmodelled force; larger = trusts the sensors more) and the drift.
// Innovation measured minus predicted position [m], both in the bearing frame; white and little
//            above the sensor noise when the plant is right.
// Cost       one plant period and one small matrix-vector product per sample. No allocation in
//            Step.
// Thread     one instance per thread; a gain may be shared.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "common/axes.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct ObserverTuning {
  double speed_rad_per_s{};  ///< speed of the linear model
  /// Unknown force per axis and sample, white, rms, as a share of the magnet's ki i0. One percent
  /// is what ki, ks and the unbalance of a rig are known to at best; larger follows the sensors
  /// more closely and hides slow departures.
  double force_noise_share{0.01};
  double force_drift_share{1e-4};  ///< rms step of d per sample, same measure
};

struct ObserverGain {
  Eigen::MatrixXd state;              ///< correction of the plant's state per metre of innovation
  Eigen::MatrixXd force_n_per_m;      ///< correction of d
  Eigen::MatrixXd force_step;         ///< E: change of state in one period per newton
  AxisArray sensor_noise_m{};         ///< [m] rms, noise and quantisation
  AxisArray expected_innovation_m{};  ///< [m] rms when the plant is right
  double settling_s{};                ///< time in which a start error falls to 1 %
};

/// Throws Problem when no stationary gain exists (a sensor without any noise, for instance).
[[nodiscard]] ObserverGain DesignObserver(const plant::PlantConfig& nominal,
                                          const ObserverTuning& tuning);

/// A gain from one sample on, until the next one's.
struct StagedGain {
  std::uint64_t from_sample{};
  ObserverGain gain;
};

/// Gains after the change from the stationary observer of one tuning, with its force held at zero,
/// to that of another: those of the Kalman filter that knows it, held over stages of 16, 32, 64 ...
/// samples; the last is stationary. With the stationary gain alone what the first observer did not
/// know would swing out for as long as the second one needs to settle, beside which a quiet probe
/// shows every force that the model lacks.
[[nodiscard]] std::vector<StagedGain> DesignSettling(const plant::PlantConfig& nominal,
                                                     const ObserverTuning& from,
                                                     const ObserverTuning& to);

/// One recorded sample: what was read and what was commanded from it.
struct RecordedSample {
  AxisArray position_m{};  ///< as read by the sensors
  plant::PlantCommand command;
  double speed_rad_per_s{};  ///< [rad/s] mean speed until the next sample
  double angle_rad{};        ///< [rad] rotor angle at this sample
  /// Of the shaft, as the speeds around say (recorded_rows.hpp): an unbalance that is turned faster
  /// pushes across itself, too.
  double acceleration_rad_per_s2{};
};

/// The plant of an observer: its drive follows the recorded speed, whatever the rig's own could do.
[[nodiscard]] plant::PlantConfig WithSpeedImposed(plant::PlantConfig plant);

class Observer {
 public:
  /// Of any `model` in the bearing frame (std::invalid_argument), not only that of the gain.
  Observer(std::shared_ptr<const plant::PlantModel> model,
           std::shared_ptr<const ObserverGain> gain);
  Observer(const plant::PlantConfig& plant, std::shared_ptr<const ObserverGain> gain);

  /// Starts from rest at the measured place. The unknown force keeps its estimate: a gap in the
  /// record does not change gravity.
  void Restart(const AxisArray& position_m);
  /// Goes on with another gain, of the same sizes.
  void Use(std::shared_ptr<const ObserverGain> gain) noexcept { gain_ = std::move(gain); }
  /// Compares with the sample, corrects, and advances one period. Returns the innovation [m].
  AxisArray Step(const RecordedSample& sample) noexcept { return Step(sample, {}); }
  /// The same for a model whose sensors read `added_m` more than the plant's.
  AxisArray Step(const RecordedSample& sample, const AxisArray& added_m) noexcept;

  [[nodiscard]] const Eigen::VectorXd& unknown_force_n() const noexcept { return force_n_; }
  [[nodiscard]] const plant::Plant& plant() const noexcept { return plant_; }
  [[nodiscard]] const ObserverGain& gain() const noexcept { return *gain_; }
  /// For models that add to what the plant does between two samples.
  [[nodiscard]] plant::Plant& mutable_plant() noexcept { return plant_; }

 private:
  plant::Plant plant_;
  std::shared_ptr<const ObserverGain> gain_;
  Eigen::VectorXd force_n_;
  Eigen::VectorXd innovation_m_;
};

}  // namespace levitas::analysis
