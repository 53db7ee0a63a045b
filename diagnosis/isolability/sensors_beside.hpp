#pragma once
// Sensors that the rig does not have, and what they would add to what its records tell apart.
//
// Tried     displacement probes in x and y in the middle between the bearings, as noisy as the
//           rig's own; probes of the control current of every axis, noise kCurrentNoiseA.
// Equation  reading less that of the healthy model, which is driven and corrected as without the
//           sensor. Slopes by a run of the model for each term at a tenth of its scale; the fault's
//           by a run with it. Added to J^T J, J^T s and s^T s over the noise squared.
// Noise     of displacement twice the square of a probe's: what the model makes of the others'
//           readings is about as uncertain.
// Rows      at most kRows spread over the records, every fourth of them, weighed up to all.
// Thread    blocks the caller, every processor inside.

#include <array>
#include <string>
#include <vector>

#include "diagnosis/isolability/healthy_model.hpp"

namespace levitas::diagnosis {

class SensorsBeside {
 public:
  static constexpr double kCurrentNoiseA = 2e-3;
  static constexpr std::size_t kRows = 16'000;

  explicit SensorsBeside(const HealthyModel& model);

  [[nodiscard]] std::size_t size() const noexcept { return sensors_.size(); }
  [[nodiscard]] const std::string& what(std::size_t sensor) const { return sensors_[sensor].what; }
  /// To the signature of the fault.
  void Add(std::size_t sensor, const std::vector<effect::EffectConfig>& fault,
           LinearProblem& signature) const;

 private:
  struct Sensor {
    std::string what;
    double noise{};
    Eigen::MatrixXf slope;  ///< readings by terms, per Term::scale()
    Eigen::VectorXf healthy;
  };
  [[nodiscard]] Eigen::VectorXf Read(std::size_t sensor, const std::vector<Trajectory>& runs) const;

  const HealthyModel& model_;
  std::vector<Record> part_;
  std::vector<float> middle_;  ///< shape of the modes
  double weight_{1.0};
  Search search_;
  Gains gains_;
  std::array<Sensor, 2> sensors_;
};

}  // namespace levitas::diagnosis
