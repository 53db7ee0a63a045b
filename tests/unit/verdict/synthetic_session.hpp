#pragma once
// Records whose figures are known in closed form: both bearings on the same circle about an offset,
// currents with a static and a harmonic part.

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "common/rig_numbers.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "verdict/session_statistics.hpp"

namespace levitas::verdict {

inline constexpr double kTwoPi = 6.283185307179586;

inline RigNumbers TwoBearingRig() {
  RigNumbers rig;
  rig.name = "test_rig";
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  rig.bias_current_a = 1.0;
  rig.max_coil_current_a = 2.0;
  rig.clearance_m = 200e-6;
  rig.sensor_polarity.fill(1.0);
  rig.actuator_polarity.fill(1.0);
  rig.standing_orbit_objective_m = 7e-6;
  rig.spinning_orbit_objective_m = 36e-6;
  return rig;
}

struct Motion {
  double radius_m{};
  double offset_x_m{};
  double offset_y_m{};
  double speed_rad_per_s{};
  double static_a{};
  double amplitude_a{};
};

/// Appends cycles to a session; one circle takes `cycles_per_turn`, whatever the speed says, so
/// that sums over whole turns are exact.
class SyntheticSession {
 public:
  static constexpr int kCyclesPerTurn = 200;

  void Append(Mode mode, int cycles, const Motion& motion = {},
              const std::function<void(cycle::CycleRecord&)>& change = nullptr) {
    for (int i = 0; i < cycles; ++i) {
      cycle::CycleRecord record;
      const double angle = kTwoPi * i / kCyclesPerTurn;
      record.in.cycle = next_cycle_++;
      record.in.frame_present = true;
      record.in.frame.axes = 4;
      record.in.frame.speed_rad_per_s = motion.speed_rad_per_s;
      for (std::size_t b = 0; b < 2; ++b) {
        record.in.frame.position_m[2 * b] = motion.offset_x_m + motion.radius_m * std::cos(angle);
        record.in.frame.position_m[2 * b + 1] =
            motion.offset_y_m + motion.radius_m * std::sin(angle);
      }
      for (std::size_t axis = 0; axis < 4; ++axis) {
        record.out.current.control_current_a[axis] =
            motion.static_a + motion.amplitude_a * std::cos(angle);
      }
      record.out.mode = mode;
      if (change) change(record);
      records_.push_back(record);
    }
  }
  void SkipRecords(std::uint64_t count) { next_cycle_ += count; }

  [[nodiscard]] SessionFigures Figures(const RigNumbers& rig, double settle_s = 0.0,
                                       double standstill_rad_per_s = 1.0) const {
    SessionStatistics statistics(rig, standstill_rad_per_s, settle_s);
    for (const auto& record : records_) statistics.Add(record);
    return statistics.Figures();
  }
  [[nodiscard]] std::vector<cycle::CycleRecord>& records() { return records_; }

 private:
  std::vector<cycle::CycleRecord> records_;
  std::uint64_t next_cycle_{1000};  // sessions need not start at zero
};

}  // namespace levitas::verdict
