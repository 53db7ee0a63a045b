#include "analysis/sampled_loop.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/problem.hpp"
#include "controller/bias/bias_saving.hpp"
#include "controller/law/law_schedule.hpp"
#include "plant_sim/plant/find_operating_point.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::analysis {
namespace {

void RefuseMismatch(const plant::PlantConfig& plant, const law::LawConfig& law) {
  const std::size_t plant_axes =
      plant.bearings.size() == 1 && plant.bearings.front().x_only ? 1 : 2 * plant.bearings.size();
  if (law.axis_count() == plant_axes) return;
  throw BadInput(fmt::format(
      "the controller has {} axes, the rig has {} (x and y of {} bearings): use a controller file "
      "written for this rig",
      law.axis_count(), plant_axes, plant.bearings.size()));
}

/// States a section needs: a first-order one must not bring a spurious pole at z = 0 along.
Eigen::Index OrderOf(const law::Section& section) {
  if (section.b2 != 0.0 || section.a2 != 0.0) return 2;
  return section.b1 != 0.0 || section.a1 != 0.0 ? 1 : 0;
}

/// Puts `section` behind `model`. Observer form: H = b0 + (n1 z + n2)/(z^2 + a1 z + a2) with
/// n1 = b1 - a1 b0, n2 = b2 - a2 b0.
void Append(const law::Section& section, AxisModel& model) {
  const Eigen::Index old = model.a.rows();
  const Eigen::Index added = OrderOf(section);
  const Eigen::Vector2d poles{section.a1, section.a2};
  const Eigen::Vector2d zeros{section.b1 - section.a1 * section.b0,
                              section.b2 - section.a2 * section.b0};
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(old + added, old + added);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(old + added);
  Eigen::RowVectorXd c = Eigen::RowVectorXd::Zero(old + added);
  a.topLeftCorner(old, old) = model.a;
  b.head(old) = model.b;
  c.head(old) = section.b0 * model.c;
  if (added > 0) {
    a.bottomLeftCorner(added, old) = zeros.head(added) * model.c;
    a.block(old, old, added, 1) = -poles.head(added);
    if (added == 2) a(old, old + 1) = 1.0;
    b.tail(added) = zeros.head(added) * model.d;
    c[old] = 1.0;
  }
  model.a = std::move(a);
  model.b = std::move(b);
  model.c = std::move(c);
  model.d *= section.b0;
}

}  // namespace

std::complex<double> AxisModel::At(std::complex<double> z) const {
  const std::complex<double> q = 1.0 / z;
  std::complex<double> value = 1.0;
  for (const auto& section : sections) {
    value *= (section.b0 + q * (section.b1 + q * section.b2)) /
             (1.0 + q * (section.a1 + q * section.a2));
  }
  return value + beside;
}

AxisModel ModelOf(std::vector<law::Section> sections) {
  AxisModel model;
  for (const auto& section : sections) Append(section, model);
  model.sections = std::move(sections);
  return model;
}

namespace {

/// A gain beyond this at z = 1 is an integrator's: [A/m], laws have 1e3 to 1e6.
constexpr double kIntegrates = 1e9;

plant::StaticLaw StaticLawOf(const SampledLoop& loop, const law::LawConfig& law) {
  const auto axes = static_cast<Eigen::Index>(law.axis_count());
  plant::StaticLaw at_rest{Eigen::MatrixXd::Zero(axes, axes), {}, law.current_limit_a};
  if (loop.coupled) {
    at_rest.gain_a_per_m = loop.coupled->At(1.0).real();
  } else {
    for (Eigen::Index i = 0; i < axes; ++i) {
      at_rest.gain_a_per_m(i, i) = loop.law[static_cast<std::size_t>(i)].At(1.0).real();
    }
  }
  for (Eigen::Index i = 0; i < axes; ++i) {
    // Not >: what is no number comes from a pole at z = 1 as well.
    at_rest.integrates.push_back(
        !(at_rest.gain_a_per_m.row(i).cwiseAbs().maxCoeff() < kIntegrates));
  }
  return at_rest;
}

void TakeLaw(const law::LawConfig& law, SampledLoop& loop) {
  if (law.state_space) {
    loop.coupled = ModelOf(*law.state_space, loop.period_s);
    return;
  }
  for (const auto& axis : law.axes) {
    loop.law.push_back(ModelOf(law::DiscreteSections(axis, loop.period_s)));
  }
}

/// C_b = current C - displacement: x is what the law reads, the error less it.
void PassOn(const bias::Share& share, AxisModel& axis) {
  axis.sections.push_back({.b0 = share.current});
  axis.c *= share.current;
  axis.beside = -share.displacement_a_per_m;
  axis.d = share.current * axis.d + axis.beside;
}

void PassOn(const std::vector<bias::Share>& shares, CoupledModel& law) {
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    law.blocks.output_a_per_v[i] *= shares[i].current;
    law.c.row(row) *= shares[i].current;
    law.d.row(row) *= shares[i].current;
    law.d(row, row) -= shares[i].displacement_a_per_m;
  }
}

