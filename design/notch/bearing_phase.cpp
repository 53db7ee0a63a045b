#include "design/notch/bearing_phase.hpp"

#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "common/problem.hpp"
#include "common/two_pi.hpp"

namespace levitas::design {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;

/// arg h at `rad_per_s`, not wrapped.
double PhaseOf(const plant::BearingConfig& bearing, double delay_s, double rad_per_s) {
  if (bearing.amplifier.voltage) {
    throw BadInput(fmt::format(
        "bearing {}: its coils are on a voltage, so their current answers to the rotor, "
        "too, and T cannot be made without it; leave --without-rotor out",
        bearing.name));
  }
  const double sensor = rad_per_s / (kTwoPi * bearing.sensor.bandwidth_hz);
  const double lag = bearing.sensor.filter == plant::SensorFilter::kButterworth2
                         ? std::atan2(std::numbers::sqrt2 * sensor, 1.0 - sensor * sensor)
                         : std::atan(sensor);
  return -rad_per_s * delay_s - lag -
         std::atan(rad_per_s / (kTwoPi * bearing.amplifier.bandwidth_hz));
}

}  // namespace

MatrixXcd LawAt(const analysis::SampledLoop& loop, std::complex<double> z) {
  if (loop.coupled) return loop.coupled->At(z);
  const auto axes = static_cast<Index>(loop.law.size());
  MatrixXcd law = MatrixXcd::Zero(axes, axes);
  for (Index i = 0; i < axes; ++i) law(i, i) = loop.law[static_cast<std::size_t>(i)].At(z);
  return law;
}

MatrixXcd PhaseAlignedT(const plant::PlantConfig& rig, const analysis::SampledLoop& loop,
                        const synchronous::BlockConfig& block, double speed_rad_per_s) {
  const double rad_per_s = block.order * speed_rad_per_s;
  const MatrixXcd law = LawAt(loop, std::polar(1.0, rad_per_s * loop.period_s));
  // A current is held for a period: half of one more.
  const double delay_s = (rig.delay_samples + 0.5) * loop.period_s;
  const std::complex<double> j(0.0, 1.0);
  const Index axes = law.rows();
  const auto bearings = static_cast<Index>(rig.bearings.size());
  MatrixXcd inverse = MatrixXcd::Zero(axes, axes);
  for (Index i = 0; i < axes; ++i) {
    const auto bearing = static_cast<std::size_t>(i * bearings / axes);
    const std::complex<double> turn =
        std::polar(1.0, PhaseOf(rig.bearings[bearing], delay_s, rad_per_s));
    const double size = law.row(i).norm();
    if (!(size > 0.0)) {
      throw BadInput(fmt::format(
          "the law gives axis {} no current at {:.4g} Hz, so its phase says nothing: leave "
          "--without-rotor out",
          i + 1, rad_per_s / kTwoPi));
    }
    if (block.target == synchronous::Target::kVibration) {
      inverse(i, i) = j * std::conj(turn) * size;
    } else {
      inverse.row(i) = -j * turn * law.row(i) / size;
    }
  }
  return inverse;
}

}  // namespace levitas::design
