#include "design/uncertainty/uncertain_plant.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <stdexcept>

#include "common/two_pi.hpp"
#include "numerics/dense/eigenvalues.hpp"
#include "numerics/dense/factorisations.hpp"
#include "numerics/dense/spectrum.hpp"
#include "plant_sim/plant/linear_parts.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::uncertainty {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Complex = std::complex<double>;

/// Rotor's own index of the i-th flexible mode.
std::size_t FlexibleMode(const plant::PlantModel& model, std::size_t wanted) {
  for (std::size_t i = 0; i < model.frequency().size(); ++i)
    if (model.frequency()[i] > 0.0 && wanted-- == 0) return i;
  throw std::out_of_range("the rig has fewer flexible modes than its uncertainty names");
}

struct Channels {
  MatrixXd push, seen;
};

/// One or two perturbations for each parameter: a mode's in the x and in the y plane.
Channels ChannelsOf(const plant::PlantModel& model, const std::vector<Parameter>& parameters,
                    Index states) {
  const auto& at = model.layout();
  std::vector<std::pair<Eigen::VectorXd, Eigen::RowVectorXd>> found;
  for (const Parameter& p : parameters) {
    if (p.kind == Kind::kModeFrequency || p.kind == Kind::kModeDamping) {
      const std::size_t i = FlexibleMode(model, p.index);
      const double w = model.frequency()[i];
      for (const bool y : {false, true}) {
        Eigen::VectorXd push = Eigen::VectorXd::Zero(states);
        Eigen::RowVectorXd seen = Eigen::RowVectorXd::Zero(states);
        const std::size_t q = (y ? at.q_y : at.q_x) + i;
        const std::size_t v = (y ? at.v_y : at.v_x) + i;
        const bool frequency = p.kind == Kind::kModeFrequency;
        push[static_cast<Index>(v)] = frequency ? 2.0 * w * kTwoPi * p.size() : 2.0 * w * p.size();
        seen[static_cast<Index>(frequency ? q : v)] = 1.0;
        found.emplace_back(push, seen);
      }
      continue;
    }
    const std::size_t bearing = p.index / 2;
    const int plane = static_cast<int>(p.index % 2);
    const auto slopes = plant::SlopesAtCentre(model, bearing);
    const bool current = p.kind == Kind::kCurrentGain;
    const double slope = current ? slopes.current(plane, plane) : slopes.displacement(plane, plane);
    Eigen::RowVectorXd seen = plant::SeenByMagnet(model, bearing, plane, states);
    if (current) {
      seen.setZero();
      seen[static_cast<Index>(at.coil_current + p.index)] = 1.0;
    }
    found.emplace_back(p.size() * slope * plant::Reaction(model, bearing, plane, states), seen);
  }
  const auto count = static_cast<Index>(found.size());
  Channels out{MatrixXd(states, count), MatrixXd(count, states)};
  for (Index i = 0; i < count; ++i) {
    out.push.col(i) = found[static_cast<std::size_t>(i)].first;
    out.seen.row(i) = found[static_cast<std::size_t>(i)].second;
  }
  return out;
}

}  // namespace

UncertainPlant::UncertainPlant(const configuration::RigFile& rig,
                               const std::vector<Parameter>& parameters, double speed_rad_per_s) {
  const plant::PlantModel model(rig.plant);
  const plant::LinearModel linear = plant::Linearise(model, speed_rad_per_s);
  const auto channels = static_cast<Index>(model.channels());
  states_ = linear.a.rows();
  v_x_ = static_cast<Index>(model.layout().v_x);
  v_y_ = static_cast<Index>(model.layout().v_y);
  const Channels of = ChannelsOf(model, parameters, states_);
  const numerics::Spectrum spectrum = numerics::SpectrumOf(linear.a);
  const Eigen::MatrixXcd& vectors = spectrum.vectors;
  poles_ = spectrum.values;
  inverse_ = vectors.inverse();
  push_ = inverse_ * of.push;
  drive_ = inverse_ * linear.b.leftCols(channels);
  seen_ = of.seen * vectors;
  read_ = linear.c.topRows(channels) * vectors;
  period_s_ = static_cast<double>(rig.plant.period_ns) * 1e-9;
  delay_s_ = (model.delay_samples() + 0.5) * period_s_;
  const auto& modes = model.parameters().modes;
  for (std::size_t node = 0; node < modes.node_z_m.size(); ++node)
    shapes_.emplace_back(modes.node_z_m[node], modes.shapes.row(static_cast<Index>(node)));
}

PlantPoint UncertainPlant::At(double hz) const {
  const double w = kTwoPi * hz;
  const Eigen::VectorXcd gain = (Complex(0.0, w) - poles_.array()).inverse();
  const double half = 0.5 * w * period_s_;
  const Complex late = (half > 0.0 ? std::sin(half) / half : 1.0) * std::polar(1.0, -w * delay_s_);
  const Eigen::MatrixXcd seen = seen_ * gain.asDiagonal();
  const Eigen::MatrixXcd read = read_ * gain.asDiagonal();
  return {hz, seen * push_, late * (seen * drive_), read * push_, late * (read * drive_)};
}

Eigen::VectorXcd UncertainPlant::PositionOf(double hz, double z_m, Complex force_x,
                                            Complex force_y) const {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < shapes_.size(); ++i)
    if (std::abs(shapes_[i].first - z_m) < std::abs(shapes_[nearest].first - z_m)) nearest = i;
  const Eigen::VectorXd& shape = shapes_.at(nearest).second;
  Eigen::VectorXcd force = Eigen::VectorXcd::Zero(states_);
  force.segment(v_x_, shape.size()) = force_x * shape;
  force.segment(v_y_, shape.size()) = force_y * shape;
  const Eigen::VectorXcd gain = (Complex(0.0, kTwoPi * hz) - poles_.array()).inverse();
  return read_ * gain.cwiseProduct(inverse_ * force);
}

Eigen::VectorXcd UncertainPlant::PositionOf(const std::vector<plant::UnbalanceMass>& unbalance,
                                            double speed_rad_per_s) const {
  const Complex j(0.0, 1.0);
  const double w = speed_rad_per_s;
  Eigen::VectorXcd position_m = Eigen::VectorXcd::Zero(axes());
  for (const plant::UnbalanceMass& mass : unbalance) {
    const Complex force = mass.moment_kg_m * w * w * std::polar(1.0, mass.phase_rad);
    position_m += PositionOf(w / kTwoPi, mass.z_m, force, -j * force);
  }
  return position_m;
}

std::vector<double> UncertainPlant::ModesHz() const {
  std::vector<double> out;
  for (const Complex& pole : poles_)
    if (pole.imag() > 0.0 && std::abs(pole.real()) < 0.1 * std::abs(pole))
      out.push_back(pole.imag() / kTwoPi);
  return out;
}

}  // namespace levitas::uncertainty
