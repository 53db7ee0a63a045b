#include "design/pid/unbalance_response.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "common/ellipse.hpp"
#include "common/two_pi.hpp"
#include "design/uncertainty/uncertain_plant.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::design {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

}  // namespace

UnbalanceResponse::UnbalanceResponse(const configuration::RigFile& rig, double third_n,
                                     Coordinates coordinates)
    : coordinates_(std::move(coordinates)) {
  const double rated = rig.numbers.max_speed_rad_per_s;
  if (!rig.plant.shafts.empty() || rig.numbers.axes() < 2) return;
  if (rig.plant.unbalance.empty() && third_n == 0.0) return;
  const Complex j(0.0, 1.0);
  per_speed_ = third_n > 0.0 ? 2 : 1;
  for (int i = 2; i <= 20; ++i) {
    const double w = rated * i / 20.0;
    const SampledPlant sampled(rig, w);
    const uncertainty::UncertainPlant forced(rig, {}, w);
    const double hz = w / kTwoPi;
    harmonics_.push_back({w, sampled.AtHz(hz), forced.PositionOf(rig.plant.unbalance, w)});
    if (third_n > 0.0)
      harmonics_.push_back(
          {w, sampled.AtHz(3.0 * hz), forced.PositionOf(3.0 * hz, 0.0, third_n, j * third_n)});
  }
}

UnbalanceFigures UnbalanceResponse::Of(const std::vector<law::DiscreteLaw>& laws) const {
  UnbalanceFigures out;
  for (std::size_t i = 0; i < harmonics_.size(); i += per_speed_) {
    const auto axes = harmonics_[i].position_m.size();
    Eigen::VectorXd orbit = Eigen::VectorXd::Zero(axes / 2);
    Eigen::VectorXd current = Eigen::VectorXd::Zero(axes);
    for (std::size_t k = i; k < i + per_speed_; ++k) {
      const Harmonic& h = harmonics_[k];
      const AxisMatrix controller = ControllerAt(laws, std::conj(h.point.z), coordinates_);
      AxisMatrix loop = h.point.plant * controller;
      loop.diagonal().array() += 1.0;
      const Eigen::VectorXcd y = loop.inverse() * h.position_m;
      current += (controller * y).cwiseAbs();
      for (Index b = 0; b < orbit.size(); ++b) orbit(b) += LargestRadius(y(2 * b), y(2 * b + 1));
    }
    const double w = harmonics_[i].speed_rad_per_s;
    if (orbit.maxCoeff() > out.orbit_m) {
      out.orbit_m = orbit.maxCoeff();
      out.orbit_rad_per_s = w;
    }
    if (current.maxCoeff() > out.current_a) {
      out.current_a = current.maxCoeff();
      out.current_rad_per_s = w;
    }
  }
  return out;
}

}  // namespace levitas::design
