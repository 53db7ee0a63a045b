#include "diagnosis/levitator/series.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"

namespace levitas::levitator {
namespace {

constexpr double kLiftOffS = 3.0;
constexpr double kLiftOffShare = 0.2;
constexpr double kLeastS = 1.0;

double Asked(const plant::PlantConfig& rig, const plant::PlantCommand& command, std::size_t coil) {
  const double sign = coil == 0 ? 1.0 : -1.0;
  return std::clamp(command.bias_current_a + sign * command.control_current_a[0], 0.0,
                    rig.bearings[0].magnet.max_coil_current_a);
}

void Append(const plant::PlantConfig& rig, const analysis::RecordedRow& row, double time_s,
            Series& series) {
  series.time_s.push_back(time_s);
  series.position_m.push_back(row.sample.position_m[0]);
  for (std::size_t coil = 0; coil < 2; ++coil) {
    series.asked_a[coil].push_back(Asked(rig, row.sample.command, coil));
    if (row.coils >= 2) series.measured_a[coil].push_back(row.coil_current_a[coil]);
  }
}

constexpr double kSettlingS = 0.5;

/// Rows from `begin_s` to `end_s`; half a second later they begin to count.
void Cut(Series& series, double begin_s, double end_s) {
  const auto row = [&](double time_s) {
    return std::lower_bound(series.time_s.begin(), series.time_s.end(), time_s) -
           series.time_s.begin();
  };
  const auto first = row(begin_s);
  const auto last = row(end_s);
  const auto cut = [first, last](auto& values) {
    if (values.empty()) return;
    values.erase(values.begin() + last, values.end());
    values.erase(values.begin(), values.begin() + first);
  };
  cut(series.position_m);
  cut(series.restart);
  for (std::size_t coil = 0; coil < 2; ++coil) {
    cut(series.asked_a[coil]);
    cut(series.measured_a[coil]);
  }
  cut(series.time_s);
  series.restart.front() = true;
  for (std::size_t coil = 0; coil < 2; ++coil) {
    series.idle[coil] = std::all_of(series.asked_a[coil].begin(), series.asked_a[coil].end(),
                                    [](double asked_a) { return asked_a <= 0.0; });
  }
  series.counts.clear();
  for (const double time_s : series.time_s) series.counts.push_back(time_s >= begin_s + kSettlingS);
}

}  // namespace

bool IsLevitator(const plant::PlantConfig& rig) {
  return rig.bearings.size() == 1 && rig.bearings[0].x_only &&
         rig.bearings[0].amplifier.voltage.has_value() &&
         rig.bearings[0].magnet.exponential.has_value();
}

Series MakeSeries(const std::string& name, const configuration::RigFile& rig,
                  const std::vector<analysis::RecordedRow>& rows) {
  const double period_s = rig.numbers.period_s();
  Series series;
  series.name = name;
  std::uint64_t before = 0;
  for (const analysis::RecordedRow& row : rows) {
    if (!row.levitated) continue;
    const bool restart = series.time_s.empty() || row.cycle != before + 1;
    before = row.cycle;
    series.restart.push_back(restart);
    Append(rig.plant, row, static_cast<double>(row.cycle - rows.front().cycle) * period_s, series);
  }
  if (series.has_currents() && series.measured_a[0].size() != series.size()) {
    throw BadInput(name + ": coil currents were measured in a part of the rows only");
  }
  const double whole_s = static_cast<double>(series.size()) * period_s;
  const double lift_off_s = std::min(kLiftOffS, kLiftOffShare * whole_s);
  if (whole_s - lift_off_s < kLeastS) {
    throw BadInput(fmt::format("{}: {:.2f} s of flight after the lift-off, a diagnosis needs {} s",
                               name, std::max(0.0, whole_s - lift_off_s), kLeastS));
  }
  // What happens before is not looked at: contact, and currents that no observer follows.
  Cut(series, series.time_s.front() + std::max(0.0, lift_off_s - kSettlingS),
      series.time_s.back() + period_s);
  return series;
}

Series Stretch(const Series& series, double seconds, double phase) {
  const double begin_s = series.time_s.front();
  const double spare_s = series.time_s.back() - begin_s - seconds - kSettlingS;
  if (spare_s <= 0.0) return series;
  Series out = series;
  Cut(out, begin_s + phase * spare_s, begin_s + phase * spare_s + seconds + kSettlingS);
  return out;
}

}  // namespace levitas::levitator
