// What events tell a person: every fault, mode change and command in its own words, and nothing
// forgotten or told twice over random runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "common/rotational_speed.hpp"
#include "session/log/event_deriver.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

cycle::CycleRecord Quiet(std::uint64_t cycle) {
  Random draw{cycle};
  return DrawRecord(draw, cycle);
}

std::vector<Event> Step(EventDeriver& deriver, const cycle::CycleRecord& record) {
  std::vector<Event> events;
  deriver.Step(record, events);
  return events;
}

EventDeriver NewDeriver() { return {Header().channels, Header().period_ns}; }

/// A fault with SI figures, and the words a person must find.
struct Told {
  Fault fault;
  int axis;
  double value;
  double limit;
  const char* cause;
  const char* numbers;  ///< value and limit with unit; empty where a number says nothing
};

const Told kTold[] = {
    {Fault::kOrbitExceeded, 0, 150e-6, 114e-6, "orbit", ": 150 um, allowed 114 um."},
    {Fault::kSensorOutOfRange, 1, -390e-6, 380e-6, "out of its range",
     ": -390 um, allowed 380 um."},
    {Fault::kSensorFrozen, 2, 20.0, 20.0, "frozen", ": 20 equal readings, allowed 20 equal"},
    {Fault::kSensorNotFinite, 3, 0.0, 380e-6, "no number", ""},
    {Fault::kFrameMissing, -1, 10.0, 10.0, "frames are missing", ": 10 cycles, allowed 10 cycles."},
    {Fault::kDeadlineMissed, -1, 7.0, 5.0, "deadlines", ": 7 periods, allowed 5 periods."},
    {Fault::kCoilSaturated, 3, 0.25, 0.05, "at its limit", ": 0.25 s, allowed 0.05 s."},
    {Fault::kOverSpeed, -1, RpmToRadPerS(6660.0), RpmToRadPerS(6600.0), "too fast",
     ": 6660 rpm, allowed 6600 rpm."},
    {Fault::kEmergencyStop, -1, 1.0, 0.0, "emergency stop", ""},
    {Fault::kRigRestarted, -1, 2.0, 1.0, "restarted", ""},
    {Fault::kAmplifierFault, -1, 1.0, 0.0, "amplifier reports a fault", ""},
    {Fault::kAmplifierFault, -1, 50.0, 50.0, "amplifiers do not report that they are on",
     ": 50 cycles in a row, allowed 50 cycles"},
    {Fault::kSelfTestFailed, 2, 240e-6, 237.5e-6, "self-test", ": 240 um, allowed 237.5 um."},
    {Fault::kSelfTestFailed, -1, RpmToRadPerS(30.0), RpmToRadPerS(10.0), "rotor turns",
     ": 30 rpm, allowed 10 rpm."},
    {Fault::kLiftFailed, 0, 50e-6, 20e-6, "did not reach the centre", ": 50 um, allowed 20 um."},
    {Fault::kSpeedUnknown, -1, 1.0, 0.0, "speed is not known", ""},
    {Fault::kSpeedUnknown, -1, 0.0, RpmToRadPerS(2500.0), "contradicts what the drive can do",
     ": 0 rpm, allowed 2500 rpm."},
    {Fault::kFramesLost, -1, 30.0, 30.0, "frames were lost", ": 30 cycles, allowed 30 cycles."},
    {Fault::kCurrentsLate, -1, 18.0, 18.0, "currents came late",
     ": 18 periods, allowed 18 periods."},
    {Fault::kLawNotFinite, 1, 0.0, 1.0, "law gives no number", ""},
};

