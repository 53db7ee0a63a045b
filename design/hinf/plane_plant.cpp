#include "design/hinf/plane_plant.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/problem.hpp"
#include "common/two_pi.hpp"
#include "design/synthesis/discretisation.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::hinf {

void CheckWeights(const HinfWeights& weights) {
  const auto positive = [](double value, const char* name) {
    if (!(value > 0.0) || !std::isfinite(value))
      throw BadInput(fmt::format("the weight {} is {:g}, allowed above 0", name, value));
  };
  positive(weights.disturbance_a, "disturbance_a");
  positive(weights.disturbance_hz, "disturbance_hz");
  positive(weights.disturbance_floor, "disturbance_floor");
  positive(weights.disc_ratio, "disc_ratio");
  positive(weights.disc_hz, "disc_hz");
  positive(weights.noise_m, "noise_m");
  positive(weights.control_a, "control_a");
  positive(weights.control_hz, "control_hz");
  positive(weights.position_rest_m, "position_rest_m");
  positive(weights.position_m, "position_m");
  positive(weights.position_hz, "position_hz");
  positive(weights.mode_hz, "mode_hz");
  positive(weights.model_hz, "model_hz");
  positive(weights.speed_unit, "speed_unit");
  if (weights.speed_ratio < 0.0 || !std::isfinite(weights.speed_ratio))
    throw BadInput(
        fmt::format("the weight speed_ratio is {:g}, allowed from 0", weights.speed_ratio));
  for (const double share : weights.bearing_disturbance) positive(share, "bearing_disturbance");
  for (const double share : weights.bearing_position) positive(share, "bearing_position");
  for (const double share : weights.mode_share) positive(share, "mode_share");
  if (weights.position_rest_m > weights.position_m)
    throw BadInput(
        fmt::format("the weights contradict each other: position_rest_m {:g} is above "
                    "position_m {:g}",
                    weights.position_rest_m, weights.position_m));
  if (weights.disturbance_floor > 1.0)
    throw BadInput(fmt::format("the weight disturbance_floor is {:g}, allowed above 0 to 1",
                               weights.disturbance_floor));
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using synthesis::Append;
using synthesis::Copies;
using synthesis::Gain;
using synthesis::Series;
using synthesis::StateSpace;

constexpr double kMicrometre = 1e-6;

StateSpace Scaled(StateSpace system, double gain) {
  system.C *= gain;
  system.D *= gain;
  return system;
}

/// (high s + low w)/(s + w): gain `low` at rest, `high` above, pole at `pole_hz`.
StateSpace Shelf(double low, double high, double pole_hz) {
  const double pole = kTwoPi * pole_hz;
  StateSpace out = Gain(MatrixXd::Constant(1, 1, high));
  out.A = MatrixXd::Constant(1, 1, -pole);
  out.B = MatrixXd::Constant(1, 1, pole);
  out.C = MatrixXd::Constant(1, 1, low - high);
  return out;
}

/// 1 up to `hz`, then rising in second order to 100 at ten times that.
StateSpace RisingWeight(double hz) {
  constexpr double kRise = 100.0;
  const double w = kTwoPi * hz * std::sqrt(kRise);
  const double z = kTwoPi * hz;
  const double zeta = std::numbers::sqrt2 / 2.0;
  // kRise (s^2 + 2 zeta z s + z^2)/(s^2 + 2 zeta w s + w^2), states scaled by w.
  StateSpace out = Gain(MatrixXd::Constant(1, 1, kRise));
  out.A = Eigen::Matrix2d{{0.0, w}, {-w, -2.0 * zeta * w}};
  out.B = Eigen::Vector2d{0.0, w};
  out.C = Eigen::RowVector2d{kRise * (z * z / (w * w) - 1.0), kRise * 2.0 * zeta * (z / w - 1.0)};
  return out;
}

/// The rig at rest with what acts on it.
struct Parts {
  plant::LinearModel model;
  MatrixXd force;               ///< states x perturbations: acceleration of each
  MatrixXd seen;                ///< perturbations x states
  Eigen::VectorXd disc;         ///< states: a force along both planes alike
  std::vector<Index> part;      ///< of each state; -1: left out
  std::vector<Index> velocity;  ///< of each perturbation: a state of the plane that it acts in
};

/// Unconnected parts of the model's graph, as one number a state.
std::vector<Index> PartsOf(const MatrixXd& a, const std::vector<bool>& kept) {
  const Index n = a.rows();
  std::vector<Index> part(static_cast<std::size_t>(n));
  std::iota(part.begin(), part.end(), 0);
  const double nothing = 1e-12 * a.cwiseAbs().maxCoeff();
  for (bool changed = true; changed;) {
    changed = false;
    for (Index i = 0; i < n; ++i)
      for (Index j = 0; j < n; ++j) {
        auto& one = part[static_cast<std::size_t>(i)];
        auto& other = part[static_cast<std::size_t>(j)];
        if (one == other || std::abs(a(i, j)) <= nothing) continue;
        if (!kept[static_cast<std::size_t>(i)] || !kept[static_cast<std::size_t>(j)]) continue;
        one = other = std::min(one, other);
        changed = true;
      }
  }
  for (std::size_t i = 0; i < part.size(); ++i)
    if (!kept[i]) part[i] = -1;
  return part;
}

/// The places of unbalance that no magnet reaches: beyond its own length from every actuator.
Eigen::VectorXd DiscForce(const plant::PlantModel& model, double top_speed, Index states) {
  constexpr double kReached = 5e-3;
  const auto& config = model.config();
  const auto& at = model.layout();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(states);
  if (!config.shafts.empty()) return out;
  for (const auto& mass : config.unbalance) {
    bool reached = false;
    for (const auto& bearing : config.bearings)
      reached = reached || std::abs(bearing.actuator_z_m - mass.z_m) < kReached;
    if (reached) continue;
    const Eigen::VectorXd shape = model.parameters().modes.ShapeAt(mass.z_m).transpose();
    const double force = mass.moment_kg_m * top_speed * top_speed;
    out.segment(static_cast<Index>(at.v_x), shape.size()) += force * shape;
    out.segment(static_cast<Index>(at.v_y), shape.size()) += force * shape;
  }
  return out;
}

/// What moves a mode by ten micrometres at the sensor that shows it best.
double UnitOf(const plant::PlantModel& model, std::size_t mode) {
  constexpr double kShownUm = 10.0;
  double shown = 1e-9;
  for (const auto& bearing : model.bearings())
    shown = std::max(shown, std::abs(bearing.sensor_shape[mode]));
  return kShownUm * kMicrometre / shown;
}

/// What the moment moves of the kept modes, in their units; those left out leave the column, too.
double UnitOfMoment(const plant::PlantModel& model, const std::vector<bool>& kept, Index first,
                    Eigen::VectorXd& column) {
  constexpr double kRigidHz = 50.0;  // where a levitated body swings, for the scale alone
  double unit = 0.0;
  for (Index i = 0; i < column.size(); ++i) {
    if (!kept[static_cast<std::size_t>(first + i)]) column[i] = 0.0;
    const auto mode = static_cast<std::size_t>(i);
    const double w = std::max(model.frequency()[mode], kTwoPi * kRigidHz);
    unit = std::max(unit, std::abs(column[i]) * w * UnitOf(model, mode));
  }
  return unit;
}

/// One more perturbation, along `column` of the velocities from `first` on.
void AddPerturbation(Index first, const Eigen::VectorXd& column, double gain, double unit,
                     Parts& out) {
  const Index added = out.force.cols();
  out.force.conservativeResize(Eigen::NoChange, added + 1);
  out.seen.conservativeResize(added + 1, Eigen::NoChange);
  out.force.col(added).setZero();
  out.seen.row(added).setZero();
  out.force.col(added).segment(first, column.size()) = column * gain;
  out.seen.row(added).segment(first, column.size()) = column.transpose() / unit;
  out.velocity.push_back(first);
}

/// Perturbations of the gyroscopic moments of both planes, beside those of the modes.
void AddSpeed(const plant::PlantModel& model, const HinfWeights& weights, double top_speed,
              const std::vector<bool>& kept, Parts& out) {
  const auto& at = model.layout();
  const auto& modes = model.parameters().modes;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> moments(modes.gyroscopic);
  const double most = moments.eigenvalues().size() > 0 ? moments.eigenvalues().maxCoeff() : 0.0;
  constexpr double kNothing = 1e-6;
  for (const bool y : {false, true}) {
    for (Index k = 0; k < moments.eigenvalues().size(); ++k) {
      if (moments.eigenvalues()[k] <= kNothing * most) continue;
      Eigen::VectorXd column = std::sqrt(moments.eigenvalues()[k]) * moments.eigenvectors().col(k);
      const auto first = static_cast<Index>(y ? at.v_y : at.v_x);
      double unit = UnitOfMoment(model, kept, first, column);
      if (!(unit > 0.0)) continue;
      unit *= weights.speed_unit;
      AddPerturbation(first, column, weights.speed_ratio * top_speed * unit, unit, out);
    }
  }
}

Parts Prepare(const plant::PlantConfig& rig, const HinfWeights& weights, double top_speed) {
  const plant::PlantModel model(rig);
  const auto& at = model.layout();
  Parts out;
  out.model = plant::Linearise(model, 0.0);
  const Index n = out.model.a.rows();
  out.disc = DiscForce(model, top_speed, n);
  std::vector<bool> kept(static_cast<std::size_t>(n), true);
  std::vector<Index> displacement;
  std::vector<double> gain;
  for (const bool y : {false, true})
    for (std::size_t i = 0, flexible = 0; i < at.modes; ++i) {
      const double w = model.frequency()[i];
      const std::size_t q = (y ? at.q_y : at.q_x) + i;
      const std::size_t v = (y ? at.v_y : at.v_x) + i;
      if (w > kTwoPi * weights.model_hz) kept[q] = kept[v] = false;
      if (!(w > 0.0) || w > kTwoPi * weights.model_hz) continue;
      out.velocity.push_back(static_cast<Index>(v));
      displacement.push_back(static_cast<Index>(q));
      gain.push_back(2.0 * w * kTwoPi * weights.mode_hz * ShareOf(weights.mode_share, flexible++));
    }
  const auto modes = static_cast<Index>(gain.size());
  out.force = MatrixXd::Zero(n, modes);
  out.seen = MatrixXd::Zero(modes, n);
  for (Index i = 0; i < modes; ++i) {
    const auto m = static_cast<std::size_t>(displacement[static_cast<std::size_t>(i)]) %
                   std::max<std::size_t>(at.modes, 1);
    const double unit = UnitOf(model, m);
    out.force(out.velocity[static_cast<std::size_t>(i)], i) =
        gain[static_cast<std::size_t>(i)] * unit;
    out.seen(i, displacement[static_cast<std::size_t>(i)]) = 1.0 / unit;
  }
  if (weights.speed_ratio > 0.0 && rig.shafts.empty())
    AddSpeed(model, weights, top_speed, kept, out);
  out.part = PartsOf(out.model.a, kept);
  return out;
}

std::vector<Index> StatesOf(const Parts& parts, Index part) {
  std::vector<Index> out;
  for (std::size_t i = 0; i < parts.part.size(); ++i)
    if (parts.part[i] == part) out.push_back(static_cast<Index>(i));
  return out;
}

struct Plane {
  StateSpace nominal;  ///< inputs u, modes, disc; outputs y [um], modes
  Index modes{};
  bool disc{};
  std::vector<std::size_t> axes;
};

Plane Cut(const Parts& parts, Index part, const plant::PlantConfig& rig, double delay_samples,
          std::vector<std::size_t> axes) {
  const auto states = StatesOf(parts, part);
  std::vector<Index> channels(axes.begin(), axes.end());
  std::vector<Index> modes;
  for (Index i = 0; i < parts.force.cols(); ++i)
    if (parts.part[static_cast<std::size_t>(parts.velocity[static_cast<std::size_t>(i)])] == part)
      modes.push_back(i);
  const Eigen::VectorXd disc = parts.disc(states);
  Plane out{{}, static_cast<Index>(modes.size()), disc.norm() > 0.0, std::move(axes)};
  const auto n = static_cast<Index>(states.size());
  const auto axes_here = static_cast<Index>(channels.size());
  const Index pushes = out.modes + (out.disc ? 1 : 0);
  MatrixXd push(n, pushes);
  push.leftCols(out.modes) = parts.force(states, modes);
  if (out.disc) push.rightCols(1) = disc;
  MatrixXd seen(axes_here + out.modes, n);
  seen.topRows(axes_here) = parts.model.c(channels, states) / kMicrometre;
  seen.bottomRows(out.modes) = parts.seen(modes, states);
  const MatrixXd a = parts.model.a(states, states);
  const double period_s = static_cast<double>(rig.period_ns) * 1e-9;
  const auto late =
      plant::Discretise({a, parts.model.b(states, channels), seen}, period_s, delay_samples);
  const auto prompt = plant::Discretise({a, push, seen}, period_s, 0.0);
  StateSpace sampled{late.a, MatrixXd::Zero(late.a.rows(), axes_here + pushes), late.c, {}};
  sampled.B.leftCols(axes_here) = late.b;
  sampled.B.topRightCorner(n, pushes) = prompt.b;
  sampled.D = MatrixXd::Zero(sampled.C.rows(), sampled.B.cols());
  out.nominal = synthesis::InverseTustin({sampled, period_s});
  return out;
}

StateSpace Diagonal(const std::vector<StateSpace>& parts) {
  StateSpace out = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) out = Append(out, parts[i]);
  return out;
}

