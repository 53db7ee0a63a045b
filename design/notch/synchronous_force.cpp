#include "design/notch/synchronous_force.hpp"

#include <algorithm>
#include <cmath>

#include "common/two_pi.hpp"
#include "design/uncertainty/uncertain_plant.hpp"

namespace levitas::design {

Eigen::VectorXcd UnbalanceAtSensors(const config::RigFile& rig, double speed_rad_per_s) {
  if (!rig.plant.shafts.empty() || rig.numbers.axes() < 2 || rig.plant.unbalance.empty()) return {};
  const uncertainty::UncertainPlant forced(rig, {}, speed_rad_per_s);
  const std::complex<double> j(0.0, 1.0);
  Eigen::VectorXcd position_m =
      Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(rig.numbers.axes()));
  for (const auto& mass : rig.plant.unbalance) {
    const std::complex<double> force_n =
        mass.moment_kg_m * speed_rad_per_s * speed_rad_per_s * std::polar(1.0, mass.phase_rad);
    position_m += forced.PositionOf(speed_rad_per_s / kTwoPi, mass.z_m, force_n, -j * force_n);
  }
  return position_m;
}

double LargestRadius(const Eigen::VectorXcd& position_m) {
  const std::complex<double> j(0.0, 1.0);
  double largest_m = 0.0;
  for (Eigen::Index x = 0; x + 1 < position_m.size(); x += 2) {
    const auto forward = std::abs(position_m[x] + j * position_m[x + 1]);
    const auto backward = std::abs(position_m[x] - j * position_m[x + 1]);
    largest_m = std::max(largest_m, 0.5 * (forward + backward));
  }
  return largest_m;
}

}  // namespace levitas::design