TEST(TripText, TellsEveryFaultWithCauseChannelFiguresUnitAndRemedy) {
  std::set<std::string> causes;
  std::set<Fault> faults;
  for (const Told& told : kTold) {
    cycle::CycleRecord record = Quiet(4711);
    record.out.fault = told.fault;
    record.out.fault_axis = static_cast<std::int8_t>(told.axis);
    record.out.fault_value = told.value;
    record.out.fault_limit = told.limit;
    const std::string text = TripText(record, Header().channels);
    EXPECT_THAT(text, StartsWith("TRIP " + std::string(Name(told.fault)) + " in cycle 4711: "));
    EXPECT_THAT(text, HasSubstr(told.cause));
    EXPECT_THAT(text, HasSubstr(told.numbers));
    if (*told.numbers == '\0') {
      EXPECT_THAT(text, Not(HasSubstr("allowed")));
    }
    if (told.axis >= 0) {
      EXPECT_THAT(text, HasSubstr(" on " + Header().channels[static_cast<std::size_t>(told.axis)]));
    } else {
      EXPECT_THAT(text, Not(HasSubstr(" on de_")));
    }
    EXPECT_THAT(text, EndsWith("When it stands and the cause is gone, give the command reset."));
    EXPECT_THAT(text, Not(HasSubstr("\n")));
    causes.insert(text.substr(0, text.find('.')));
    faults.insert(told.fault);
  }
  EXPECT_EQ(causes.size(), std::size(kTold)) << "two faults are told in the same words";
  EXPECT_EQ(faults.size(), kFaultCount - 1U) << "a fault is not in the table of this test";
}

TEST(TripText, PointsToDoctorWhereTheMachineMayHaveBeenLate) {
  cycle::CycleRecord record = Quiet(4711);
  for (int fault = 1; fault < kFaultCount; ++fault) {
    record.out.fault = static_cast<Fault>(fault);
    const bool of_time =
        record.out.fault == Fault::kFrameMissing || record.out.fault == Fault::kDeadlineMissed ||
        record.out.fault == Fault::kFramesLost || record.out.fault == Fault::kCurrentsLate;
    EXPECT_EQ(TripText(record, {}).find("amb doctor") != std::string::npos, of_time)
        << Name(record.out.fault);
  }
}

TEST(TripText, SaysWhichSafeStateTheCoilsAndTheDriveAreIn) {
  cycle::CycleRecord record = Quiet(1);
  record.out.fault = Fault::kEmergencyStop;
  CurrentFrame& current = record.out.current;
  current.amplifiers_enabled = current.drive_enabled = true;
  EXPECT_THAT(TripText(record, {}), HasSubstr("levitated while the drive brakes"));
  current.drive_enabled = false;
  EXPECT_THAT(TripText(record, {}), HasSubstr("levitated and is lowered"));
  for (const bool drive : {false, true}) {
    current.amplifiers_enabled = false;
    current.drive_enabled = drive;
    EXPECT_THAT(TripText(record, {}), HasSubstr("coils are switched off"));
  }
}

TEST(EventDeriver, TellsEveryChangeOfModeInWordsOfItsOwn) {
  std::set<std::string> sentences;
  for (std::uint8_t from = 0; from < kModeCount; ++from) {
    for (std::uint8_t to = 0; to < kModeCount; ++to) {
      EventDeriver deriver = NewDeriver();
      cycle::CycleRecord record = Quiet(10);
      record.out.mode = static_cast<Mode>(from);
      (void)Step(deriver, record);
      record = Quiet(11);
      record.out.mode = static_cast<Mode>(to);
      record.out.current.drive_enabled = false;  // in off it would brake a turning rotor
      const auto events = Step(deriver, record);
      ASSERT_EQ(events.size(), from == to ? 0U : 1U);
      if (events.empty()) continue;
      EXPECT_THAT(events[0].text, StartsWith(std::string(Name(static_cast<Mode>(from))) + " -> " +
                                             std::string(Name(static_cast<Mode>(to)))));
      EXPECT_EQ(events[0].mode, static_cast<Mode>(to));
      EXPECT_EQ(events[0].cycle, 11U);
      sentences.insert(events[0].text);
    }
  }
  EXPECT_EQ(sentences.size(), kModeCount * (kModeCount - 1U));
}

