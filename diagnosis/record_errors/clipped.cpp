// Plateaus of readings; see readings.hpp.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/record_errors/readings.hpp"
#include "diagnosis/record_errors/wiring.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kPlateau = 20;  ///< rows
constexpr double kOverNext = 3.0;
constexpr double kNearPlateau = 0.1;  ///< of the noise: rows that come so near the plateau
constexpr double kOwnRange = 0.98;    ///< from here on it is the sensor's

struct Plateau {
  double at_m{};
  std::size_t rows{};
};

/// The largest of the values where it is a plateau, of the values times `side`.
Plateau PlateauOf(std::vector<double> values, double near_m) {
  std::sort(values.begin(), values.end(), std::greater<>());
  const double top = values.front();
  const double same = 1e-6 * near_m;
  std::size_t at = 0;
  while (at < values.size() && values[at] >= top - same) ++at;
  std::size_t next = at;
  const double below = at < values.size() ? std::max(near_m, top - values[at] + same) : near_m;
  while (next < values.size() && values[next] >= top - below) ++next;
  const auto beside = static_cast<double>(next - at);
  const bool found = at >= kPlateau && static_cast<double>(at) > kOverNext * std::max(1.0, beside);
  return found ? Plateau{top, at} : Plateau{};
}

}  // namespace

void FindClipped(const RigView& rig, const Columns& columns, RecordErrors& out) {
  for (Eigen::Index a = 0; a < columns.axes(); ++a) {
    const auto axis = static_cast<std::size_t>(a);
    for (const double side : {1.0, -1.0}) {
      std::vector<double> values;
      for (Eigen::Index n = 0; n < columns.rows(); ++n) {
        values.push_back(side * columns.position_m(n, a));
      }
      if (values.size() < 2 * kPlateau) continue;
      const Plateau found = PlateauOf(std::move(values), kNearPlateau * rig.ReadingNoise(axis));
      const double range_m = rig.bearing(axis).sensor.range_m;
      if (found.rows == 0 || (range_m > 0.0 && found.at_m >= kOwnRange * range_m)) continue;
      const double share = static_cast<double>(found.rows) / static_cast<double>(columns.rows());
      out.errors.push_back(
          {RecordErrorKind::kClipped,
           {PositionColumn(rig, axis)},
           side * found.at_m,
           share,
           fmt::format("{} is clipped at {:.4g} um in {:.2g} % of its rows; the sensor reads to "
                       "{:.4g} um",
                       PositionColumn(rig, axis), 1e6 * side * found.at_m, 100.0 * share,
                       1e6 * range_m),
           "record it with a larger range; no map of columns mends it",
           false});
    }
  }
}

}  // namespace levitas::diagnosis
