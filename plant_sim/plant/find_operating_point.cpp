#include "plant_sim/plant/find_operating_point.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "numerics/dense/factorisations.hpp"
#include "plant_sim/plant/applied_effects/effect_forces.hpp"
#include "plant_sim/plant/eigen_index.hpp"

namespace levitas::plant {
namespace {

using Index = Eigen::Index;

constexpr int kMostSteps = 60;
constexpr double kFoundM = 1e-13;
constexpr double kFoundA = 1e-10;
/// Share of the gap that a step of Newton's method may reach: beyond it the force has no meaning.
constexpr double kLargestGapShare = 0.95;
/// Of gap and bias, for central differences: the error of the slope is of its square.
constexpr double kDifferenceShare = 1e-5;

PlaneForce ForceAt(const PlantModel& model, std::size_t bearing, const AxisArray& flux_a,
                   const AxisArray& displacement_m) {
  const std::size_t axis = 2 * bearing;
  Currents currents{};
  currents.bias_a.fill(model.config().bearings[bearing].magnet.bias_current_a);
  currents.control_a = flux_a;
  PlaneForce force =
      MagnetWithEffects(model.bearings()[bearing], model.effects().bearings[bearing], currents,
                        axis, displacement_m[axis], displacement_m[axis + 1]);
  if (model.bearings()[bearing].x_only) force.y_n = 0.0;
  return force;
}

Eigen::Vector2d Slope(const PlantModel& model, std::size_t bearing, const OperatingPoint& about,
                      AxisArray OperatingPoint::*what, std::size_t axis, double step) {
  OperatingPoint point = about;
  const double here = (about.*what)[axis];
  (point.*what)[axis] = here + step;
  const PlaneForce more = ForceAt(model, bearing, point.flux_a, point.displacement_m);
  (point.*what)[axis] = here - step;
  const PlaneForce less = ForceAt(model, bearing, point.flux_a, point.displacement_m);
  return Eigen::Vector2d{more.x_n - less.x_n, more.y_n - less.y_n} / (2.0 * step);
}

/// The equations of rest: those of the plant without its magnets' force, and those of the law.
class Rest {
 public:
  Rest(const PlantModel& model, double speed_rad_per_s, const StaticLaw& law)
      : model_(model),
        speed_rad_per_s_(speed_rad_per_s),
        law_(law),
        free_(LineariseWith(model, speed_rad_per_s, std::vector<Slopes>(model.bearings().size()))),
        states_(free_.a.rows()),
        load_(Eigen::VectorXd::Zero(states_)) {
    const StateLayout& at = model.layout();
    for (std::size_t i = 0; i < at.modes; ++i) {
      load_[At(at.v_x + i)] = model.gravity()[i];
      load_[At(at.v_y + i)] = model.gravity()[at.modes + i];
    }
    Eigen::MatrixXd unused = Eigen::MatrixXd::Zero(states_, states_);
    for (std::size_t axis = 0; axis < model.axes(); ++axis) {
      flux_.push_back(Flux(model, axis, unused));
      seen_.push_back(SeenByMagnet(model, axis / 2, static_cast<int>(axis % 2), states_));
    }
  }

  [[nodiscard]] OperatingPoint PointOf(const Eigen::VectorXd& z) const {
    OperatingPoint point;
    for (std::size_t axis = 0; axis < model_.axes(); ++axis) {
      point.control_a[axis] = z[states_ + At(axis)];
      const auto& magnet = model_.effects().bearings[axis / 2].axis[axis % 2];
      point.flux_a[axis] = flux_[axis] * z.head(states_) + magnet.command_offset_a;
      point.displacement_m[axis] = seen_[axis] * z.head(states_);
    }
    return point;
  }

