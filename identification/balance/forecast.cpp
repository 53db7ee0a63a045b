#include "identification/balance/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "analysis/sampled_loop.hpp"
#include "common/ellipse.hpp"
#include "controller/law/law_schedule.hpp"
#include "identification/balance/predictor.hpp"
#include "numerics/dense/factorisations.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

/// Below it a recorded position says nothing of the law: c = 0.
constexpr double kLeastPositionM = 1e-9;

VectorXcd GainsOf(const analysis::TrackedWindow& window) {
  VectorXcd gains = VectorXcd::Zero(window.position_m.size());
  for (Index axis = 0; axis < gains.size(); ++axis) {
    if (std::abs(window.position_m[axis]) < kLeastPositionM) continue;
    gains[axis] = -window.current_a[axis] / window.position_m[axis];
  }
  return gains;
}

}  // namespace

LawOverSpeed FromController(const law::LawConfig& law, double period_s) {
  return [law, period_s](double speed_rad_per_s) -> MatrixXcd {
    const law::LawConfig at_speed = law::LawAt(law, std::abs(speed_rad_per_s));
    const Complex z = std::polar(1.0, speed_rad_per_s * period_s);
    if (at_speed.state_space) return analysis::ModelOf(*at_speed.state_space, period_s).At(z);
    const auto axes = static_cast<Index>(at_speed.axes.size());
    MatrixXcd made = MatrixXcd::Zero(axes, axes);
    for (Index axis = 0; axis < axes; ++axis) {
      const auto& one = at_speed.axes[static_cast<std::size_t>(axis)];
      made(axis, axis) = analysis::ModelOf(law::DiscreteSections(one, period_s)).At(z);
    }
    return made;
  };
}

LawOverSpeed FromRecord(std::vector<analysis::TrackedWindow> windows) {
  std::ranges::sort(windows, {}, &analysis::TrackedWindow::speed_rad_per_s);
  return [windows = std::move(windows)](double speed_rad_per_s) -> MatrixXcd {
    const auto above = std::ranges::lower_bound(windows, speed_rad_per_s, {},
                                                &analysis::TrackedWindow::speed_rad_per_s);
    if (above == windows.begin()) return GainsOf(windows.front()).asDiagonal();
    if (above == windows.end()) return GainsOf(windows.back()).asDiagonal();
    const auto below = above - 1;
    const double span = above->speed_rad_per_s - below->speed_rad_per_s;
    const double share = span > 0.0 ? (speed_rad_per_s - below->speed_rad_per_s) / span : 0.0;
    return ((1.0 - share) * GainsOf(*below) + share * GainsOf(*above)).asDiagonal();
  };
}

std::vector<SpeedResponse> ResponsesOverSpeed(const BalanceRig& rig, const Eigen::VectorXd& place,
                                              const LawOverSpeed& law,
                                              const std::vector<double>& speeds_rad_per_s) {
  const RigMatrices matrices = rig.At(place);
  std::vector<SpeedResponse> made;
  made.reserve(speeds_rad_per_s.size());
  for (const double w : speeds_rad_per_s) {
    MatrixXcd resolvent = (-matrices.a0 - w * matrices.a1).cast<Complex>();
    resolvent.diagonal().array() += Complex(0.0, w);
    MatrixXcd driven(matrices.a0.rows(), rig.axes() + rig.planes());
    driven.leftCols(rig.axes()) =
        DelayAndHold(w, matrices.delay_s, rig.period_s()) * matrices.b.cast<Complex>();
    driven.rightCols(rig.planes()) = w * w * matrices.unbalance;
    const MatrixXcd read = matrices.c * resolvent.partialPivLu().solve(driven);
    MatrixXcd loop = read.leftCols(rig.axes()) * law(w);
    loop.diagonal().array() += 1.0;
    const Eigen::PartialPivLU<MatrixXcd> closed(loop);
    made.push_back({w,
                    closed.solve(read.rightCols(rig.planes())),
                    closed.solve(MatrixXcd::Identity(rig.axes(), rig.axes())),
                    {}});
  }
  return made;
}

Eigen::VectorXd Radii(const VectorXcd& position) {
  Eigen::VectorXd radii(position.size() / 2);
  for (Index b = 0; b < radii.size(); ++b) {
    radii[b] = LargestRadius(position[2 * b], position[2 * b + 1]);
  }
  return radii;
}

}  // namespace levitas::balancing
