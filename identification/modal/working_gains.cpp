#include "identification/modal/working_gains.hpp"

namespace levitas::identification {

WorkingGains WorkingGainsOf(const ModalFrame& frame, const FrequencyResponse& response) {
  const Eigen::Index axes = response.axes();
  WorkingGains gains{Eigen::MatrixXd::Ones(axes, axes), Eigen::MatrixXd::Ones(axes, axes)};
  const Moments& moments = response.moments;
  if (moments.current_square_a2.size() == 0) return gains;
  for (Eigen::Index axis = 0; axis < axes; ++axis) {
    const double i0 = frame.bias_current_a[axis / 2];
    const double s0 = frame.gap_m[axis / 2];
    const auto aa = moments.current_square_a2.row(axis).array() / (i0 * i0);
    const auto ee = moments.position_square_m2.row(axis).array() / (s0 * s0);
    const auto ae = moments.product_a_m.row(axis).array() / (i0 * s0);
    gains.ki.row(axis) = 1.0 + 3.0 * ee + 2.0 * ae;
    gains.ks.row(axis) = 1.0 + aa + 6.0 * ee + 6.0 * ae;
  }
  return gains;
}

}  // namespace levitas::identification