TEST(EventDeriver, NamesTheCommandAndTheModeThatRefusedIt) {
  std::set<std::string> sentences;
  for (std::uint8_t mode = 0; mode < kModeCount; ++mode) {
    for (std::uint8_t command = 1; command < kOperatorCommandCount; ++command) {
      EventDeriver deriver = NewDeriver();
      cycle::CycleRecord record = Quiet(1);
      record.out.mode = static_cast<Mode>(mode);
      (void)Step(deriver, record);
      record.in.cycle = 2;
      record.in.op.command = static_cast<OperatorCommand>(command);
      record.out.command_refused = true;
      const auto events = Step(deriver, record);
      ASSERT_EQ(events.size(), 1U);
      EXPECT_EQ(events[0].severity, Event::Severity::kWarning);
      EXPECT_THAT(events[0].text,
                  HasSubstr(std::string(Name(static_cast<OperatorCommand>(command)))));
      EXPECT_THAT(events[0].text, HasSubstr(std::string(Name(static_cast<Mode>(mode)))));
      sentences.insert(events[0].text);
    }
  }
  EXPECT_EQ(sentences.size(), kModeCount * (kOperatorCommandCount - 1U));
}

/// What a random run holds, counted beside the deriver.
struct Counted {
  std::uint64_t mode_changes{}, trips{}, refusals{}, missing_frames{}, skipped_periods{};
  bool operator==(const Counted&) const = default;
};

/// The count a summed-up event begins with.
std::uint64_t Leading(const std::string& text) {
  return std::isdigit(static_cast<unsigned char>(text[0])) != 0 ? std::stoull(text) : 0;
}

void CountTold(const std::vector<Event>& events, Counted& told) {
  for (const Event& event : events) {
    const auto says = [&](const char* words) {
      return event.text.find(words) != std::string::npos;
    };
    if (event.severity == Event::Severity::kTrip) ++told.trips;
    if (says(" -> ")) ++told.mode_changes;
    if (says(" refused in mode ")) ++told.refusals;
    if (says("without a new sensor frame")) told.missing_frames += Leading(event.text);
    if (says("period(s) skipped")) told.skipped_periods += Leading(event.text);
  }
}

TEST(EventDeriver, ForgetsNothingAndTellsNothingTwiceOverRandomRuns) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random draw{seed};
    EventDeriver deriver = NewDeriver();
    std::vector<Event> events;
    Counted happened;
    Mode mode = Mode::kOff;  // what a run begins with
    Fault fault = Fault::kNone;
    constexpr std::uint64_t kCycles = 30'000;  // 3 s
    for (std::uint64_t cycle = 0; cycle < kCycles; ++cycle) {
      cycle::CycleRecord record = Quiet(cycle);
      const Mode mode_before = mode;
      const Fault fault_before = fault;
      if (draw.Bits() % 500 == 0) mode = static_cast<Mode>(draw.Bits() % kModeCount);
      if (draw.Bits() % 3000 == 0) fault = static_cast<Fault>(draw.Bits() % kFaultCount);
      record.out.mode = mode;
      record.out.fault = fault;
      record.in.frame_present = draw.Bits() % 7 != 0;
      record.in.missed_deadlines = draw.Bits() % 100 == 0 ? draw.Bits() % 4 : 0;
      record.in.op.command = draw.Bits() % 400 == 0 ? OperatorCommand::kLand : OperatorCommand{};
      record.out.command_refused = record.in.op.command != OperatorCommand::kNone;
      deriver.Step(record, events);
      const bool tripped = fault != Fault::kNone && fault != fault_before;
      happened.trips += tripped ? 1 : 0;
      happened.mode_changes += mode != mode_before && !tripped ? 1 : 0;  // the trip tells its own
      happened.refusals += record.out.command_refused ? 1 : 0;
      happened.missing_frames += record.in.frame_present ? 0 : 1;
      happened.skipped_periods += record.in.missed_deadlines;
    }
    deriver.Finish(events);
    Counted told;
    CountTold(events, told);
    EXPECT_TRUE(told == happened) << "seed " << seed << ": modes " << told.mode_changes << "/"
                                  << happened.mode_changes << ", trips " << told.trips << "/"
                                  << happened.trips << ", frames " << told.missing_frames << "/"
                                  << happened.missing_frames << ", periods " << told.skipped_periods
                                  << "/" << happened.skipped_periods;
    // Summed up: one at the first, one a second for 3 s, one at the end; two kinds of them.
    const auto summed = std::count_if(events.begin(), events.end(),
                                      [](const Event& event) { return Leading(event.text) > 0; });
    EXPECT_LE(summed, 2 * 5);
  }
}

}  // namespace
}  // namespace levitas::session
