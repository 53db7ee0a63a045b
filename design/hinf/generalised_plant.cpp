#include "design/hinf/generalised_plant.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/problem.hpp"
#include "design/synthesis/discretisation.hpp"
#include "design/synthesis/order_reduction.hpp"
#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::hinf {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using synthesis::Append;
using synthesis::Copies;
using synthesis::Gain;
using synthesis::Series;
using synthesis::StateSpace;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kMicrometre = 1e-6;

void RequirePositive(double value, const char* name) {
  if (!(value > 0.0))
    throw Problem(ExitStatus::kBadInput,
                  fmt::format("the weight {} is {:g}, allowed above 0", name, value));
}

void CheckWeights(const HinfWeights& weights) {
  RequirePositive(weights.disturbance_a, "disturbance_a");
  RequirePositive(weights.disturbance_floor_a, "disturbance_floor_a");
  RequirePositive(weights.disturbance_hz, "disturbance_hz");
  RequirePositive(weights.noise_m, "noise_m");
  RequirePositive(weights.control_a, "control_a");
  RequirePositive(weights.control_hz, "control_hz");
  RequirePositive(weights.position_rest_m, "position_rest_m");
  RequirePositive(weights.position_rest_hz, "position_rest_hz");
  RequirePositive(weights.position_m, "position_m");
  RequirePositive(weights.mode_hz, "mode_hz");
  if (weights.position_rest_m > weights.position_m)
    throw Problem(ExitStatus::kBadInput,
                  fmt::format("the weights contradict each other: position_rest_m {:g} is above "
                              "position_m {:g}",
                              weights.position_rest_m, weights.position_m));
}

/// (high s + low w)/(s + w): gain `low` at rest, `high` above, pole at `pole_hz`.
StateSpace Shelf(double low, double high, double pole_hz) {
  const double pole = kTurn * pole_hz;
  StateSpace out = Gain(MatrixXd::Constant(1, 1, high));
  out.A = MatrixXd::Constant(1, 1, -pole);
  out.B = MatrixXd::Constant(1, 1, pole);
  out.C = MatrixXd::Constant(1, 1, low - high);
  return out;
}

StateSpace Through(Index channels) { return Gain(MatrixXd::Identity(channels, channels)); }

/// Where a mode's equation of motion stands in the continuous state.
struct Mode {
  Index displacement{}, velocity{};
};

/// Oscillating modes: the rigid ones stand on the magnets' negative stiffness and do not.
std::vector<Mode> FlexibleModes(const plant::LinearModel& model, const plant::StateLayout& layout) {
  constexpr double kSlowest = kTurn * 20.0;  // below any bending mode of a rotor on magnets
  std::vector<Mode> modes;
  for (const bool y : {false, true})
    for (std::size_t i = 0; i < layout.modes; ++i) {
      const Mode mode{static_cast<Index>((y ? layout.q_y : layout.q_x) + i),
                      static_cast<Index>((y ? layout.v_y : layout.v_x) + i)};
      if (model.a(mode.velocity, mode.displacement) < -kSlowest * kSlowest) modes.push_back(mode);
    }
  return modes;
}

/// Adds an input into each mode's acceleration and an output of its displacement, so that a
/// perturbation of norm one moves its frequency by `mode_hz`: d(w^2) = 2 w dw.
plant::LinearModel WithModes(const plant::LinearModel& model, const std::vector<Mode>& modes,
                             double mode_hz) {
  // Shares the gain between input and output; D-K iteration finds the rest. Tried from 1e3 to 1e6
  // on the flexible rotor: the first synthesis has its smallest gamma near 1e4.
  constexpr double kShare = 1e4;
  const auto count = static_cast<Index>(modes.size());
  const Index inputs = model.b.cols();
  const Index outputs = model.c.rows();
  plant::LinearModel out{model.a, MatrixXd::Zero(model.b.rows(), inputs + count),
                         MatrixXd::Zero(outputs + count, model.c.cols())};
  out.b.leftCols(inputs) = model.b;
  out.c.topRows(outputs) = model.c / kMicrometre;
  for (Index i = 0; i < count; ++i) {
    const Mode& mode = modes[static_cast<std::size_t>(i)];
    const double w = std::sqrt(-model.a(mode.velocity, mode.displacement));
    out.b(mode.velocity, inputs + i) = 2.0 * w * kTurn * mode_hz / kShare;
    out.c(outputs + i, mode.displacement) = kShare;
  }
  return out;
}