  /// Zero at rest.
  [[nodiscard]] Eigen::VectorXd Residual(const Eigen::VectorXd& z) const {
    const OperatingPoint point = PointOf(z);
    Eigen::VectorXd residual = Law() * z;
    residual.head(states_) = free_.a * z.head(states_) + free_.b * z.tail(free_.b.cols()) + load_;
    for (std::size_t b = 0; b < model_.bearings().size(); ++b) {
      const PlaneForce force = ForceAt(model_, b, point.flux_a, point.displacement_m);
      residual.head(states_) += force.x_n * Reaction(model_, b, 0, states_);
      residual.head(states_) += force.y_n * Reaction(model_, b, 1, states_);
    }
    for (std::size_t i = 0; i < model_.channels(); ++i) {
      residual[states_ + At(i)] += Offset(i);
    }
    Pin(residual);
    return residual;
  }

  [[nodiscard]] Eigen::MatrixXd Jacobian(const Eigen::VectorXd& z) const {
    const OperatingPoint point = PointOf(z);
    std::vector<Slopes> slopes;
    for (std::size_t b = 0; b < model_.bearings().size(); ++b) {
      slopes.push_back(SlopesAt(model_, b, point));
    }
    Eigen::MatrixXd jacobian = Law();
    jacobian.topLeftCorner(states_, states_) = LineariseWith(model_, speed_rad_per_s_, slopes).a;
    jacobian.topRightCorner(states_, free_.b.cols()) = free_.b;
    for (const Index row : Loose()) jacobian(row, row - At(model_.coordinates())) -= 1.0;
    return jacobian;
  }

  [[nodiscard]] Index size() const { return states_ + free_.b.cols(); }

 private:
  /// Rows of the law: y = -offset, or u + C(1) y = -C(1) offset; axes that no law drives: u = 0.
  [[nodiscard]] Eigen::MatrixXd Law() const {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(size(), size());
    const Index channels = At(model_.channels());
    for (std::size_t i = 0; i < model_.axes(); ++i) {
      const Index row = states_ + At(i);
      const bool driven = i < model_.channels();
      if (driven && law_.integrates[i]) {
        rows.row(row).head(states_) = free_.c.row(At(i));
        continue;
      }
      rows(row, row) = 1.0;
      if (driven) {
        rows.row(row).head(states_) = law_.gain_a_per_m.row(At(i)) * free_.c.topRows(channels);
      }
    }
    return rows;
  }

  [[nodiscard]] double Offset(std::size_t channel) const {
    const auto& readings = model_.effects().readings;
    if (law_.integrates[channel]) return readings[channel].offset_m;
    double sum_a = 0.0;
    for (std::size_t j = 0; j < model_.channels(); ++j) {
      sum_a += law_.gain_a_per_m(At(channel), At(j)) * readings[j].offset_m;
    }
    return sum_a;
  }

  /// Velocities of shafts that turn freely: no force says where they stand.
  [[nodiscard]] std::vector<Index> Loose() const {
    std::vector<Index> rows;
    const StateLayout& at = model_.layout();
    const auto& torsion = model_.parameters().torsion.frequency_rad_per_s;
    for (std::size_t i = 0; i < at.twists; ++i) {
      if (torsion[At(i)] < 1e-3) rows.push_back(At(model_.coordinates() + at.q_t + i));
    }
    return rows;
  }
  void Pin(Eigen::VectorXd& residual) const {
    for (const Index row : Loose()) residual[row] = 0.0;
  }

