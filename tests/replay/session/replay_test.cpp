#include "session/replay/replay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "session/log/trip_freezer.hpp"
#include "tests/replay/session/recorded_run.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Replaying : public ::testing::Test {
 protected:
  static const std::vector<cycle::CycleRecord>& Records() {
    static const auto records = EventfulRun();
    return records;
  }
  ReplayReport ReplayOf(const std::vector<cycle::CycleRecord>& records,
                        const SessionHeader& header = ShippedHeader()) {
    WriteSession(path_, records, header);
    return ReplayFile();
  }
  ReplayReport ReplayFile() {
    SessionReader reader(path_);
    auto report = Replay(reader, RecordedConfig(reader.header(), path_), path_);
    damage_ = reader.damage();
    return report;
  }
  std::string Refusal(const std::string& path) {
    try {
      SessionReader reader(path);
      (void)Replay(reader, RecordedConfig(reader.header(), path), path);
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  }

  Folder folder_;
  std::string path_{folder_ / "s.lcmlog"};
  Damage damage_;
};

TEST_F(Replaying, ReproducesEveryOutputBitOfAnEventfulRun) {
  const auto& records = Records();
  const auto has = [&](auto what) { return std::any_of(records.begin(), records.end(), what); };
  ASSERT_TRUE(has([](const auto& r) { return r.out.command_refused; }));
  ASSERT_TRUE(has([](const auto& r) { return r.out.mode == Mode::kSpinning; }));
  ASSERT_TRUE(has([](const auto& r) { return r.out.fault == Fault::kSensorNotFinite; }));
  const ReplayReport report = ReplayOf(records);
  EXPECT_TRUE(report.identical()) << report.difference->field << " in cycle "
                                  << report.different_cycle;
  EXPECT_EQ(report.reproduced, records.size());
}

TEST_F(Replaying, ReproducesALawThatChangesWithTheSpeed) {
  auto controller = ShippedController();
  controller.law.schedule = {{RpmToRadPerS(600.0), controller.law.axes, {}}};
  for (law::AxisLawConfig& axis : controller.law.schedule[0].axes) axis.kd_a_s_per_m *= 1.2;
  const auto& rig = test::ShippedRig().numbers;
  const auto records = EventfulRun(
      {rig, controller.law, controller.supervisor, controller.synchronous, controller.bias});
  SessionHeader header = ShippedHeader();
  header.controller_yaml = configuration::WriteController(controller, rig);
  EXPECT_TRUE(ReplayOf(records, header).identical());
  // Its laws are not those of rest: the law at rest alone gives other currents once it turns.
  controller.law.schedule.clear();
  header.controller_yaml = configuration::WriteController(controller, rig);
  const ReplayReport fixed = ReplayOf(records, header);
  ASSERT_FALSE(fixed.identical());
  EXPECT_NE(records[fixed.different_cycle].in.frame.speed_rad_per_s, 0.0);
}

