#include "diagnosis/isolability/sensors_beside.hpp"

#include <fmt/core.h>

#include <cmath>

#include "common/each_in_parallel.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kEvery = 4;
constexpr std::size_t kDisplacement = 0;

std::size_t RowsOf(const std::vector<Record>& records) {
  std::size_t rows = 0;
  for (const Record& record : records) rows += record.rows.size();
  return rows;
}

double MiddleOf(const RigView& rig) {
  const auto& bearings = rig.model->config().bearings;
  return 0.5 * (bearings.front().actuator_z_m + bearings.back().actuator_z_m);
}

}  // namespace

SensorsBeside::SensorsBeside(const HealthyModel& model)
    : model_(model),
      part_(Spans(model.records(), kRows, model.rig().period_s)),
      weight_(static_cast<double>(kEvery * RowsOf(model.records())) /
              static_cast<double>(RowsOf(part_))),
      search_(model.rig(), model.terms()),
      gains_(search_.DesignGains(part_, kSlow)) {
  const RigView& rig = model.rig();
  const double z_m = MiddleOf(rig);
  for (const double share : rig.Shape(z_m)) middle_.push_back(static_cast<float>(share));
  sensors_[0].what = fmt::format("displacement probes in x and y at {:.0f} mm", 1e3 * z_m);
  sensors_[0].noise = std::sqrt(2.0) * rig.ReadingNoise(0);
  sensors_[1].what = "probes of the control current of every axis";
  sensors_[1].noise = kCurrentNoiseA;
  const auto healthy = search_.Run(part_, gains_, model.point());
  const auto terms = static_cast<Eigen::Index>(model.own_terms());
  for (std::size_t s = 0; s < size(); ++s) {
    sensors_[s].healthy = Read(s, healthy);
    sensors_[s].slope.setZero(sensors_[s].healthy.size(), terms);
  }
  EachInParallel(model.own_terms(), 0, [&](std::size_t i) {
    constexpr double kShare = 0.1;  // of its scale
    Point point = model.point();
    point.theta[i] += kShare * model.terms()[i].scale();
    const auto runs = search_.RunAlone(part_, gains_, point);
    for (std::size_t s = 0; s < size(); ++s) {
      const Eigen::VectorXf change = Read(s, runs) - sensors_[s].healthy;
      // A model that lost the rotor says nothing.
      if (!change.allFinite()) continue;
      sensors_[s].slope.col(static_cast<Eigen::Index>(i)) = -change / static_cast<float>(kShare);
    }
  });
}

Eigen::VectorXf SensorsBeside::Read(std::size_t sensor, const std::vector<Trajectory>& runs) const {
  const RigView& rig = model_.rig();
  std::vector<float> values;
  for (const Trajectory& run : runs) {
    for (std::size_t n = 0; n < run.moments.size(); n += kEvery) {
      const SamplePoint& m = run.moments[n];
      const float counts = m.counts ? 1.0F : 0.0F;
      if (sensor != kDisplacement) {
        for (std::size_t a = 0; a < rig.axes; ++a) values.push_back(counts * m.coil_mean_a[a]);
        continue;
      }
      for (std::size_t plane = 0; plane < 2; ++plane) {
        float sum = 0.0F;
        for (std::size_t i = 0; i < rig.modes; ++i) {
          sum += middle_[i] * m.q[plane * rig.modes + i];
        }
        values.push_back(counts * sum);
      }
    }
  }
  return Eigen::Map<Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void SensorsBeside::Add(std::size_t sensor, const std::vector<effect::EffectConfig>& fault,
                        LinearProblem& signature) const {
  const Sensor& of = sensors_[sensor];
  const Eigen::VectorXf change = Read(sensor, model_.RunWith(fault, part_, gains_)) - of.healthy;
  if (!change.allFinite()) return;
  const auto own = static_cast<Eigen::Index>(model_.own_terms());
  const double weight = weight_ / (of.noise * of.noise);
  const Eigen::MatrixXd slope = of.slope.cast<double>();
  const Eigen::VectorXd signal = change.cast<double>();
  signature.jtj.topLeftCorner(own, own) += weight * (slope.transpose() * slope);
  signature.jte.head(own) += weight * (slope.transpose() * signal);
  signature.ete += weight * signal.squaredNorm();
}

}  // namespace levitas::diagnosis
