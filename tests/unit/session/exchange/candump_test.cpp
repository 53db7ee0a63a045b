// A log of candump becomes a session: what was on the bus, answer by answer, and one clear message
// for what is no such log.

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "common/problem.hpp"
#include "hil/can/codec.hpp"
#include "session/exchange/candump_import.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr double kStep = 20e-9;    // of a position on the bus: 16 bits over +-400 um
constexpr double kStepA = 0.1e-3;  // of a current

RigNumbers FourAxes() {
  RigNumbers rig;
  rig.name = "bench";
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  rig.bias_current_a = 1.0;
  rig.max_coil_current_a = 2.0;
  rig.sensor_range_m = 400e-6;
  rig.max_speed_rad_per_s = 600.0;
  return rig;
}

/// A line as candump -L writes it.
std::string Line(const can::WireFrame& frame, int number = 0) {
  std::string text =
      fmt::format("({:.6f}) can0 {:03X}{}", 1.0 + 1e-4 * number, frame.id, frame.fd ? "##1" : "#");
  for (const std::uint8_t byte : frame.payload()) text += fmt::format("{:02X}", byte);
  return text + "\n";
}

class Candump : public ::testing::Test {
 protected:
  /// Rig's positions of a cycle; each reading tells axis and cycle.
  std::string Positions(std::uint64_t cycle) {
    SensorFrame frame;
    frame.cycle = cycle;
    frame.rig_session = rig_session_;
    frame.axes = 4;
    frame.speed_rad_per_s = speed_rad_per_s_;
    for (std::size_t axis = 0; axis < 4; ++axis) frame.position_m[axis] = Position(axis, cycle);
    return Line(positions_.Encode(can::ValuesOf(frame)), static_cast<int>(cycle));
  }
  std::string Currents(std::uint64_t cycle, bool amplifiers = true) {
    CurrentFrame frame;
    frame.cycle = cycle;
    frame.axes = 4;
    frame.amplifiers_enabled = amplifiers;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      frame.control_current_a[axis] = Current(axis, cycle);
    }
    return Line(currents_.Encode(can::ValuesOf(frame, false)), static_cast<int>(cycle));
  }
  static double Position(std::size_t axis, std::uint64_t cycle) {
    return 1e-6 * static_cast<double>(axis) - 0.1e-6 * static_cast<double>(cycle);
  }
  static double Current(std::size_t axis, std::uint64_t cycle) {
    return 0.1 * static_cast<double>(axis) - 0.01 * static_cast<double>(cycle);
  }
  CandumpReport Import(const std::string& content) {
    WriteFile(log_, content);
    return ImportCandump({.data_path = log_,
                          .out_path = out_,
                          .rig = FourAxes(),
                          .rig_yaml = "name: bench\n",
                          .program_version = "0.1.0",
                          .start_utc_ns = 5},
                         layout_);
  }
  std::vector<cycle::CycleRecord> Records() {
    SessionReader reader(out_);
    return ReadAll(reader);
  }
  const can::Message& MessageOf(std::uint32_t id) {
    for (const can::Message& message : layout_.messages) {
      if (message.id == id) return message;
    }
    throw std::logic_error("no such message");
  }

  Folder folder_;
  std::string log_{folder_ / "run.log"};
  std::string out_{folder_ / "s.lcm"};
  can::Layout layout_{can::MakeLayout(FourAxes(), can::Format::kFd)};
  can::MessageCodec positions_{MessageOf(can::kPositionsId), can::Format::kFd};
  can::MessageCodec currents_{MessageOf(can::kCurrentsId), can::Format::kFd};
  std::uint32_t rig_session_{1};
  double speed_rad_per_s_{0.0};
};

