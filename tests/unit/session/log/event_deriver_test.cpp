#include "session/log/event_deriver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Deriver : public ::testing::Test {
 protected:
  cycle::CycleRecord Quiet(std::uint64_t cycle) { return DrawRecord(draw_, cycle); }
  std::vector<Event> Step(const cycle::CycleRecord& record) {
    std::vector<Event> events;
    deriver_.Step(record, events);
    return events;
  }
  void SetUp() override { Step(Quiet(0)); }

  Random draw_{5};
  EventDeriver deriver_{Header().channels, Header().period_ns};
};

TEST_F(Deriver, TellsNothingWhileNothingHappens) {
  for (std::uint64_t cycle = 1; cycle < 100; ++cycle) EXPECT_TRUE(Step(Quiet(cycle)).empty());
}

TEST_F(Deriver, TellsAModeChangeOnce) {
  auto record = Quiet(1);
  record.out.mode = Mode::kSpinning;
  const auto events = Step(record);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "levitating -> spinning (cycle 1)");
  EXPECT_EQ(events[0].severity, Event::Severity::kInformation);
  EXPECT_EQ(events[0].cycle, 1U);
  record.in.cycle = 2;
  EXPECT_TRUE(Step(record).empty());
}

TEST_F(Deriver, TellsALawThatTakesOverWhileTheRotorIsHeldAndNoneThatALiftBegins) {
  std::uint64_t cycle = 1;
  const auto step = [&](std::uint8_t law, bool held) {
    auto record = Quiet(cycle++);
    record.out.acting_law = law;
    record.out.current.amplifiers_enabled = held;
    return Step(record);
  };
  (void)step(0, true);
  const auto up = step(1, true);
  ASSERT_EQ(up.size(), 1U);
  EXPECT_THAT(up[0].text, ::testing::StartsWith("law 2 of the schedule takes over from law 1 at "));
  EXPECT_EQ(up[0].severity, Event::Severity::kInformation);
  EXPECT_TRUE(step(1, true).empty());
  EXPECT_EQ(step(0, true).size(), 1U);
  (void)step(1, true);
  EXPECT_TRUE(step(1, false).empty());
  EXPECT_TRUE(step(0, true).empty());  // lifted anew, from rest
}

TEST_F(Deriver, TellsABlockOfSynchronousControlThatBeginsAndWhyItEnds) {
  EventDeriver deriver(Header().channels, Header().period_ns, {{"unbalance"}});
  std::uint64_t cycle = 0;
  const auto step = [&](synchronous::BlockState state, synchronous::Ending ending) {
    auto record = Quiet(cycle++);
    record.out.synchronous_blocks = 1;
    record.out.synchronous[0] = {state, ending, 0.0};
    std::vector<Event> events;
    deriver.Step(record, events);
    return events;
  };
  using synchronous::BlockState;
  using synchronous::Ending;
  (void)step(BlockState::kOff, Ending::kNone);  // the first record tells its mode
  const auto begins = step(BlockState::kActing, Ending::kNone);
  ASSERT_EQ(begins.size(), 1U);
  EXPECT_THAT(begins[0].text, ::testing::StartsWith("synchronous control unbalance begins at "));
  EXPECT_EQ(begins[0].severity, Event::Severity::kInformation);
  EXPECT_TRUE(step(BlockState::kActing, Ending::kNone).empty());
  const auto ends = step(BlockState::kFading, Ending::kAngleJumped);
  ASSERT_EQ(ends.size(), 1U);
  EXPECT_THAT(ends[0].text, HasSubstr("the rotor's angle jumped"));
  EXPECT_EQ(ends[0].severity, Event::Severity::kWarning);
  EXPECT_TRUE(step(BlockState::kOff, Ending::kAngleJumped).empty());
  (void)step(BlockState::kActing, Ending::kAngleJumped);
  const auto planned = step(BlockState::kFading, Ending::kSpeed);
  ASSERT_EQ(planned.size(), 1U);
  EXPECT_EQ(planned[0].severity, Event::Severity::kInformation);
}

TEST_F(Deriver, TellsATripOnceWithCauseChannelValueLimitCycleSafeStateAndReset) {
  auto record = Quiet(1);
  record.out.mode = Mode::kTripped;
  record.out.fault = Fault::kOrbitExceeded;
  record.out.fault_axis = 2;
  record.out.fault_value = 152.5e-6;
  record.out.fault_limit = 142.5e-6;
  record.out.current.amplifiers_enabled = true;
  record.out.current.drive_enabled = true;
  const auto events = Step(record);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].severity, Event::Severity::kTrip);
  EXPECT_EQ(events[0].fault, Fault::kOrbitExceeded);
  EXPECT_EQ(events[0].value, 152.5e-6);
  EXPECT_THAT(events[0].text,
              AllOf(HasSubstr("TRIP orbit_exceeded"), HasSubstr("nde_x"), HasSubstr("152.5 um"),
                    HasSubstr("allowed 142.5 um"), HasSubstr("cycle 1"),
                    HasSubstr("stays levitated while the drive brakes"), HasSubstr("reset")));
  record.in.cycle = 2;
  EXPECT_TRUE(Step(record).empty());
}

