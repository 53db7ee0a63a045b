#include "diagnosis/model/magnet_means.hpp"

#include <cmath>

#include "plant_sim/amplifier/amplifier.hpp"
#include "plant_sim/magnet/magnet.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kStepA = 1e-4;
constexpr double kStepM = 1e-8;

double Displacement(const RigView& rig, std::size_t axis, const SamplePoint& m) {
  const auto& shape = rig.magnet(axis).actuator_shape;
  const float* q = m.q.data() + (axis % 2) * rig.modes;
  double sum = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) sum += shape[i] * static_cast<double>(q[i]);
  return sum;
}

}  // namespace

MagnetMeans::MagnetMeans(const RigView& rig) : rig_(rig) {
  for (std::size_t a = 0; a < rig.axes; ++a) {
    const auto step = amplifier::MakeStep(rig.bearing(a).amplifier.bandwidth_hz, 0.0, rig.period_s);
    relaxing_[a] = (1.0 - step.decay) * step.tau_s / step.duration_s;
  }
}

void MagnetMeans::Fill(double bias_a, const Contribution& add, SamplePoint& m) {
  for (std::size_t a = 0; a < rig_.axes; ++a) {
    const double away_a = static_cast<double>(m.coil_start_a[a] - m.command_now_a[a]);
    const double own_a = static_cast<double>(m.command_now_a[a]) + away_a * relaxing_[a];
    const magnet::Magnet& magnet = rig_.magnet(a).magnet;
    const double x_m = Displacement(rig_, a, m);
    const auto mean_n = [&](double coil_a, double by_m) {
      // Of a straight way from start to end.
      const double deviation_a =
          static_cast<double>(m.coil_end_a[a] - m.coil_start_a[a]) / std::sqrt(12.0);
      return 0.5 * (magnet::Force(magnet, bias_a, coil_a - deviation_a, x_m + by_m) +
                    magnet::Force(magnet, bias_a, coil_a + deviation_a, x_m + by_m));
    };
    const bool moved = add.coil_mean_a[a] != 0.0;
    const double own_n = moved ? mean_n(own_a, 0.0) : 0.0;
    m.coil_end_a[a] += static_cast<float>(add.coil_end_a[a]);
    const double coil_a = own_a + add.coil_mean_a[a];
    const double here_n = mean_n(coil_a, 0.0);
    m.actuator_m[a] = static_cast<float>(x_m);
    m.coil_mean_a[a] = static_cast<float>(coil_a);
    m.force_n[a] = static_cast<float>(here_n);
    m.force_per_a[a] = static_cast<float>((mean_n(coil_a + kStepA, 0.0) - here_n) / kStepA);
    m.force_per_m[a] = static_cast<float>((mean_n(coil_a, kStepM) - here_n) / kStepM);
    added_n_[a] = moved ? here_n - own_n : 0.0;
  }
}

}  // namespace levitas::diagnosis