/// Empty shares: the law as it is.
SampledLoop Close(const plant::PlantConfig& plant, const law::LawConfig& law,
                  double speed_rad_per_s, const std::vector<bias::Share>& shares) {
  RefuseMismatch(plant, law);
  const law::LawConfig at_speed = law::LawAt(law, speed_rad_per_s);
  const plant::PlantModel model(plant);
  SampledLoop loop;
  loop.period_s = static_cast<double>(plant.period_ns) * 1e-9;
  TakeLaw(at_speed, loop);
  if (loop.coupled) PassOn(shares, *loop.coupled);
  for (std::size_t i = 0; i < loop.law.size() && i < shares.size(); ++i) {
    PassOn(shares[i], loop.law[i]);
  }
  loop.point = plant::FindOperatingPoint(model, speed_rad_per_s, StaticLawOf(loop, at_speed));
  plant::LinearModel continuous = plant::Linearise(model, speed_rad_per_s, loop.point);
  const auto channels = static_cast<Eigen::Index>(model.channels());
  continuous.b.conservativeResize(Eigen::NoChange, channels);
  continuous.c.conservativeResize(channels, Eigen::NoChange);
  loop.plant = plant::Discretise(continuous, loop.period_s, model.delay_samples());
  loop.modes = static_cast<Eigen::Index>(model.layout().modes);
  return loop;
}

}  // namespace

SampledLoop CloseLoop(const plant::PlantConfig& plant, const law::LawConfig& law,
                      double speed_rad_per_s) {
  return Close(plant, law, speed_rad_per_s, {});
}

SampledLoop CloseLoopAtBias(const plant::PlantConfig& plant, const law::LawConfig& law,
                            double speed_rad_per_s, double bias_a) {
  plant::PlantConfig lower = plant;
  law::LawConfig limited = law;
  std::vector<bias::Share> shares;
  for (plant::BearingConfig& bearing : lower.bearings) {
    plant::MagnetConfig& magnet = bearing.magnet;
    if (magnet.exponential) {
      throw std::invalid_argument("bias: the magnet of " + bearing.name +
                                  " has no gap s0 of the law F = k (i/s)^2");
    }
    const bias::Share share = bias::ShareAt(magnet.bias_current_a, bias_a, magnet.gap_m);
    shares.insert(shares.end(), bearing.x_only ? 1 : 2, share);
    magnet.bias_current_a = bias_a;
    const double room_a = std::min(bias_a, magnet.max_coil_current_a - bias_a);
    limited.current_limit_a = std::min(limited.current_limit_a, room_a);
  }
  return Close(lower, limited, speed_rad_per_s, shares);
}

namespace {

Eigen::MatrixXd CloseCoupled(const plant::LinearModel& plant, const CoupledModel& law) {
  const Eigen::Index states = plant.a.rows();
  const Eigen::Index order = law.a.rows();
  Eigen::MatrixXd closed = Eigen::MatrixXd::Zero(states + order, states + order);
  closed.topLeftCorner(states, states) = plant.a - plant.b * law.d * plant.c;
  closed.topRightCorner(states, order) = -plant.b * law.c;
  closed.bottomLeftCorner(order, states) = law.b * plant.c;
  closed.bottomRightCorner(order, order) = law.a;
  return closed;
}

}  // namespace

Eigen::MatrixXd ClosedLoopMatrix(const SampledLoop& loop) {
  if (loop.coupled) return CloseCoupled(loop.plant, *loop.coupled);
  const auto& [a, b, c] = loop.plant;
  const Eigen::Index plant_states = a.rows();
  Eigen::Index states = plant_states;
  for (const auto& axis : loop.law) states += axis.a.rows();
  Eigen::MatrixXd closed = Eigen::MatrixXd::Zero(states, states);
  closed.topLeftCorner(plant_states, plant_states) = a;
  Eigen::Index at = plant_states;
  for (std::size_t i = 0; i < loop.law.size(); ++i) {
    const AxisModel& axis = loop.law[i];
    const auto channel = static_cast<Eigen::Index>(i);
    const Eigen::Index order = axis.a.rows();
    closed.topLeftCorner(plant_states, plant_states) -= b.col(channel) * axis.d * c.row(channel);
    closed.block(0, at, plant_states, order) = -b.col(channel) * axis.c;
    closed.block(at, 0, order, plant_states) = axis.b * c.row(channel);
    closed.block(at, at, order, order) = axis.a;
    at += order;
  }
  return closed;
}

}  // namespace levitas::analysis