TEST_F(Deriver, TripTextSaysWhenTheCoilsAreOff) {
  auto record = Quiet(1);
  record.out.fault = Fault::kSensorNotFinite;
  record.out.fault_axis = 0;
  record.out.current.amplifiers_enabled = false;
  EXPECT_THAT(
      TripText(record, Header().channels),
      AllOf(HasSubstr("de_x"), HasSubstr("coils are switched off"), Not(HasSubstr("allowed"))));
}

TEST(TripText, HasASentenceForEveryFault) {
  Random draw{6};
  auto record = DrawRecord(draw, 1);
  for (int fault = 1; fault < kFaultCount; ++fault) {
    record.out.fault = static_cast<Fault>(fault);
    const std::string text = TripText(record, Header().channels);
    EXPECT_THAT(text, Not(HasSubstr("no fault"))) << fault;
    EXPECT_THAT(text, Not(HasSubstr("unknown fault"))) << fault;
  }
  record.out.fault = static_cast<Fault>(kFaultCount);
  record.out.fault_axis = 7;
  EXPECT_THAT(TripText(record, Header().channels),
              AllOf(HasSubstr("unknown fault"), HasSubstr("axis 7")));
}

TEST_F(Deriver, TellsCommandsAndRefusals) {
  auto record = Quiet(1);
  record.in.op.command = OperatorCommand::kSpin;
  record.in.op.speed_rad_per_s = 314.159265358979;  // 3000 rpm
  EXPECT_EQ(Step(record)[0].text, "command spin to 3000 rpm (cycle 1)");
  record.in.cycle = 2;
  record.out.command_refused = true;
  const auto events = Step(record);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, "command spin refused in mode levitating (cycle 2)");
  EXPECT_EQ(events[0].severity, Event::Severity::kWarning);
}

TEST_F(Deriver, WarnsOnceOfARotorThatTurnsWhileTheAmplifiersAreOff) {
  auto record = Quiet(1);
  record.out.mode = Mode::kOff;
  record.in.frame.speed_rad_per_s = 314.159265358979;  // 3000 rpm
  record.out.current.drive_enabled = false;
  EXPECT_EQ(Step(record).size(), 1U) << "the change of mode alone";
  record.in.cycle = 2;
  record.out.current.drive_enabled = true;
  const auto events = Step(record);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].severity, Event::Severity::kWarning);
  EXPECT_THAT(events[0].text, AllOf(HasSubstr("3000 rpm"), HasSubstr("lift is refused")));
  record.in.cycle = 3;
  EXPECT_TRUE(Step(record).empty());
}

TEST_F(Deriver, TellsARestartOfTheRig) {
  auto record = Quiet(1);
  record.in.frame.rig_session ^= 1U;
  const auto events = Step(record);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_THAT(events[0].text, HasSubstr("rig restarted"));
}

TEST_F(Deriver, TellsRecordsLostBeforeThisOne) {
  const auto events = Step(Quiet(8));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_THAT(events[0].text, HasSubstr("7 record(s) lost"));
  EXPECT_THAT(events[0].text, HasSubstr("the first in cycle 1"));
}

TEST_F(Deriver, SumsUpLostRecordsToOneEventASecond) {
  std::vector<std::string> texts;
  for (std::uint64_t cycle = 2; cycle <= 15'000; cycle += 2) {  // every other record is lost
    for (const Event& event : Step(Quiet(cycle))) texts.push_back(event.text);
  }
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_THAT(texts[0], ::testing::AllOf(::testing::StartsWith("1 record(s) lost"),
                                         ::testing::EndsWith("the first in cycle 1")));
  EXPECT_THAT(texts[1], ::testing::AllOf(::testing::StartsWith("5000 record(s) lost"),
                                         ::testing::EndsWith("the first in cycle 3")));
}

TEST_F(Deriver, SumsUpMissingFramesToOneEventASecond) {
  std::vector<std::string> texts;
  std::uint64_t cycle = 1;
  for (; cycle <= 15'000; ++cycle) {  // 1.5 s of every other frame missing
    auto record = Quiet(cycle);
    record.in.frame_present = cycle % 2 == 0;
    for (const Event& event : Step(record)) texts.push_back(event.text);
  }
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0], "1 cycle(s) without a new sensor frame, the first in cycle 1");
  EXPECT_EQ(texts[1], "5000 cycle(s) without a new sensor frame, the first in cycle 3");
  std::vector<Event> rest;
  deriver_.Finish(rest);
  ASSERT_EQ(rest.size(), 1U);  // 7500 missing in all
  EXPECT_EQ(rest[0].text, "2499 cycle(s) without a new sensor frame, the first in cycle 10003");
}

TEST_F(Deriver, TellsMissedDeadlinesWithTheirNumber) {
  auto record = Quiet(1);
  record.in.missed_deadlines = 3;
  EXPECT_THAT(Step(record)[0].text, HasSubstr("3 period(s) skipped"));
}

TEST(Deriver0, DoesNotCallTheWaitForTheFirstFrameMissingFrames) {
  EventDeriver deriver(Header().channels, Header().period_ns);
  std::vector<Event> events;
  cycle::CycleRecord record;
  for (std::uint64_t cycle = 0; cycle < 50; ++cycle) {
    record.in.cycle = cycle;
    deriver.Step(record, events);
  }
  EXPECT_TRUE(events.empty());
}

}  // namespace
}  // namespace levitas::session
