#include "design/notch/measured_plant.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "common/two_pi.hpp"
#include "design/notch/bearing_phase.hpp"

namespace levitas::design {
namespace {

using Eigen::MatrixXcd;

/// A gap between two lines beyond which P may do anything, of the frequency. Next to an order of
/// the rotation lines are left out, and it is there that a block acts.
constexpr double kWidestGap = 0.2;

MatrixXcd Smoothed(const MeasuredPlant& record, std::size_t line) {
  const double width_hz = kSmoothed * record.frequency_hz[line];
  MatrixXcd sum = MatrixXcd::Zero(record.plant[line].rows(), record.plant[line].cols());
  double lines = 0.0;
  // As many on either side, so that a slope leaves the mean where it is.
  for (std::size_t k = 0; line >= k && line + k < record.plant.size(); ++k) {
    const double below_hz = record.frequency_hz[line] - record.frequency_hz[line - k];
    const double above_hz = record.frequency_hz[line + k] - record.frequency_hz[line];
    if (std::max(below_hz, above_hz) > width_hz) break;
    sum += record.plant[line - k];
    lines += 1.0;
    if (k == 0) continue;
    sum += record.plant[line + k];
    lines += 1.0;
  }
  return sum / lines;
}

MatrixXcd InRecord(const MeasuredPlant& record, double frequency_hz) {
  const auto above = std::ranges::lower_bound(record.frequency_hz, frequency_hz);
  const bool inside = above != record.frequency_hz.end() &&
                      (above != record.frequency_hz.begin() || *above == frequency_hz);
  const auto upper = static_cast<std::size_t>(above - record.frequency_hz.begin());
  const std::size_t lower = upper == 0 ? 0 : upper - 1;
  if (!inside ||
      record.frequency_hz[upper] - record.frequency_hz[lower] > kWidestGap * frequency_hz) {
    throw BadInput(fmt::format(
        "the record at {:.0f} rpm has no lines around {:.2f} Hz ({} lines from {:.2f} to {:.2f} "
        "Hz): excite longer and with a wider signal, or choose another window",
        RadPerSToRpm(record.speed_rad_per_s), frequency_hz, record.frequency_hz.size(),
        record.frequency_hz.empty() ? 0.0 : record.frequency_hz.front(),
        record.frequency_hz.empty() ? 0.0 : record.frequency_hz.back()));
  }
  const MatrixXcd high = Smoothed(record, upper);
  if (lower == upper) return high;
  const double span_hz = record.frequency_hz[upper] - record.frequency_hz[lower];
  const double share = (frequency_hz - record.frequency_hz[lower]) / span_hz;
  return (1.0 - share) * Smoothed(record, lower) + share * high;
}

}  // namespace

MatrixXcd PlantAt(std::span<const MeasuredPlant> records, double speed_rad_per_s,
                  double frequency_hz) {
  const auto above =
      std::ranges::lower_bound(records, speed_rad_per_s, {}, &MeasuredPlant::speed_rad_per_s);
  if (above == records.begin()) return InRecord(records.front(), frequency_hz);
  if (above == records.end()) return InRecord(records.back(), frequency_hz);
  const MeasuredPlant& below = *(above - 1);
  const double share =
      (speed_rad_per_s - below.speed_rad_per_s) / (above->speed_rad_per_s - below.speed_rad_per_s);
  return (1.0 - share) * InRecord(below, frequency_hz) + share * InRecord(*above, frequency_hz);
}

MatrixXcd MeasuredAnswer(std::span<const MeasuredPlant> records, const analysis::SampledLoop& loop,
                         const synchronous::BlockConfig& block, double speed_rad_per_s) {
  const double frequency_hz = block.order * speed_rad_per_s / kTwoPi;
  const MatrixXcd plant = PlantAt(records, speed_rad_per_s, frequency_hz);
  const auto z = std::polar(1.0, kTwoPi * frequency_hz * loop.period_s);
  const MatrixXcd loop_gain = plant * LawAt(loop, z);
  const MatrixXcd sensitivity =
      Eigen::FullPivLU<MatrixXcd>(MatrixXcd::Identity(plant.rows(), plant.cols()) + loop_gain)
          .inverse();
  if (block.target == synchronous::Target::kCurrent) return sensitivity;
  return sensitivity * plant;
}

}  // namespace levitas::design