/// Of modes, disc, disturbance, noise and control.
StateSpace InputWeights(const Plane& plane, const HinfWeights& weights) {
  const auto axes = static_cast<Index>(plane.axes.size());
  const StateSpace fall = Shelf(1.0, weights.disturbance_floor, weights.disturbance_hz);
  std::vector<StateSpace> first;
  if (plane.modes > 0) first.push_back(Gain(MatrixXd::Identity(plane.modes, plane.modes)));
  if (plane.disc)
    first.push_back(
        Scaled(Shelf(1.0, weights.disturbance_floor, weights.disc_hz), weights.disc_ratio));
  for (const std::size_t axis : plane.axes)
    first.push_back(
        Scaled(fall, weights.disturbance_a * ShareOf(weights.bearing_disturbance, axis / 2)));
  first.push_back(Gain(MatrixXd::Identity(axes, axes) * (weights.noise_m / kMicrometre)));
  first.push_back(Gain(MatrixXd::Identity(axes, axes)));
  return Diagonal(first);
}

/// Of modes, control and position, and the measurement as it is.
StateSpace OutputWeights(const Plane& plane, const HinfWeights& weights) {
  const auto axes = static_cast<Index>(plane.axes.size());
  std::vector<StateSpace> last;
  if (plane.modes > 0) last.push_back(Gain(MatrixXd::Identity(plane.modes, plane.modes)));
  for (Index i = 0; i < axes; ++i)
    last.push_back(Scaled(RisingWeight(weights.control_hz), 1.0 / weights.control_a));
  for (const std::size_t axis : plane.axes) {
    const double above = weights.position_m * ShareOf(weights.bearing_position, axis / 2);
    last.push_back(Shelf(kMicrometre / weights.position_rest_m, kMicrometre / above,
                         weights.position_hz * weights.position_rest_m / above));
  }
  last.push_back(Gain(MatrixXd::Identity(axes, axes)));
  return Diagonal(last);
}

