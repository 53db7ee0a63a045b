#include "identification/identified_rotor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/problem.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kSamePlaceM = 1e-9;

/// Measured less file's deflection of a mode, over the shaft.
class Difference {
 public:
  void Add(double z_m, double value) { points_.emplace_back(z_m, value); }
  /// To be called once, after all points.
  void Order() {
    std::ranges::sort(points_);
    std::vector<std::pair<double, double>> distinct;
    for (std::size_t first = 0; first < points_.size();) {
      std::size_t last = first;
      double sum = 0.0;
      while (last < points_.size() && points_[last].first - points_[first].first <= kSamePlaceM) {
        sum += points_[last++].second;
      }
      distinct.emplace_back(points_[first].first, sum / static_cast<double>(last - first));
      first = last;
    }
    points_ = std::move(distinct);
  }
  [[nodiscard]] double At(double z_m) const {
    if (z_m <= points_.front().first) return points_.front().second;
    for (std::size_t right = 1; right < points_.size(); ++right) {
      const auto& [z, value] = points_[right];
      if (z_m > z) continue;
      const auto& [z_before, before] = points_[right - 1];
      return before + (value - before) * (z_m - z_before) / (z - z_before);
    }
    return points_.back().second;
  }

 private:
  std::vector<std::pair<double, double>> points_;
};

Difference DifferenceOf(const plant::PlantModel& model, const ModalResult& found, Index mode) {
  const auto at = static_cast<std::size_t>(mode);
  Difference difference;
  for (std::size_t b = 0; b < model.bearings().size(); ++b) {
    const auto& file = model.bearings()[b];
    const auto& bearing = model.config().bearings[b];
    const auto column = static_cast<Index>(b);
    difference.Add(bearing.actuator_z_m,
                   found.rig.actuator(mode, column) - file.actuator_shape[at]);
    difference.Add(bearing.sensor_z_m, found.rig.sensor(mode, column) - file.sensor_shape[at]);
  }
  difference.Order();
  return difference;
}

/// `mode` counts the rigid ones, of which there are two.
rotor::GivenMode ModeOf(const plant::PlantModel& model, const ModalResult& found, Index mode) {
  const rotor::ModalRotor& file = model.parameters().modes;
  const bool fitted = mode < found.start.frame.layout.modes();
  const auto& from = fitted ? found.rig.frequency_rad_per_s : file.frequency_rad_per_s;
  rotor::GivenMode given{from[mode] / (2.0 * std::numbers::pi),
                         fitted ? found.rig.damping_ratio[mode] : file.damping_ratio[mode],
                         1.0,
                         {}};
  Difference difference;
  if (fitted) difference = DifferenceOf(model, found, mode);
  for (std::size_t node = 0; node < file.node_z_m.size(); ++node) {
    const double z_m = file.node_z_m[node];
    given.shape.push_back(
        {z_m, file.shapes(static_cast<Index>(node), mode) + (fitted ? difference.At(z_m) : 0.0)});
  }
  return given;
}

/// Of tilt and all bending modes of the file, what was found in place of the file's.
Eigen::MatrixXd GyroscopicOf(const plant::PlantModel& model, const ModalResult& found) {
  const rotor::ModalRotor& file = model.parameters().modes;
  const Eigen::VectorXd shift = model.rigid().col(0);
  const Eigen::VectorXd slope = model.rigid().col(1);
  const Eigen::VectorXd tilt = slope - shift.dot(slope) / shift.squaredNorm() * shift;
  const Index bending = file.frequency_rad_per_s.size() - 2;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(bending + 2, bending + 1);
  basis.col(0) = tilt.normalized();
  basis.bottomRightCorner(bending, bending).setIdentity();
  Eigen::MatrixXd gyroscopic = basis.transpose() * file.gyroscopic * basis;
  const Index fitted = std::min(bending, found.start.frame.layout.bending) + 1;
  gyroscopic.topLeftCorner(fitted, fitted) = found.rig.gyroscopic.block(1, 1, fitted, fitted);
  return gyroscopic;
}

}  // namespace

rotor::GivenRotor IdentifiedRotor(const configuration::RigFile& rig, const ModalResult& found) {
  for (const effect::EffectConfig& entry : rig.plant.effects) {
    if (entry.id != effect::Id::kBreathingCrack) continue;
    throw BadInput(
        fmt::format("rig {} has a breathing_crack, which bends the shaft, and a rotor of modes has "
                    "none; keep the shaft (--rotor shaft) or take the entry out",
                    rig.numbers.name));
  }
  const plant::PlantModel model(rig.plant);
  const Physical& p = found.rig;
  const Eigen::MatrixXd gyroscopic = GyroscopicOf(model, found);
  rotor::GivenRotor given{
      p.mass_kg, p.inertia_kg_m2, gyroscopic(0, 0) * p.inertia_kg_m2, p.centre_z_m, {}, {}};
  const Index bending = gyroscopic.rows() - 1;
  for (Index i = 1; i <= bending; ++i) given.modes.push_back(ModeOf(model, found, 1 + i));
  for (Index row = 1; row <= bending; ++row) {
    for (Index column = 0; column <= row; ++column) {
      given.gyroscopic.push_back({static_cast<std::size_t>(row), static_cast<std::size_t>(column),
                                  gyroscopic(row, column)});
    }
  }
  return given;
}

}  // namespace levitas::identification