TEST_F(Candump, EveryPositionFrameIsARecordWithTheCurrentsThatAnswerIt) {
  std::string log;
  for (std::uint64_t cycle = 0; cycle < 50; ++cycle) log += Positions(cycle) + Currents(cycle);
  const auto report = Import(log);
  EXPECT_EQ(report.records, 50U);
  EXPECT_EQ(report.without_answer, 0U);
  EXPECT_EQ(report.missing_cycles, 0U);
  const auto records = Records();
  ASSERT_EQ(records.size(), 50U);
  for (std::uint64_t cycle = 0; cycle < 50; ++cycle) {
    const auto& record = records[cycle];
    EXPECT_EQ(record.in.cycle, cycle);
    EXPECT_EQ(record.in.frame.sample_time_ns, static_cast<std::int64_t>(cycle) * 100'000);
    EXPECT_EQ(record.out.mode, Mode::kLevitating);
    for (std::size_t axis = 0; axis < 4; ++axis) {
      // Half a step of the bus, and a little for the decimal fractions.
      EXPECT_NEAR(record.in.frame.position_m[axis], Position(axis, cycle), 0.51 * kStep);
      EXPECT_NEAR(record.out.current.control_current_a[axis], Current(axis, cycle), 0.51 * kStepA);
    }
  }
}

TEST_F(Candump, CurrentsThatAnswerAnotherCycleAreNotTheAnswer) {
  // The controller is a cycle late throughout: no position frame is answered while it is newest.
  std::string log = Positions(0);
  for (std::uint64_t cycle = 1; cycle < 20; ++cycle) log += Positions(cycle) + Currents(cycle - 1);
  const auto report = Import(log);
  EXPECT_EQ(report.records, 20U);
  EXPECT_EQ(report.without_answer, 20U);
}

TEST_F(Candump, WithoutAnAnswerTheLastCurrentIsHeld) {
  Import(Positions(0) + Currents(0) + Positions(1) + Positions(2) + Currents(2));
  const auto records = Records();
  ASSERT_EQ(records.size(), 3U);
  EXPECT_NEAR(records[1].out.current.control_current_a[2], Current(2, 0), 0.51 * kStepA);
  EXPECT_NEAR(records[2].out.current.control_current_a[2], Current(2, 2), 0.51 * kStepA);
}

TEST_F(Candump, LostFramesLeaveTheirCyclesOut) {
  const auto report = Import(Positions(0) + Currents(0) + Positions(4) + Currents(4));
  EXPECT_EQ(report.missing_cycles, 3U);
  const auto records = Records();
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[1].in.cycle, 4U);
}

TEST_F(Candump, DamagedAndForeignLinesAreCountedAndLeftOut) {
  std::string damaged = Currents(0);
  char& digit = damaged[damaged.size() - 5];
  digit = digit == '0' ? '1' : '0';
  const auto report = Import(Positions(0) + damaged + "(1.0) can0 7FF#0102\n(1.0) can0 123#R\n" +
                             "(1.0) can0 20000004#0000000000000000\n" + Positions(1) + Currents(1));
  EXPECT_EQ(report.records, 2U);
  EXPECT_EQ(report.damaged, 1U);
  EXPECT_EQ(report.other_lines, 3U);
  EXPECT_EQ(report.without_answer, 1U);
}

TEST_F(Candump, TheModeIsOffWithoutAmplifiersAndSpinningWithRotation) {
  std::string log = Positions(0) + Currents(0, false);
  speed_rad_per_s_ = 100.0;
  log += Positions(1) + Currents(1);
  Import(log);
  const auto records = Records();
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].out.mode, Mode::kOff);
  EXPECT_EQ(records[1].out.mode, Mode::kSpinning);
}

TEST_F(Candump, ARigThatStartsAgainGoesOnInTime) {
  std::string log;
  for (std::uint64_t cycle = 0; cycle < 10; ++cycle) log += Positions(cycle) + Currents(cycle);
  rig_session_ = 2;
  for (std::uint64_t cycle = 0; cycle < 10; ++cycle) log += Positions(cycle) + Currents(cycle);
  const auto report = Import(log);
  EXPECT_EQ(report.rig_restarts, 1U);
  const auto records = Records();
  ASSERT_GE(records.size(), 15U);  // a restart is believed after some frames only
  for (std::size_t at = 1; at < records.size(); ++at) {
    EXPECT_GT(records[at].in.cycle, records[at - 1].in.cycle);
  }
}

TEST_F(Candump, WhatIsNoLogIsRefusedWithItsLineAndLeavesNothing) {
  for (const std::string bad :
       {"time_s,position\n", "(1.0) can0 110\n", "(1.0) can0 110##\n", "(1.0) can0 110##1ABC\n",
        "(1.0) can0 XYZ#00\n", "(1.0) can0 100#000102030405060708\n"}) {
    try {
      Import(Positions(0) + bad);
      ADD_FAILURE() << "accepted: " << bad;
    } catch (const BadInput& problem) {
      EXPECT_THAT(problem.what(), HasSubstr("run.log:2: ")) << bad;
    }
    EXPECT_FALSE(std::filesystem::exists(out_));
    EXPECT_FALSE(std::filesystem::exists(out_ + ".part"));
  }
}

TEST_F(Candump, ALogOfAnotherRigIsRefused) {
  try {
    Import("(1.0) can0 7FF#0102\n");
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("no position frame of this rig"));
  }
}

}  // namespace
}  // namespace levitas::session
