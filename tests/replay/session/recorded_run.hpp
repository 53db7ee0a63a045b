#pragma once
// A run of the shipped rig and controller in one process, recorded as the programs record it: the
// header holds the complete texts, so that a replay has to go through the files' reader and writer.

#include <string>
#include <vector>

#include "common/rotational_speed.hpp"
#include "configuration/rig_file.hpp"
#include "session/log/session_writer.hpp"
#include "tests/loop/levitation/closed_loop.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session::testing {

inline configuration::ControllerFile ShippedController() {
  return configuration::LoadController(
      levitas::test::SourceFolder() + "/config/controllers/flexible_rotor.yaml",
      test::ShippedRig().numbers);
}

inline SessionHeader ShippedHeader() {
  SessionHeader header = Header();
  header.rig_yaml = configuration::WriteRig(test::ShippedRig());
  header.controller_yaml =
      configuration::WriteController(ShippedController(), test::ShippedRig().numbers);
  return header;
}

/// Plant and control cycle; keeps every record.
class RecordedRun {
 public:
  explicit RecordedRun(std::uint64_t seed = 3,
                       const cycle::CycleConfig& config = test::ShippedCycle())
      : plant_(test::ShippedRig().plant, seed), control_(config) {
    plant_.RestInTouchdown();
  }

  /// One period; `change` may alter what the controller is shown.
  template <class Change>
  const cycle::CycleOutputs& Step(Change change) {
    cycle::CycleRecord record;
    record.in.cycle = records.size();
    record.in.frame_present = true;
    record.in.frame = plant_.Sample();
    change(record.in);
    record.out = control_.Step(record.in);
    const CurrentFrame& c = record.out.current;
    plant_.Advance({c.control_current_a, c.bias_current_a, c.amplifiers_enabled, c.drive_enabled,
                    c.speed_set_point_rad_per_s, c.acceleration_limit_rad_per_s2});
    records.push_back(record);
    return records.back().out;
  }
  void Run(int cycles) {
    for (int i = 0; i < cycles; ++i) Step([](cycle::CycleInputs&) {});
  }
  void Command(OperatorCommand command, double speed_rpm = 0.0, double rpm_per_s = 0.0) {
    Step([&](cycle::CycleInputs& in) {
      in.op = {command, RpmToRadPerS(speed_rpm), RpmToRadPerS(rpm_per_s), {}, {}};
    });
  }
  bool RunUntil(Mode mode, int most_cycles) {
    for (int i = 0; i < most_cycles; ++i) {
      if (Step([](cycle::CycleInputs&) {}).mode == mode) return true;
    }
    return false;
  }

  std::vector<cycle::CycleRecord> records;

 private:
  plant::Plant plant_;
  cycle::ControlCycle control_;
};

/// Everything that can happen to a controller: lift, refused command, excitation, run-up, missing
/// frames, missed deadlines, a number that is none, the trip after it, reset.
inline std::vector<cycle::CycleRecord> EventfulRun(
    const cycle::CycleConfig& config = test::ShippedCycle()) {
  RecordedRun run(3, config);
  Random draw{11};
  run.Run(100);
  run.Command(OperatorCommand::kSpin, 600.0, 1000.0);  // refused: the rotor lies
  run.Command(OperatorCommand::kLift);
  EXPECT_TRUE(run.RunUntil(Mode::kLevitating, 30'000));
  for (int i = 0; i < 2000; ++i) {
    run.Step([&](cycle::CycleInputs& in) {
      in.op.excitation_a = DrawAxes(draw, 0.05);
      in.op.excitation_m = DrawAxes(draw, 2e-6);
    });
  }
  run.Command(OperatorCommand::kSpin, 600.0, 1000.0);
  for (int i = 0; i < 5000; ++i) {
    run.Step([i](cycle::CycleInputs& in) {
      in.frame_present = i % 97 != 0;
      in.missed_deadlines = i % 501 == 0 ? 1 : 0;
    });
  }
  run.Step([](cycle::CycleInputs& in) {
    in.frame.position_m[2] = std::numeric_limits<double>::quiet_NaN();
  });
  EXPECT_TRUE(run.RunUntil(Mode::kTripped, 10));
  run.Run(3000);
  run.Command(OperatorCommand::kReset);
  run.Run(100);
  return run.records;
}

}  // namespace levitas::session::testing