  const PlantModel& model_;
  double speed_rad_per_s_;
  const StaticLaw& law_;
  LinearModel free_;
  Index states_;
  Eigen::VectorXd load_;
  std::vector<Eigen::RowVectorXd> flux_, seen_;
};

/// Halves a step until no gap closes.
void Shorten(const PlantModel& model, const Rest& rest, const Eigen::VectorXd& z,
             Eigen::VectorXd& step) {
  for (int halvings = 0; halvings < 20; ++halvings) {
    const OperatingPoint there = rest.PointOf(z + step);
    bool inside = true;
    for (std::size_t axis = 0; axis < model.axes(); ++axis) {
      const double gap_m = model.config().bearings[axis / 2].magnet.gap_m;
      inside = inside && std::abs(there.displacement_m[axis]) < kLargestGapShare * gap_m;
    }
    if (inside) return;
    step *= 0.5;
  }
}

bool Small(const OperatingPoint& before, const OperatingPoint& after, std::size_t axes) {
  for (std::size_t axis = 0; axis < axes; ++axis) {
    // Not <=: a step that is no number is not small.
    if (!(std::abs(after.displacement_m[axis] - before.displacement_m[axis]) < kFoundM)) {
      return false;
    }
    if (!(std::abs(after.control_a[axis] - before.control_a[axis]) < kFoundA)) return false;
  }
  return true;
}

/// Why a point that was found is none that the rig can hold; empty: it can.
std::string Objection(const PlantModel& model, const StaticLaw& law, const OperatingPoint& point) {
  for (std::size_t axis = 0; axis < model.channels(); ++axis) {
    const BearingConfig& bearing = model.config().bearings[axis / 2];
    const char plane = axis % 2 == 0 ? 'x' : 'y';
    const double bias_a = bearing.magnet.bias_current_a;
    const double room_a = std::min(bias_a, bearing.magnet.max_coil_current_a - bias_a);
    const double limit_a = law.limit_a > 0.0 ? std::min(law.limit_a, room_a) : room_a;
    if (std::abs(point.control_a[axis]) > limit_a) {
      return fmt::format(
          "the magnets cannot carry the load: {}_{} needs a static current of {:.3g} A, allowed "
          "{:.3g} A",
          bearing.name, plane, point.control_a[axis], limit_a);
    }
    const double clearance_m = bearing.touchdown.clearance_m;
    if (clearance_m > 0.0 && std::abs(point.displacement_m[axis]) > clearance_m) {
      return fmt::format(
          "the law cannot carry the load: without an integrator {}_{} sags by {:.0f} um, its "
          "touchdown bearing is {:.0f} um away",
          bearing.name, plane, 1e6 * std::abs(point.displacement_m[axis]), 1e6 * clearance_m);
    }
  }
  return {};
}

OperatingPoint Failed(std::string why) {
  OperatingPoint centre;
  centre.failure = std::move(why);
  return centre;
}

}  // namespace

Slopes SlopesAt(const PlantModel& model, std::size_t bearing, const OperatingPoint& point) {
  const MagnetConfig& magnet = model.config().bearings[bearing].magnet;
  Slopes slopes;
  for (std::size_t plane = 0; plane < 2; ++plane) {
    const std::size_t axis = 2 * bearing + plane;
    slopes.current.col(At(plane)) = Slope(model, bearing, point, &OperatingPoint::flux_a, axis,
                                          kDifferenceShare * magnet.bias_current_a);
    slopes.displacement.col(At(plane)) =
        Slope(model, bearing, point, &OperatingPoint::displacement_m, axis,
              kDifferenceShare * magnet.gap_m);
  }
  return slopes;
}

OperatingPoint FindOperatingPoint(const PlantModel& model, double speed_rad_per_s,
                                  const StaticLaw& law) {
  for (const BearingModel& bearing : model.bearings()) {
    if (bearing.on_voltage()) return {};
  }
  const Rest rest(model, speed_rad_per_s, law);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(rest.size());
  if (rest.Residual(z).isZero(0.0)) return {};
  for (int taken = 0; taken < kMostSteps; ++taken) {
    Eigen::VectorXd step = -rest.Jacobian(z).partialPivLu().solve(rest.Residual(z));
    if (!step.allFinite()) break;
    Shorten(model, rest, z, step);
    const OperatingPoint before = rest.PointOf(z);
    z += step;
    OperatingPoint point = rest.PointOf(z);
    if (!Small(before, point, model.axes())) continue;
    std::string objection = Objection(model, law, point);
    return objection.empty() ? point : Failed(std::move(objection));
  }
  return Failed("the magnets cannot carry the load: no static equilibrium was found");
}

}  // namespace levitas::plant