/// Inputs u and mode perturbations, outputs y [um] and mode displacements.
StateSpace Nominal(const plant::PlantConfig& rig, double speed_rad_per_s, double mode_hz,
                   Index& axes) {
  constexpr double kUnseen = 1e-2;  // [um/A], and in the modes' units alike
  const plant::PlantModel model(rig);
  plant::LinearModel continuous = plant::Linearise(model, speed_rad_per_s);
  axes = static_cast<Index>(model.channels());
  continuous.b.conservativeResize(Eigen::NoChange, axes);
  continuous.c.conservativeResize(axes, Eigen::NoChange);
  const auto modes = FlexibleModes(continuous, model.layout());
  const double period_s = static_cast<double>(rig.period_ns) * 1e-9;
  const plant::LinearModel sampled =
      plant::Discretise(WithModes(continuous, modes, mode_hz), period_s, model.delay_samples());
  StateSpace matrices{sampled.a, sampled.b, sampled.c,
                      MatrixXd::Zero(sampled.c.rows(), sampled.b.cols())};
  const auto balanced = synthesis::Balance(synthesis::InverseTustin({matrices, period_s}));
  const Index kept = (balanced.hankel_values.array() > kUnseen).count();
  return balanced.Truncated(kept + balanced.fewest());
}

}  // namespace

WeightedPlant BuildPlant(const plant::PlantConfig& rig, const HinfWeights& weights,
                         double speed_rad_per_s) {
  CheckWeights(weights);
  Index axes = 0;
  const StateSpace nominal = Nominal(rig, speed_rad_per_s, weights.mode_hz, axes);
  const Index modes = nominal.inputs() - axes;
  const StateSpace Wd =
      Shelf(weights.disturbance_a, weights.disturbance_floor_a, weights.disturbance_hz);
  const StateSpace Wn = Gain(MatrixXd::Constant(1, 1, weights.noise_m / kMicrometre));
  const StateSpace Wu =
      Shelf(1.0 / weights.control_a, 10.0 / weights.control_a, 10.0 * weights.control_hz);
  const StateSpace Wp = Shelf(kMicrometre / weights.position_rest_m,
                              kMicrometre / weights.position_m, weights.position_rest_hz);
  const MatrixXd one = MatrixXd::Identity(axes, axes);
  // Modes, disturbance, noise, u -> u; input of the nominal plant (u + d, modes); noise.
  MatrixXd in = MatrixXd::Zero(3 * axes + modes, modes + 3 * axes);
  in.block(0, modes + 2 * axes, axes, axes) = one;
  in.block(axes, modes, axes, axes) = one;
  in.block(axes, modes + 2 * axes, axes, axes) = one;
  in.block(2 * axes, 0, modes, modes).setIdentity();
  in.block(2 * axes + modes, modes + axes, axes, axes) = one;
  // u, y, modes, noise -> modes; u; y; y + noise.
  MatrixXd out = MatrixXd::Zero(modes + 3 * axes, 3 * axes + modes);
  out.block(0, 2 * axes, modes, modes).setIdentity();
  out.block(modes, 0, axes, axes) = one;
  out.block(modes + axes, axes, axes, axes) = one;
  out.block(modes + 2 * axes, axes, axes, axes) = one;
  out.block(modes + 2 * axes, 2 * axes + modes, axes, axes) = one;
  const StateSpace first =
      Append(Append(Through(modes), Copies(Wd, axes)), Append(Copies(Wn, axes), Through(axes)));
  const StateSpace middle = Append(Append(Through(axes), nominal), Through(axes));
  const StateSpace last =
      Append(Append(Through(modes), Copies(Wu, axes)), Append(Copies(Wp, axes), Through(axes)));
  WeightedPlant built;
  built.plant.system = Series(Series(Series(Series(first, Gain(in)), middle), Gain(out)), last);
  built.plant.controls = axes;
  built.plant.measurements = axes;
  built.blocks.assign(static_cast<std::size_t>(modes), {});
  built.blocks.push_back({synthesis::BlockKind::kFullComplex, 2 * axes, 2 * axes});
  built.period_s = static_cast<double>(rig.period_ns) * 1e-9;
  return built;
}

}  // namespace levitas::hinf