synthesis::GeneralisedPlant Weighted(const Plane& plane, const HinfWeights& weights) {
  const auto axes = static_cast<Index>(plane.axes.size());
  const Index modes = plane.modes;
  const Index disc = plane.disc ? 1 : 0;
  const MatrixXd one = MatrixXd::Identity(axes, axes);
  // modes, disc, d, n, u -> u; input of the nominal plant (u + d, modes, disc); n.
  MatrixXd in = MatrixXd::Zero(3 * axes + modes + disc, modes + disc + 3 * axes);
  in.block(0, modes + disc + 2 * axes, axes, axes) = one;
  in.block(axes, modes + disc, axes, axes) = one;
  in.block(axes, modes + disc + 2 * axes, axes, axes) = one;
  in.block(2 * axes, 0, modes + disc, modes + disc).setIdentity();
  in.block(2 * axes + modes + disc, modes + disc + axes, axes, axes) = one;
  // u, y, modes, n -> modes; u; y + n; y + n.
  MatrixXd out = MatrixXd::Zero(modes + 3 * axes, 3 * axes + modes);
  out.block(0, 2 * axes, modes, modes).setIdentity();
  out.block(modes, 0, axes, axes) = one;
  for (const Index row : {modes + axes, modes + 2 * axes}) {
    out.block(row, axes, axes, axes) = one;
    out.block(row, 2 * axes + modes, axes, axes) = one;
  }
  const StateSpace middle = Append(Append(Gain(one), plane.nominal), Gain(one));
  synthesis::GeneralisedPlant built;
  built.system =
      Series(Series(Series(Series(InputWeights(plane, weights), Gain(in)), middle), Gain(out)),
             OutputWeights(plane, weights));
  built.controls = axes;
  built.measurements = axes;
  return built;
}