TEST_F(Replaying, ReproducesSynchronousControl) {
  auto controller = ShippedController();
  synchronous::BlockConfig& block = controller.synchronous.blocks.emplace_back();
  block.name = "unbalance";
  block.from_rad_per_s = RpmToRadPerS(100.0);
  block.to_rad_per_s = RpmToRadPerS(900.0);
  block.hysteresis_rad_per_s = RpmToRadPerS(30.0);
  block.adaptive = true;
  block.least_change_m = 1e-8;
  synchronous::InverseAtSpeed& at = block.inverse.emplace_back();
  at.speed_rad_per_s = RpmToRadPerS(500.0);
  for (std::size_t i = 0; i < 4; ++i) at.inverse.real[i][i] = -0.5;
  const auto& rig = test::ShippedRig().numbers;
  testing::RecordedRun run(
      3, {rig, controller.law, controller.supervisor, controller.synchronous, controller.bias});
  run.Command(OperatorCommand::kLift);
  ASSERT_TRUE(run.RunUntil(Mode::kLevitating, 30'000));
  run.Command(OperatorCommand::kSpin, 600.0, 1000.0);
  run.Run(25'000);  // ten turns come before the block
  const auto& records = run.records;
  const bool acted = std::ranges::any_of(records, [](const auto& r) {
    return r.out.synchronous[0].state == synchronous::BlockState::kActing &&
           r.out.synchronous[0].amplitude > 0.0;
  });
  ASSERT_TRUE(acted);
  SessionHeader header = ShippedHeader();
  header.controller_yaml = configuration::WriteController(controller, rig);
  EXPECT_TRUE(ReplayOf(records, header).identical());
  controller.synchronous = {};
  header.controller_yaml = configuration::WriteController(controller, rig);
  EXPECT_FALSE(ReplayOf(records, header).identical()) << "the block gave nothing";
}

TEST_F(Replaying, ReproducesABiasThatFalls) {
  auto controller = ShippedController();
  controller.bias.lowest_current_a = 0.2;
  controller.bias.largest_share = 0.95;
  for (law::AxisLawConfig& axis : controller.law.axes) {  // less of the probes' noise
    axis.derivative_hz *= 0.5;
    axis.kd_a_s_per_m *= 0.5;
  }
  const auto& rig = test::ShippedRig().numbers;
  testing::RecordedRun run(
      3, {rig, controller.law, controller.supervisor, controller.synchronous, controller.bias});
  run.Command(OperatorCommand::kLift);
  ASSERT_TRUE(run.RunUntil(Mode::kLevitating, 30'000));
  run.Run(30'000);
  const auto& records = run.records;
  ASSERT_LT(records.back().out.current.bias_current_a, 0.99 * rig.bias_current_a);
  SessionHeader header = ShippedHeader();
  header.controller_yaml = configuration::WriteController(controller, rig);
  EXPECT_TRUE(ReplayOf(records, header).identical());
  controller.bias = {};
  header.controller_yaml = configuration::WriteController(controller, rig);
  EXPECT_FALSE(ReplayOf(records, header).identical()) << "the bias never fell";
}

TEST_F(Replaying, NamesTheFirstDifferenceOfOneBit) {
  auto records = Records();
  const double recorded = records[9000].out.current.control_current_a[1];
  const double other = std::nextafter(recorded, 10.0);
  records[9000].out.current.control_current_a[1] = other;
  const ReplayReport report = ReplayOf(records);
  EXPECT_FALSE(report.identical());
  EXPECT_EQ(report.reproduced, 9000U);
  EXPECT_EQ(report.different_cycle, 9000U);
  ASSERT_TRUE(report.difference);
  EXPECT_EQ(report.difference->field, "control_current_a de_y");
  EXPECT_EQ(std::stod(report.difference->recorded), other);
  EXPECT_EQ(std::stod(report.difference->computed), recorded);
}

TEST_F(Replaying, DiffersWhenAnInputOrTheControllerWasAnother) {
  auto records = Records();
  records[8000].in.frame.position_m[0] += 1e-9;
  EXPECT_EQ(ReplayOf(records).different_cycle, 8000U);

  SessionHeader header = ShippedHeader();
  auto controller = ShippedController();
  controller.law.axes[3].ki_a_per_m_s *= 1.0 + 1e-12;
  header.controller_yaml = configuration::WriteController(controller, test::ShippedRig().numbers);
  const ReplayReport report = ReplayOf(Records(), header);
  EXPECT_FALSE(report.identical());
  EXPECT_THAT(report.difference->field, HasSubstr("nde_y"));
}

TEST_F(Replaying, EveryOutputFieldIsCompared) {
  const cycle::CycleOutputs same = Records()[9000].out;
  const auto& channels = ShippedHeader().channels;
  ASSERT_FALSE(FirstDifference(same, same, channels));
  const auto field = [&](auto change) {
    cycle::CycleOutputs other = same;
    change(other);
    const auto found = FirstDifference(same, other, channels);
    return found ? found->field : "nothing";
  };
  EXPECT_EQ(field([](auto& o) { o.mode = Mode::kLanding; }), "mode");
  EXPECT_EQ(field([](auto& o) { o.fault = Fault::kOverSpeed; }), "fault");
  EXPECT_EQ(field([](auto& o) { o.fault_axis = 3; }), "fault_axis");
  EXPECT_EQ(field([](auto& o) { o.fault_value = 1.0; }), "fault_value");
  EXPECT_EQ(field([](auto& o) { o.fault_limit = 1.0; }), "fault_limit");
  EXPECT_EQ(field([](auto& o) { o.command_refused = true; }), "command_refused");
  EXPECT_EQ(field([](auto& o) { o.reference_m[2] = -0.0; }), "reference_m nde_x");
  EXPECT_EQ(field([](auto& o) { o.current.control_current_a[3] += 1e-9; }),
            "control_current_a nde_y");
  EXPECT_EQ(field([](auto& o) { o.saturated_axes ^= 2U; }), "saturated_axes");
  EXPECT_EQ(field([](auto& o) { ++o.current.cycle; }), "current_cycle");
  EXPECT_EQ(field([](auto& o) { ++o.current.axes; }), "current_axes");
  EXPECT_EQ(field([](auto& o) { o.current.bias_current_a = 0.5; }), "bias_current_a");
  EXPECT_EQ(field([](auto& o) { o.current.speed_set_point_rad_per_s += 1.0; }),
            "speed_set_point_rad_per_s");
  EXPECT_EQ(field([](auto& o) { o.current.acceleration_limit_rad_per_s2 += 1.0; }),
            "acceleration_limit_rad_per_s2");
  EXPECT_EQ(field([](auto& o) { o.current.amplifiers_enabled ^= true; }), "amplifiers_enabled");
  EXPECT_EQ(field([](auto& o) { o.current.drive_enabled ^= true; }), "drive_enabled");
}

TEST_F(Replaying, EndsBeforeAGapAndSaysSo) {
  auto records = Records();
  records.erase(records.begin() + 7000, records.begin() + 7005);
  const ReplayReport report = ReplayOf(records);
  EXPECT_FALSE(report.identical());
  EXPECT_FALSE(report.difference);
  EXPECT_EQ(report.reproduced, 7000U);
  EXPECT_EQ(report.gap_cycle, 7000U);
  EXPECT_EQ(report.behind_gap, records.size() - 7000);
  EXPECT_EQ(damage_.missing_cycles, 5U);
}

TEST_F(Replaying, JudgesATruncatedSessionByWhatIsThere) {
  WriteSession(path_, Records(), ShippedHeader());
  const std::string content = ReadFile(path_);
  WriteFile(path_, content.substr(0, content.size() / 2));
  const ReplayReport report = ReplayFile();
  EXPECT_TRUE(report.identical());
  EXPECT_TRUE(damage_.truncated);
  EXPECT_GT(report.reproduced, Records().size() / 3);
}

TEST_F(Replaying, RefusesATripFileAndNamesTheWholeSession) {
  SessionHeader header = ShippedHeader();
  header.excerpt_of = "/runs/whole.lcmlog";
  TripFreezer freezer(folder_ / "", header, 0.5);
  for (const auto& record : Records()) {
    std::vector<Event> events;
    if (record.out.fault != Fault::kNone && freezer.newest().empty() && record.in.cycle > 5000) {
      Event trip;
      trip.severity = Event::Severity::kTrip;
      if (record.in.frame.position_m[2] != record.in.frame.position_m[2]) events.push_back(trip);
    }
    freezer.Take(record, events);
  }
  freezer.Finish();
  ASSERT_FALSE(freezer.newest().empty());
  EXPECT_THAT(Refusal(freezer.newest()),
              AllOf(HasSubstr("cut out of /runs/whole.lcmlog"), HasSubstr("amb export")));
}

TEST_F(Replaying, RefusesWhatItCannotJudgeWithTheReason) {
  const std::vector<cycle::CycleRecord> tail(Records().begin() + 50, Records().begin() + 60);
  WriteSession(path_, tail, ShippedHeader());
  EXPECT_THAT(Refusal(path_), HasSubstr("its first readable cycle is 50"));

  WriteSession(path_, {}, ShippedHeader());
  EXPECT_THAT(Refusal(path_), HasSubstr("holds no cycle"));

  SessionHeader imported = ShippedHeader();
  imported.controller_yaml.clear();
  imported.pace = "imported";
  WriteSession(path_, tail, imported);
  EXPECT_THAT(Refusal(path_), AllOf(HasSubstr("holds no controller"), HasSubstr("--controller")));

  SessionHeader broken = ShippedHeader();
  broken.rig_yaml = "kind: rig\nname: [";
  WriteSession(path_, tail, broken);
  EXPECT_THAT(Refusal(path_), HasSubstr("(its rig)"));
}

}  // namespace
}  // namespace levitas::session
