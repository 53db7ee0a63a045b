#pragma once
// Rig and controller in closed loop within one process, and what they do as a recording in memory.
//
// Kept      of the steps that ask for it: positions as read, commanded currents, test currents,
//           speed and angle; the rest of a recording is left as it is.
// Frame     bearing frame of a rig without polarities; units SI.
// Thread    one instance per thread. Failure: std::runtime_error when the rig does not levitate.

#include <cmath>
#include <stdexcept>
#include <utility>

#include "common/rotational_speed.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/plant.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::accuracy {

class RecordedBench {
 public:
  RecordedBench(const cycle::CycleConfig& config, plant::Plant plant)
      : plant_(std::move(plant)), cycle_(config) {
    plant_.RestInTouchdown();
    const RigNumbers& rig = config.rig;
    record.period_ns = rig.period_ns;
    record.channels = rig.channels;
    record.sensor_range_m.assign(rig.axes(), rig.sensor_range_m);
    record.current_limit_a = rig.bias_current_a;
    for (auto* columns :
         {&record.position_m, &record.current_a, &record.excitation_a, &record.excitation_m}) {
      columns->resize(rig.axes());
    }
  }

  Mode Step(const cycle::OperatorInput& op, bool keep = false) {
    cycle::CycleInputs in;
    in.cycle = count_++;
    in.frame_present = true;
    in.frame = plant_.Sample();
    in.op = op;
    const cycle::CycleOutputs out = cycle_.Step(in);
    plant_.Advance({out.current.control_current_a, out.current.bias_current_a,
                    out.current.amplifiers_enabled, out.current.drive_enabled,
                    out.current.speed_set_point_rad_per_s,
                    out.current.acceleration_limit_rad_per_s2});
    if (keep) Keep(in, out);
    return out.mode;
  }
  void Run(double time_s) {
    for (long n = std::lround(time_s / record.period_s()); n > 0; --n) (void)Step({});
  }
  /// And `settle_s` more.
  void Levitate(double settle_s = 0.5) {
    Mode mode = Step({OperatorCommand::kLift, 0.0, 0.0, {}});
    for (int n = 0; n < 50'000 && mode != Mode::kLevitating; ++n) mode = Step({});
    if (mode != Mode::kLevitating) throw std::runtime_error("the rig does not levitate");
    Run(settle_s);
  }
  /// At speed without the time of a run-up: the drive holds it.
  void SpinAt(double rpm) {
    plant_.SetSpeed(RpmToRadPerS(rpm), 0.0);
    (void)Step({OperatorCommand::kSpin, RpmToRadPerS(rpm), RpmToRadPerS(800.0), {}});
    Run(0.5);
  }

  session::Recording record;

 private:
  void Keep(const cycle::CycleInputs& in, const cycle::CycleOutputs& out) {
    record.cycle.push_back(in.cycle);
    record.levitated.push_back(1);
    record.speed_rad_per_s.push_back(in.frame.speed_rad_per_s);
    record.angle_rad.push_back(in.frame.angle_rad);
    for (std::size_t axis = 0; axis < record.axes(); ++axis) {
      record.position_m[axis].push_back(in.frame.position_m[axis]);
      record.current_a[axis].push_back(out.current.control_current_a[axis]);
      record.excitation_a[axis].push_back(in.op.excitation_a[axis]);
    }
  }

  plant::Plant plant_;
  cycle::ControlCycle cycle_;
  std::uint64_t count_{};
};

}  // namespace levitas::accuracy