bool Alike(const StateSpace& a, const StateSpace& b) {
  const auto near = [](const MatrixXd& one, const MatrixXd& other) {
    return one.rows() == other.rows() && one.cols() == other.cols() &&
           (one - other).norm() <= 1e-9 * one.norm();
  };
  return near(a.A, b.A) && near(a.B, b.B) && near(a.C, b.C) && near(a.D, b.D);
}

}  // namespace

std::vector<PlanePlant> BuildPlanes(const plant::PlantConfig& rig, const HinfWeights& weights,
                                    double top_speed_rad_per_s) {
  CheckWeights(weights);
  const Parts parts = Prepare(rig, weights, top_speed_rad_per_s);
  const plant::PlantModel model(rig);
  std::vector<std::pair<Index, std::vector<std::size_t>>> found;
  for (std::size_t axis = 0; axis < model.channels(); ++axis) {
    const Index part = parts.part[model.layout().sensor + axis];
    auto at = std::find_if(found.begin(), found.end(),
                           [&](const auto& known) { return known.first == part; });
    if (at == found.end()) at = found.insert(found.end(), {part, {}});
    at->second.push_back(axis);
  }
  std::vector<PlanePlant> out;
  std::vector<StateSpace> nominal;
  for (auto& [part, axes] : found) {
    const Plane plane = Cut(parts, part, rig, model.delay_samples(), axes);
    std::size_t same = 0;
    while (same < nominal.size() && !Alike(nominal[same], plane.nominal)) ++same;
    if (same < nominal.size()) {
      out[same].same_as.insert(out[same].same_as.end(), axes.begin(), axes.end());
      continue;
    }
    nominal.push_back(plane.nominal);
    out.push_back({axes, {}, Weighted(plane, weights)});
  }
  return out;
}

}  // namespace levitas::hinf
