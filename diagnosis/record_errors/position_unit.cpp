#include "diagnosis/record_errors/position_unit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "diagnosis/record_errors/wiring.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kFar = 32.0;      ///< times the sensor's noise: half way to a thousand, in ratio
constexpr double kSurely = 150.0;  ///< a sensor is hardly seven times as quiet as its file says
constexpr double kBeyond = 1.5;    ///< of the touchdown clearance: no rotor gets there

/// The unit of a column whose numbers have to be multiplied by `factor`, one of 10^3 and 10^6 or
/// their inverses.
std::string UnitWords(double factor) {
  return fmt::format("{:g} times too {}", factor > 1.0 ? factor : 1.0 / factor,
                     factor > 1.0 ? "small" : "large");
}

/// 1 where the unit is right.
double FactorOf(double noise_m, double expected_m, bool beyond) {
  if (!(noise_m > 0.0) || !(expected_m > 0.0)) return 1.0;
  const double ratio = noise_m / expected_m;
  if (ratio < kFar && ratio > 1.0 / kFar) return 1.0;
  // Motion adds to the noise of quiet probes, nothing takes away from it.
  if (ratio > 1.0 && ratio < kSurely && !beyond) return 1.0;
  const double thousands = std::clamp(std::round(std::log10(ratio) / 3.0), -2.0, 2.0);
  return std::pow(1000.0, -thousands);
}

/// Whether readings of the axis lie where no rotor can be.
std::vector<bool> BeyondClearance(const RigView& rig, const Record& record) {
  std::vector<bool> beyond(rig.axes, false);
  for (std::size_t a = 0; a < rig.axes; ++a) {
    const double clearance_m = rig.bearing(a).touchdown.clearance_m;
    beyond[a] =
        clearance_m > 0.0 && std::ranges::any_of(record.rows, [&](const auto& row) {
          return row.levitated && std::abs(row.sample.position_m[a]) > kBeyond * clearance_m;
        });
  }
  return beyond;
}

/// rms of the readings' noise per axis [m], of the rows as they are; 0: not known.
AxisArray NoiseOf(const RigView& rig, const Record& record) {
  constexpr std::array kFourth{1.0, -4.0, 6.0, -4.0, 1.0};
  AxisArray noise_m{};
  for (std::size_t a = 0; a < rig.axes; ++a) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t n = 4; n < record.rows.size(); ++n) {
      if (record.rows[n].cycle != record.rows[n - 4].cycle + 4 || !record.rows[n].levitated)
        continue;
      double difference = 0.0;
      for (std::size_t k = 0; k < kFourth.size(); ++k)
        difference += kFourth[k] * record.rows[n - k].sample.position_m[a];
      if (!std::isfinite(difference)) continue;
      sum += difference * difference;
      count += 1.0;
    }
    noise_m[a] = count > 0.0 ? std::sqrt(sum / count / 70.0) : 0.0;
  }
  return noise_m;
}

}  // namespace

void FindPositionUnits(const RigView& rig, const Record& record, RecordErrors& out) {
  const AxisArray noise_m = NoiseOf(rig, record);
  const std::vector<bool> beyond = BeyondClearance(rig, record);
  for (const double factor : {1e3, 1e6, 1e-3, 1e-6}) {
    RecordError error{RecordErrorKind::kUnit, {}, factor, 0.0, {}, {}, true};
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const double expected_m = rig.ReadingNoise(a);
      if (FactorOf(noise_m[a], expected_m, beyond[a]) != factor) continue;
      out.uses.position[a].factor *= factor;
      error.columns.push_back(PositionColumn(rig, a));
      const double times = noise_m[a] / expected_m;
      error.statistic = std::max(times, 1.0 / times);
    }
    if (error.columns.empty()) continue;
    error.sentence = fmt::format("{} {} in another unit: numbers are {} (noise of the readings)",
                                 fmt::join(error.columns, ", "),
                                 error.columns.size() == 1 ? "is" : "are", UnitWords(factor));
    error.mend =
        "name the column by the unit of its numbers (_m, _mm, _um), or unit in a map of columns";
    out.errors.push_back(std::move(error));
  }
}

}  // namespace levitas::diagnosis
