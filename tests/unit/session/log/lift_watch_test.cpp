// A lift that failed says why: no force left, sag, or swinging; each only where it is so.

#include "session/log/lift_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "session/log/event_deriver.hpp"

namespace levitas::session {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kLiftPeriodS = 1e-4;
constexpr std::int64_t kLiftPeriodNs = 100'000;
const std::vector<std::string> kLiftChannels{"de_x", "de_y", "nde_x", "nde_y"};

/// How bearing "nde" is lifted from (-90, -120) um: where it hangs at the end, how far it swings.
struct Lifting {
  double hangs_um{};  ///< along its y axis, to the negative side
  double swings_um{};
  bool limited{};
  double change_hz{};  ///< of the current from one limit to the other; 0: it stays at one
};

/// The record of one cycle of the lift.
cycle::CycleRecord LiftCycle(const Lifting& lifting, std::uint64_t cycle) {
  cycle::CycleRecord record;
  record.in.cycle = cycle;
  record.in.frame_present = true;
  record.in.frame.axes = 4;
  record.out.mode = Mode::kLift;
  const double time_s = static_cast<double>(cycle) * kLiftPeriodS;
  const double left = std::exp(-time_s / 0.05);  // of the way to the centre
  record.in.frame.position_m[2] =
      1e-6 * (-90.0 * left + lifting.swings_um * std::cos(2.0 * 3.14159265358979 * 80.0 * time_s));
  record.in.frame.position_m[3] = 1e-6 * (-120.0 * left - lifting.hangs_um * (1.0 - left));
  const bool other = std::fmod(time_s * lifting.change_hz, 1.0) >= 0.5;
  record.out.current.control_current_a[3] = other ? -0.5 : 0.5;
  record.out.saturated_axes = lifting.limited ? 0b1000 : 0;
  return record;
}

/// What a person is told when the lift is given up after two seconds.
std::string TripAfter(const Lifting& lifting) {
  EventDeriver deriver(kLiftChannels, kLiftPeriodNs);
  std::vector<Event> events;
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    deriver.Step(LiftCycle(lifting, cycle), events);
  }
  cycle::CycleRecord trip = LiftCycle(lifting, 20'000);
  trip.out = {};
  trip.out.mode = Mode::kTripped;
  trip.out.fault = Fault::kLiftFailed;
  trip.out.fault_axis = 3;
  trip.out.fault_value = 1e-6 * std::hypot(lifting.hangs_um, lifting.swings_um);
  trip.out.fault_limit = 30e-6;
  deriver.Step(trip, events);
  return events.back().text;
}

/// The same where nde_y is at its limit for 50 ms; `levitated`: after the lift, not in it.
std::string SaturatedAfter(const Lifting& lifting, bool levitated) {
  EventDeriver deriver(kLiftChannels, kLiftPeriodNs);
  std::vector<Event> events;
  for (std::uint64_t cycle = 0; cycle < 2'500; ++cycle) {
    Lifting now = lifting;
    now.limited = cycle >= 2'000;
    cycle::CycleRecord record = LiftCycle(now, cycle);
    if (levitated && cycle >= 1'000) record.out.mode = Mode::kLevitating;
    deriver.Step(record, events);
  }
  cycle::CycleRecord trip = LiftCycle(lifting, 2'500);
  trip.out = {};
  trip.out.mode = Mode::kTripped;
  trip.out.fault = Fault::kCoilSaturated;
  trip.out.fault_axis = 3;
  trip.out.fault_value = trip.out.fault_limit = 0.05;
  deriver.Step(trip, events);
  return events.back().text;
}

TEST(LiftWatch, ACurrentAtItsLimitInALiftNamesWhatMayBeTheWrongWayRound) {
  const std::string wrong_way = "a probe or a coil is the wrong way round";
  EXPECT_THAT(SaturatedAfter({.hangs_um = 150}, false),
              AllOf(HasSubstr("coil_saturated"), HasSubstr(wrong_way)));
  EXPECT_THAT(SaturatedAfter({.hangs_um = 150, .change_hz = 80}, false),
              AllOf(HasSubstr("the loop is unstable"), Not(HasSubstr(wrong_way))));
  EXPECT_THAT(SaturatedAfter({.hangs_um = 150}, true),
              AllOf(HasSubstr("coil_saturated"), Not(HasSubstr(wrong_way))));
}

TEST(LiftWatch, ARotorThatHangsBesideTheCentreSagsWithItsFiguresAndARemedy) {
  const std::string text = TripAfter({.hangs_um = 47.0});
  EXPECT_THAT(text, AllOf(HasSubstr("It sags: from where it lay, 150 um off the centre, it came to "
                                    "47 um, the settle radius is 30 um"),
                          HasSubstr("0.5 A, below its limit"), HasSubstr("Raise ki"),
                          HasSubstr("raise settle_radius_um")));
}

TEST(LiftWatch, ACurrentThatGoesFromLimitToLimitIsTheLoopAndNoLoad) {
  const Lifting unstable{.swings_um = 200.0, .limited = true, .change_hz = 60.0};
  EXPECT_THAT(TripAfter(unstable),
              AllOf(HasSubstr("the loop is unstable"), HasSubstr("amb design pid"),
                    Not(HasSubstr("more than the magnets lift"))));
  Lifting heavy = unstable;
  heavy.change_hz = 0.0;
  EXPECT_THAT(TripAfter(heavy), AllOf(HasSubstr("more than the magnets lift"),
                                      Not(HasSubstr("the loop is unstable"))));
}

TEST(LiftWatch, ARotorThatHardlyLeftItsRestingPlaceIsNotAdvisedToHangThere) {
  const std::string text = TripAfter({.hangs_um = 140.0});
  EXPECT_THAT(text, AllOf(HasSubstr("it came to 140 um"), Not(HasSubstr("settle_radius_um"))));
}

TEST(LiftWatch, ARotorThatSwingsAboutTheCentreDoesNotSag) {
  const std::string text = TripAfter({.hangs_um = 5.0, .swings_um = 40.0});
  EXPECT_THAT(text, AllOf(HasSubstr("It does not sag"), HasSubstr("swings"), HasSubstr("kd")));
  EXPECT_THAT(text, Not(HasSubstr("It sags")));
}

// The same place: with the current at its limit more gain would change nothing.
TEST(LiftWatch, ACurrentAtItsLimitIsTheReasonBeforeTheSag) {
  const std::string text = TripAfter({.hangs_um = 47.0, .limited = true});
  EXPECT_THAT(text, AllOf(HasSubstr("The control current is at its limit"), HasSubstr("47 um off"),
                          Not(HasSubstr("It sags")), Not(HasSubstr("Raise ki"))));
}

TEST(LiftWatch, SaysNothingOfALiftThatItHasNotSeen) {
  cycle::CycleRecord trip = LiftCycle({.hangs_um = 47.0}, 5);
  trip.out.fault = Fault::kLiftFailed;
  trip.out.fault_axis = 3;
  const LiftWatch unseen(kLiftPeriodS);
  EXPECT_EQ(unseen.ReasonOf(3, 30e-6), LiftReason::kUnknown);
  EXPECT_EQ(TripText(trip, kLiftChannels, &unseen), TripText(trip, kLiftChannels));
}

TEST(LiftWatch, ForgetsTheLiftBeforeAtTheNextSelfTest) {
  LiftWatch watch(kLiftPeriodS);
  for (std::uint64_t cycle = 0; cycle < 100; ++cycle)
    watch.Add(LiftCycle({.limited = true}, cycle));
  EXPECT_EQ(watch.ReasonOf(3, 30e-6), LiftReason::kAtLimit);
  cycle::CycleRecord tested = LiftCycle({}, 100);
  tested.out.mode = Mode::kSelfTest;
  watch.Add(tested);
  EXPECT_EQ(watch.ReasonOf(3, 30e-6), LiftReason::kUnknown);
}

TEST(LiftWatch, TakesNoReadingThatIsNoNumber) {
  LiftWatch watch(kLiftPeriodS);
  for (std::uint64_t cycle = 0; cycle < 20'000; ++cycle) {
    cycle::CycleRecord record = LiftCycle({.hangs_um = 47.0}, cycle);
    if (cycle % 7 == 3) record.in.frame.position_m[3] = std::numeric_limits<double>::quiet_NaN();
    watch.Add(record);
  }
  EXPECT_NEAR(watch.SagOf(2), 47e-6, 1e-9);
}

}  // namespace
}  // namespace levitas::session
