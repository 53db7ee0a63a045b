#pragma once
// A weightless rotor at rest whose probes read noise, and on de_x a hum of the mains of known size:
// no current, no force, so that nothing but the hum is wrong with the rig file.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "diagnosis/inference/record_landscape.hpp"
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

/// The terms of the hum, axis by axis cosine and sine, and the zero of one probe to calibrate.
inline std::vector<Term> HumTerms() {
  std::vector<Term> terms = MainsTerms(WeightlessView(), {kHumHz}, 1);
  const Tolerances tolerances = WeightlessRotor().tolerances.value_or(Tolerances{});
  terms.push_back(Named(AllTerms(WeightlessView(), tolerances, 50e-6), "sensor_offset", "nde_y"));
  return terms;
}

/// A search at its beginning: nothing calibrated, no cause.
struct HumSearch {
  explicit HumSearch(double amplitude_m)
      : records{HumRecord(amplitude_m)},
        landscape(WeightlessView(), records, settings, rules.effort, terms) {
    found.theta = found.calibrated = landscape.search().HealthyParameters();
    landscape.LineariseAt(found.theta);
  }

  [[nodiscard]] double AmplitudeOnDeX() const { return std::hypot(found.theta[0], found.theta[1]); }

  SelectionRules rules{Judging{}, Effort{40, 6, 8, 5, 100'000, false}, 3};
  std::vector<Record> records;
  Settings settings;
  std::vector<Term> terms = HumTerms();
  RecordLandscape landscape;
  CauseSelection found;
};

/// [m] five standard deviations of an amplitude in white noise, s sqrt(2/n): once in a million.
inline double HumTolerance() {
  return 5.0 * kHumNoise * std::sqrt(2.0 / static_cast<double>(kHumRows - kHumSettling));
}

}  // namespace levitas::diagnosis
