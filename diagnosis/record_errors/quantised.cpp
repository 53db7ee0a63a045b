// Steps of readings; see readings.hpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/record_errors/readings.hpp"
#include "diagnosis/record_errors/wiring.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kCoarseSteps = 4.0;  ///< times the converter's step
constexpr double kOfNoise = 1.0;      ///< a finer step disappears in the noise
constexpr double kOnGrid = 0.99;      ///< of the rows
constexpr double kNearGrid = 0.02;    ///< of a step
constexpr std::size_t kFewestReadings = 500;

/// The step of the values' grid; 0: none.
double GridOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double spread = values.back() - values.front();
  std::vector<double> apart;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = values[i] - values[i - 1];
    if (step > 1e-7 * spread) apart.push_back(step);
  }
  if (apart.empty() || !(spread > 0.0)) return 0.0;
  const double step = *std::min_element(apart.begin(), apart.end());
  std::size_t on = 0;
  for (const double distance : apart) {
    const double steps = distance / step;
    if (std::abs(steps - std::round(steps)) < kNearGrid * std::max(1.0, steps)) ++on;
  }
  return static_cast<double>(on) >= kOnGrid * static_cast<double>(apart.size()) ? step : 0.0;
}

}  // namespace

void FindQuantised(const RigView& rig, const Columns& columns, RecordErrors& out) {
  for (Eigen::Index a = 0; a < columns.axes(); ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const plant::SensorConfig& sensor = rig.bearing(axis).sensor;
    std::vector<double> values;
    for (Eigen::Index n = 0; n < columns.rows(); ++n) values.push_back(columns.position_m(n, a));
    if (values.size() < kFewestReadings) continue;
    const double step_m = GridOf(std::move(values));
    const double own_m =
        sensor.adc_bits > 0 ? 2.0 * sensor.range_m / std::ldexp(1.0, sensor.adc_bits) : 0.0;
    const double noise_m = rig.ReadingNoise(axis);
    if (step_m < kCoarseSteps * own_m || step_m < kOfNoise * noise_m || step_m <= 0.0) continue;
    out.errors.push_back(
        {RecordErrorKind::kQuantised,
         {PositionColumn(rig, axis)},
         step_m,
         step_m / std::max(own_m, 1e-12),
         fmt::format(
             "{} has steps of {:.3g} um, the rig's converter {:.3g} um, its noise {:.3g} um",
             PositionColumn(rig, axis), 1e6 * step_m, 1e6 * own_m, 1e6 * noise_m),
         "record it with more digits or a finer range; no map of columns mends it",
         false});
  }
}

}  // namespace levitas::diagnosis
