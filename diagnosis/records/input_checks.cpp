#include "diagnosis/records/input_checks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"

namespace levitas::diagnosis {
namespace {

struct Sums {
  double count{}, mean{}, squares{};  ///< Welford 1962: sums of micrometres keep their digits

  void Add(double value) {
    count += 1.0;
    const double away = value - mean;
    mean += away / count;
    squares += away * (value - mean);
  }
  [[nodiscard]] double scatter() const { return count > 0.0 ? std::sqrt(squares / count) : 0.0; }
  [[nodiscard]] double rms() const { return std::hypot(scatter(), mean); }
};

void RefuseSilentReadings(const RigView& rig, const Record& record) {
  for (std::size_t a = 0; a < rig.axes; ++a) {
    Sums reading;
    for (const analysis::RecordedRow& row : record.rows) {
      if (row.levitated) reading.Add(row.sample.position_m[a]);
    }
    const double noise_m = rig.ReadingNoise(a);
    if (reading.count < 2.0 || reading.scatter() >= kSilent * noise_m) continue;
    throw BadInput(fmt::format(
        "{}: position {} scatters by {:.3g} um in flight, its sensor's noise and converter alone "
        "make {:.3g} um; allowed: at least {:.3g} um. Is its column in the unit that its name ends "
        "in (_m, _mm, _um)? Name it by the unit, or state the sensor in the rig file",
        record.name, rig.numbers.channels[a], 1e6 * reading.scatter(), 1e6 * noise_m,
        1e6 * kSilent * noise_m));
  }
}

constexpr const char* kCurrentRemedy =
    "Are the columns in the unit that their names end in (_a, _ma)? Name them by the unit, or "
    "state "
    "the magnets in the rig file";

void RefuseImpossibleCurrents(const RigView& rig, const Record& record) {
  double share_of_bias = 0.0;
  double largest_a = 0.0;
  bool on = false;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    Sums current;
    for (const analysis::RecordedRow& row : record.rows) {
      const double value_a = row.sample.command.control_current_a[a];
      if (row.levitated && value_a != 0.0) current.Add(value_a);
    }
    if (current.count == 0.0) continue;
    const double most_a = rig.bearing(a).magnet.max_coil_current_a;
    if (most_a > 0.0 && current.rms() > kFarBeyond * most_a) {
      throw BadInput(fmt::format(
          "{}: control current {} is {:.4g} A (rms), its coils take {:.4g} A; allowed: at most "
          "{:.4g} A. {}",
          record.name, rig.numbers.channels[a], current.rms(), most_a, kFarBeyond * most_a,
          kCurrentRemedy));
    }
    on = true;
    largest_a = std::max(largest_a, current.rms());
    share_of_bias = std::max(share_of_bias, current.rms() / rig.bias_a(a));
  }
  if (!on || share_of_bias >= kNoCurrent) return;
  throw BadInput(fmt::format(
      "{}: control currents are {:.3g} A (rms) at most while the rotor is levitated on a bias "
      "current of {:.4g} A; allowed: at least {:.3g} A, less carries no rotor. {}",
      record.name, largest_a, rig.bias_a(0), kNoCurrent * rig.bias_a(0), kCurrentRemedy));
}

}  // namespace

void RefuseWrongUnits(const RigView& rig, const Record& record) {
  RefuseSilentReadings(rig, record);
  RefuseImpossibleCurrents(rig, record);
}

}  // namespace levitas::diagnosis
