// The verdict of a recorded session: the sensitivity that it measures in its one pass is that of
// the whole session, loaded for it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "controller/scenario/prbs.hpp"
#include "session/exchange/recording.hpp"
#include "tests/replay/session/recorded_run.hpp"
#include "tests/support/scratch_folder.hpp"
#include "verdict/commission.hpp"

namespace levitas::verdict {
namespace {

using session::testing::RecordedRun;
using session::testing::ShippedHeader;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// The reference gains keep the far end at its current limit by noise alone: no record to measure.
configuration::ControllerFile Commissioned() {
  return configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"),
      levitas::test::ShippedRig().numbers);
}

/// Five periods of a PRBS on the current of one axis, of `axes` at once.
void Excite(RecordedRun& run, const std::vector<std::size_t>& axes) {
  constexpr int kOrder = 12;
  scenario::Prbs sequence(kOrder);
  for (int i = 0; i < 5 * ((1 << kOrder) - 1); ++i) {
    const double value_a = sequence.Next() ? 0.1 : -0.1;
    run.Step([&](cycle::CycleInputs& in) {
      for (const std::size_t axis : axes) in.op.excitation_a[axis] = value_a;
    });
  }
}

/// A rotor that lies, is lifted, excited as `excite` says, and landed.
template <class Excitation>
std::string Session(const levitas::test::ScratchFolder& folder, const Excitation& excite) {
  RecordedRun run(3, levitas::test::CommissionedCycle());
  run.Run(200);
  run.Command(OperatorCommand::kLift);
  EXPECT_TRUE(run.RunUntil(Mode::kLevitating, 30'000));
  run.Run(8000);
  excite(run);
  run.Run(500);
  const std::string path = folder / "run.lcmlog";
  session::SessionHeader header = ShippedHeader();
  header.controller_yaml =
      configuration::WriteController(Commissioned(), levitas::test::ShippedRig().numbers);
  session::testing::WriteSession(path, run.records, header);
  return path;
}

Verdict Of(const std::string& path) {
  CommissionOptions options;
  options.session_path = path;
  return Commission(options);
}

TEST(Commission, MeasuresTheSensitivityOfTheWholeSession) {
  const levitas::test::ScratchFolder folder;
  const std::string path = Session(folder, [](RecordedRun& run) {
    for (std::size_t axis = 0; axis < 4; ++axis) Excite(run, {axis});
  });
  const Verdict verdict = Of(path);
  ASSERT_TRUE(verdict.inputs.measured);
  const MeasuredSensitivity& found = *verdict.inputs.measured;
  const auto& rig = levitas::test::ShippedRig();
  const MeasuredSensitivity whole = MeasureSensitivity(
      session::LoadRecording(path, rig), rig, Commissioned().law, verdict.inputs.sensitivity);
  EXPECT_EQ(found.why_not, "");
  ASSERT_THAT(found.speeds, SizeIs(1));
  ASSERT_THAT(whole.speeds, SizeIs(1));
  ASSERT_THAT(found.speeds[0].axes, SizeIs(4));
  for (std::size_t axis = 0; axis < 4; ++axis) {
    EXPECT_EQ(found.speeds[0].axes[axis].peak, whole.speeds[0].axes[axis].peak) << axis;
    EXPECT_EQ(found.speeds[0].axes[axis].sigma, whole.speeds[0].axes[axis].sigma) << axis;
    EXPECT_GT(found.speeds[0].axes[axis].peak, 1.0) << axis;
  }
}

TEST(Commission, RefusesWithTheSameWordsAndTimesAsAWholeRecording) {
  const levitas::test::ScratchFolder folder;
  const std::string path = Session(folder, [](RecordedRun& run) { Excite(run, {0, 1}); });
  const Verdict verdict = Of(path);
  ASSERT_TRUE(verdict.inputs.measured);
  const auto& rig = levitas::test::ShippedRig();
  const MeasuredSensitivity whole = MeasureSensitivity(
      session::LoadRecording(path, rig), rig, Commissioned().law, verdict.inputs.sensitivity);
  EXPECT_THAT(whole.why_not, HasSubstr("together"));
  EXPECT_EQ(verdict.inputs.measured->why_not, whole.why_not);
}

TEST(Commission, MeasuresNothingWithoutATestSignal) {
  const levitas::test::ScratchFolder folder;
  const std::string path = Session(folder, [](RecordedRun&) {});
  EXPECT_FALSE(Of(path).inputs.measured);
}

}  // namespace
}  // namespace levitas::verdict
