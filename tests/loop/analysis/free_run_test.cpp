// A free run in closed loop beside a record of the nonlinear plant: near it where model and plant
// are the same, off it where one thing differs.

#include "analysis/records/free_run.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/problem.hpp"
#include "common/random.hpp"
#include "controller/law/axis_law.hpp"
#include "plant_sim/plant/plant.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

constexpr std::size_t kAxes = 4;
constexpr std::size_t kQuiet = 20'000;  // rows before a signal: the start has died away
constexpr std::size_t kSignal = 5'000;
constexpr std::size_t kPause = 2'000;
constexpr double kTestSignalA = 0.05;

/// Random binary currents on the axes named, one after the other.
session::Recording RecordOf(const plant::PlantConfig& truth, double speed_rad_per_s,
                            const std::vector<std::size_t>& excited) {
  const law::LawCoefficients law(test::FlexibleRotorLaw());
  law::LawState state(law);
  plant::Plant plant(truth, 20261121);
  plant.SetSpeed(speed_rad_per_s, 0.0);
  Random random(20261125);
  session::Recording r;
  r.name = "made";
  r.period_ns = truth.period_ns;
  r.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  for (auto* columns : {&r.position_m, &r.current_a, &r.excitation_a, &r.excitation_m}) {
    columns->assign(kAxes, {});
  }
  const std::size_t rows = kQuiet + excited.size() * (kSignal + kPause);
  for (std::size_t n = 0; n < rows; ++n) {
    const SensorFrame frame = plant.Sample();
    AxisArray error_m{};
    AxisArray excitation_a{};
    if (n >= kQuiet && (n - kQuiet) % (kSignal + kPause) < kSignal) {
      const std::size_t axis = excited[(n - kQuiet) / (kSignal + kPause)];
      excitation_a[axis] = random.Uniform() < 0.5 ? kTestSignalA : -kTestSignalA;
    }
    for (std::size_t i = 0; i < kAxes; ++i) error_m[i] = -frame.position_m[i];
    plant::PlantCommand command;
    command.bias_current_a = 1.0;
    command.control_current_a = law::Step(law, state, error_m, excitation_a, 1.0).control_current_a;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = speed_rad_per_s;
    for (std::size_t i = 0; i < kAxes; ++i) {
      r.position_m[i].push_back(frame.position_m[i]);
      r.current_a[i].push_back(command.control_current_a[i]);
      r.excitation_a[i].push_back(excitation_a[i]);
    }
    r.cycle.push_back(frame.cycle);
    r.levitated.push_back(1);
    r.amplifiers_enabled.push_back(1);
    r.speed_rad_per_s.push_back(frame.speed_rad_per_s);
    r.angle_rad.push_back(frame.angle_rad);
    r.bias_current_a.push_back(1.0);
    plant.Advance(command);
  }
  return r;
}

TEST(FreeRun, StaysOnTheRecordWhereModelAndPlantAreTheSame) {
  const auto rig = test::QuietFlexibleRotor();
  for (const double speed_rad_per_s : {0.0, 300.0}) {
    const auto recording = RecordOf(rig, speed_rad_per_s, {0, 2});
    const FreeRun run = RunFree(rig, test::FlexibleRotorLaw(), recording, {});
    ASSERT_EQ(run.segments.size(), 2U);
    EXPECT_TRUE(run.finite);
    // What is left of the two starts; the least damped mode loses e^-20 of it in 2 s.
    EXPECT_GT(run.segments[0].fit_percent[0], 99.0) << speed_rad_per_s;
    EXPECT_GT(run.segments[1].fit_percent[2], 99.0) << speed_rad_per_s;
  }
}

TEST(FreeRun, LeavesTheRecordWhereTheMagnetsAreOthers) {
  const auto truth = test::QuietFlexibleRotor();
  auto model = truth;
  for (auto& bearing : model.bearings) bearing.magnet.force_constant_n_m2_per_a2 *= 1.2;
  const auto recording = RecordOf(truth, 0.0, {0});
  const FreeRun right = RunFree(truth, test::FlexibleRotorLaw(), recording, {});
  const FreeRun wrong = RunFree(model, test::FlexibleRotorLaw(), recording, {});
  EXPECT_GT(right.fit_percent[0], 99.0);
  EXPECT_LT(wrong.fit_percent[0], 95.0);  // a fifth more force moves it otherwise by some per cent
}

TEST(FreeRun, CutsTheRecordWhereAnotherAxisIsExcited) {
  const auto recording = RecordOf(test::QuietFlexibleRotor(), 0.0, {1, 3});
  const auto segments = ExcitedSegments(recording);
  ASSERT_EQ(segments.size(), 2U);
  EXPECT_EQ(segments[0].excited, std::vector<std::size_t>{1});
  EXPECT_EQ(segments[1].excited, std::vector<std::size_t>{3});
  EXPECT_EQ(segments[0].rows.begin, kQuiet);
  EXPECT_EQ(segments[0].rows.end, kQuiet + kSignal + 1000);  // kTailS
  EXPECT_EQ(segments[1].rows.begin, kQuiet + kSignal + kPause);
}

TEST(FreeRun, SaysThatThereIsNoTestSignal) {
  const auto recording = RecordOf(test::QuietFlexibleRotor(), 0.0, {});
  EXPECT_THROW(RefuseUnexcited(recording), BadInput);
  EXPECT_NO_THROW(RefuseUnexcited(RecordOf(test::QuietFlexibleRotor(), 0.0, {0})));
}

}  // namespace
}  // namespace levitas::analysis
