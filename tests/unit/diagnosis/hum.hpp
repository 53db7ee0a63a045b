#pragma once
// A weightless rotor at rest whose probes read noise, and on de_x a hum of the mains of known size:
// no current, no force, so that nothing but the hum is wrong with the rig file.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/unit/diagnosis/moments.hpp"

namespace levitas::diagnosis {

inline constexpr double kHumNoise = 1e-6;  // [m] rms
inline constexpr double kHumHz = 50.0;
inline constexpr std::size_t kHumRows = 9'000;
inline constexpr std::size_t kHumSettling = 3'000;  // rows of 100 us: the model settles for 0.3 s

inline const configuration::RigFile& WeightlessRotor() {
  static const configuration::RigFile kRig = [] {
    configuration::RigFile rig = FlexibleRotor();
    rig.plant.gravity_m_per_s2 = 0.0;
    return rig;
  }();
  return kRig;
}

inline const RigView& WeightlessView() {
  static const RigView kView(WeightlessRotor().numbers, WeightlessRotor().plant);
  return kView;
}

inline Record HumRecord(double amplitude_m, std::size_t rows = kHumRows) {
  Random random(20261130);
  Record record;
  record.rows.resize(rows);
  for (std::size_t n = 0; n < rows; ++n) {
    analysis::RecordedRow& row = record.rows[n];
    row.cycle = n;
    row.levitated = true;
    row.sample.command.bias_current_a = WeightlessView().numbers.bias_current_a;
    for (std::size_t a = 0; a < WeightlessView().axes; ++a) {
      row.sample.position_m[a] = kHumNoise * random.Normal();
    }
    const double time_s = WeightlessView().period_s * static_cast<double>(n);
    row.sample.position_m[0] += amplitude_m * std::cos(2.0 * std::numbers::pi * kHumHz * time_s);
  }
  return record;
}

}  // namespace levitas::diagnosis
