#pragma once
// A record made by hand for the checks of errors of a record: smooth positions with the noise of
// the flexible rotor's probes, and currents computed from them by a PD law with a test signal, axis
// by axis. No plant: what the currents do is not in it.

#include <cmath>
#include <cstdint>
#include <random>

#include "diagnosis/model/model_run.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "tests/unit/diagnosis/answers.hpp"

namespace levitas::diagnosis {

inline const RigView& RotorView() {
  static const RigView view(FlexibleRotor().numbers, FlexibleRotor().plant);
  return view;
}

struct LoopPlan {
  std::size_t rows{6000};
  double speed_rad_per_s{};
  double orbit_m{};  ///< in step with the rotor
  bool test_signal{true};
  std::uint64_t seed{20261127};
};

inline Record RecordedLoop(const LoopPlan& plan = {}) {
  std::mt19937_64 draw{plan.seed};
  std::normal_distribution<double> normal;
  Record record;
  record.name = "made.csv";
  record.mean_speed_rad_per_s = plan.speed_rad_per_s;
  record.rows.resize(plan.rows);
  AxisArray smooth{};
  AxisArray before_m{};
  AxisArray before_a{};
  AxisArray test_a{};
  const double period_s = RotorView().period_s;
  for (std::size_t n = 0; n < plan.rows; ++n) {
    analysis::RecordedRow& row = record.rows[n];
    row.cycle = n;
    row.levitated = true;
    row.sample.speed_rad_per_s = plan.speed_rad_per_s;
    const double angle = plan.speed_rad_per_s * period_s * static_cast<double>(n);
    row.sample.angle_rad = std::fmod(angle, 6.283185307179586);
    for (std::size_t a = 0; a < RotorView().axes; ++a) {
      smooth[a] = 0.98 * smooth[a] + 2e-6 * normal(draw);
      if (n % 7 == 0) test_a[a] = normal(draw) > 0.0 ? 0.05 : -0.05;
      const double y_m = smooth[a] + plan.orbit_m * std::cos(angle - 1.5 * static_cast<double>(a)) +
                         1e-6 * normal(draw);
      const double e_a = plan.test_signal ? test_a[a] : 0.0;
      const double i_a = 0.4 * before_a[a] - 8e3 * y_m - 6e3 * (y_m - before_m[a]) + e_a;
      row.sample.position_m[a] = y_m;
      row.sample.command.control_current_a[a] = i_a;
      row.excitation_a[a] = e_a;
      before_m[a] = y_m;
      before_a[a] = i_a - e_a;
    }
  }
  return record;
}

inline Columns AllColumns(const Record& record) {
  return ColumnsOf(record, RotorView(), record.rows.size());
}

}  // namespace levitas::diagnosis
