#include "session/exchange/plausible_values.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace levitas::session {
namespace {

/// Of the probe's range: a reading that scatters less is hardly one of a rotor that hovers. A
/// converter of 16 bit over the range has steps of 3e-5 of it, and noise of some steps.
constexpr double kStill = 5e-5;
constexpr double kCurrentMargin = 2.0;  // of what an amplifier gives, before a command is doubted

/// [m] Where a reading is no place of the rotor any more. It bends and tilts beyond the clearance
/// of its touchdown bearings, as far as the probe is from them.
double BoundOf(const RigNumbers& rig, std::size_t axis) {
  constexpr double kTilt = 1.2;
  const double range_m = rig.SensorRangeOf(axis / 2);
  const double clearance_m = rig.ClearanceOf(axis / 2);
  return clearance_m > 0.0 ? std::min(range_m, kTilt * clearance_m) : range_m;
}

struct Prefix {
  double divisor;
  std::string_view length;
  std::string_view current;
};
constexpr std::array<Prefix, 4> kPrefixes{
    {{1.0, "m", "a"}, {1e3, "mm", "ma"}, {1e6, "um", ""}, {1e9, "nm", ""}}};

std::string UnitOfDivisor(double divisor, bool length) {
  for (const Prefix& prefix : kPrefixes) {
    if (prefix.divisor == divisor) return std::string(length ? prefix.length : prefix.current);
  }
  return {};
}

/// How often a thousand has to be taken from `size` until it is at most `bound`; 0 where that is
/// no question of units.
double ThousandsIn(double size, double bound) {
  for (const double factor : {1e3, 1e6, 1e9}) {
    if (size <= factor * bound) return factor;
  }
  return 0.0;
}

/// What a column that is too large by a unit should have said.
std::string LikelyUnit(const CsvColumn& column, double factor, bool length) {
  if (factor == 0.0) return "they are in another unit or scale";
  const std::string taken = UnitOfDivisor(column.divisor, length);
  const std::string likely = UnitOfDivisor(column.divisor * factor, length);
  const std::string scale = fmt::format("its scale is {:g} times too large", factor);
  if (taken.empty() || likely.empty()) return scale;
  const std::string unit = fmt::format("its numbers are in {}, not in {}", likely, taken);
  return std::abs(column.factor) == 1.0 ? unit : fmt::format("{}, or {}", unit, scale);
}

/// Of a position that moves less than a probe's noise: most likely its unit is too small.
ImplausibleColumn TooStill(const CsvColumn& column, double deviation_m) {
  constexpr double kThousand = 1e3;
  const std::string taken = UnitOfDivisor(column.divisor, true);
  const std::string likely = UnitOfDivisor(column.divisor / kThousand, true);
  return {fmt::format("column \"{}\" scatters by {:.3g} um only, which is less than a probe's "
                      "noise; likely its {}",
                      column.name, 1e6 * deviation_m,
                      taken.empty() || likely.empty()
                          ? "scale is 1000 times too small"
                          : fmt::format("numbers are in {}, not in {}", likely, taken)),
          false};
}

double Share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

void PlausibleValues::Spread::Count(double value, double bound) noexcept {
  if (!std::isfinite(value)) return;  // a sensor that gave no number says nothing of units
  ++count;
  const double size = std::abs(value);
  largest = std::max(largest, size);
  if (size > bound) ++beyond;
  if (size > 10.0 * bound) ++far_beyond;
  const double away = value - mean;
  mean += away / static_cast<double>(count);
  square_sum += away * (value - mean);
}

double PlausibleValues::Spread::deviation() const noexcept {
  return count == 0 ? 0.0 : std::sqrt(square_sum / static_cast<double>(count));
}

PlausibleValues::PlausibleValues(const RigNumbers& rig) : rig_(rig) {}

void PlausibleValues::Count(const cycle::CycleRecord& record) noexcept {
  for (std::size_t axis = 0; axis < rig_.axes() && axis < kMaxAxes; ++axis) {
    position_[axis].Count(record.in.frame.position_m[axis], BoundOf(rig_, axis));
    current_[axis].Count(record.out.current.control_current_a[axis], rig_.max_coil_current_a);
    excitation_[axis].Count(record.in.op.excitation_a[axis], rig_.max_coil_current_a);
  }
}

ImplausibleColumn PlausibleValues::OfPosition(const CsvColumn& column, const Spread& spread) const {
  const std::size_t bearing = column.axis / 2;
  const double range_m = rig_.SensorRangeOf(bearing);
  const bool mostly = Share(spread.beyond, spread.count) > 0.5;
  if (range_m > 0.0 && spread.deviation() > 0.0 && spread.deviation() < kStill * range_m) {
    return TooStill(column, spread.deviation());
  }
  if (!(range_m > 0.0) || !(mostly || spread.largest > range_m)) return {};
  const bool moves = spread.deviation() > range_m;
  std::string likely;
  const double away_m = std::abs(spread.mean);
  if (mostly && spread.deviation() < 0.1 * away_m && away_m < 10.0 * range_m) {
    likely = fmt::format("; it stands about {:.4g} mm away from zero: is that its offset?",
                         1e3 * spread.mean);
  } else if (mostly && spread.largest < 2.0 * range_m) {
    likely = "; is its scale right, and the clearance of the rig file?";
  } else if (mostly) {
    likely =
        fmt::format("; likely {}", LikelyUnit(column, ThousandsIn(spread.largest, range_m), true));
  }
  return {
      fmt::format("column \"{}\" (position of {}) reaches {:.4g} mm: its probe reads to {:.4g} mm, "
                  "the rotor moves by {:.4g} mm (rig {}), and {:.3g} % of its numbers are beyond{}",
                  column.name, rig_.channels[column.axis], 1e3 * spread.largest, 1e3 * range_m,
                  1e3 * rig_.ClearanceOf(bearing), rig_.name,
                  100.0 * Share(spread.beyond, spread.count), likely),
      mostly && moves};
}

ImplausibleColumn PlausibleValues::OfCurrent(const CsvColumn& column, const Spread& spread) const {
  const double most_a = rig_.max_coil_current_a;
  if (!(most_a > 0.0) || !(spread.largest > kCurrentMargin * most_a)) return {};
  const bool impossible = Share(spread.far_beyond, spread.count) > 0.5;
  const double factor = spread.largest <= 10.0 * most_a ? 0.0 : ThousandsIn(spread.largest, most_a);
  return {fmt::format(
              "column \"{}\" ({} of {}) reaches {:.4g} A, and the amplifiers give {:.4g} A "
              "(rig {}); {}",
              column.name, column.quantity == CsvQuantity::kExcitation ? "test signal" : "current",
              rig_.channels[column.axis], spread.largest, most_a, rig_.name,
              factor == 0.0 ? "is its unit right?" : "likely " + LikelyUnit(column, factor, false)),
          impossible};
}

std::vector<ImplausibleColumn> PlausibleValues::Found(const CsvLayout& layout) const {
  std::vector<ImplausibleColumn> found;
  for (const CsvColumn& column : layout.columns) {
    ImplausibleColumn one;
    switch (column.quantity) {
      case CsvQuantity::kPosition:
      case CsvQuantity::kGap:
        one = OfPosition(column, position_[column.axis]);
        break;
      case CsvQuantity::kControlCurrent:
        one = OfCurrent(column, current_[column.axis]);
        break;
      case CsvQuantity::kExcitation:
        one = OfCurrent(column, excitation_[column.axis]);
        break;
      default:
        break;
    }
    if (!one.sentence.empty()) found.push_back(one);
  }
  return found;
}

}  // namespace levitas::session
