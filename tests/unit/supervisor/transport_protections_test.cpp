// Frames, currents and deadlines by count and by share: just below each limit and at it.

#include <gtest/gtest.h>

#include "controller/supervisor/protections.hpp"
#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

TEST(FrameMissingProtection, TripsAfterItsCyclesInARow) {
  const auto missing = [](Seen& seen, int) { seen.fresh = false; };
  EXPECT_EQ(TripAfter(State::kSpinning, 4, missing).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 5, missing).fault, Fault::kFrameMissing);
}

// 5 in a row trip, so 17 of 20 do: 85 % of four times as many.
TEST(FrameMissingProtection, TakesALineThatIsNearlyCutForOneThatIs) {
  const auto bursts = [](int lost, int of) {
    return [=](Seen& seen, int i) { seen.fresh = i % of >= lost; };
  };
  // Four of five lost are 16 of 20: a levitated stop.
  EXPECT_EQ(TripAfter(State::kSpinning, 200, bursts(4, 5)).fault, Fault::kFramesLost);
  ProtectionConfig config = TestConfig().protection;
  config.frames_lost_cycles = 2;  // out of reach: what the cut itself needs
  config.frames_lost_window_cycles = 1;
  config.frame_missing_cycles = 10;  // 34 of 40
  const auto after = [&](int cycles, int lost, int of) {
    Protections protections(TestRig(), config);
    Seen seen;
    protections.AcceptSession(1);
    Finding found;
    for (int i = 0; i < cycles && found.fault == Fault::kNone; ++i) {
      seen.fresh = i % of >= lost;
      found = protections.Check(seen.Next(), {.armed = kSignalFaults, .energised = true});
    }
    return found;
  };
  EXPECT_EQ(after(1000, 8, 10).fault, Fault::kNone);  // 32 of 40
  EXPECT_EQ(after(36, 9, 10).fault, Fault::kNone);    // 33 so far
  const Finding cut = after(37, 9, 10);
  EXPECT_EQ(cut.fault, Fault::kFrameMissing);
  EXPECT_EQ(cut.limit, 34.0);
}

TEST(FramesLostProtection, CountsWithinItsWindowAndStopsTheRotorLevitated) {
  // 12 within 30: two of five lost reach it, one of three (10 of 30) does not.
  const auto bursts = [](int lost, int of) {
    return [=](Seen& seen, int i) { seen.fresh = i % of >= lost; };
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 1000, bursts(1, 3)).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 26, bursts(2, 5)).fault, Fault::kNone);
  const Finding found = TripAfter(State::kSpinning, 27, bursts(2, 5));
  EXPECT_EQ(found.fault, Fault::kFramesLost);
  EXPECT_EQ(found.value, 12.0);
  EXPECT_EQ(found.limit, 12.0);
  for (const State state : {State::kLevitating, State::kSpinning, State::kCoastDown}) {
    Driver driver;
    driver.GoTo(state);
    for (int i = 0; i < 27; ++i) {
      bursts(2, 5)(driver.seen, i);
      (void)driver.Step();
    }
    EXPECT_EQ(driver.state(), State::kTrippedStopping) << Name(state);
  }
}

TEST(CurrentsLateProtection, CountsTheRigsOwnCountAndItsStatusBitButNotBoth) {
  const auto counted = [](Seen& seen, int i) {
    seen.rig_status = kRigCurrentHeld;
    if (i % 2 == 0) seen.held_currents += 2;  // the bit alone in between
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 4, counted).fault, Fault::kNone);  // 2 + 1 + 2 + 1
  const Finding found = TripAfter(State::kSpinning, 5, counted);
  EXPECT_EQ(found.fault, Fault::kCurrentsLate);
  EXPECT_EQ(found.limit, 7.0);
  const auto reported = [](Seen& seen, int) { seen.rig_status = kRigCurrentHeld; };
  EXPECT_EQ(TripAfter(State::kSpinning, 6, reported).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 7, reported).fault, Fault::kCurrentsLate);
  // Seven within 50 trip: one in eight does, one in nine does not.
  const auto one_in = [](int cycles) {
    return [cycles](Seen& seen, int i) { seen.held_currents += i % cycles == 0 ? 1U : 0U; };
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 1000, one_in(9)).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 1000, one_in(8)).fault, Fault::kCurrentsLate);
}

TEST(CurrentsLateProtection, LooksAtNothingWhileNoCurrentIsWantedNorAtTheCountOfAnotherRig) {
  Driver driver;
  driver.seen.rig_status = kRigCurrentHeld;
  driver.seen.held_currents = 1'000'000;
  (void)driver.Steps(1000);
  driver.seen.rig_status = 0;
  driver.GoTo(State::kLevitating);
  EXPECT_EQ(driver.state(), State::kLevitating);
}

TEST(DeadlineProtection, CountsMissesWithinItsWindow) {
  // Three within 100 cycles trip: misses 49 cycles apart do, misses 50 apart do not.
  const auto every = [](int apart) {
    return [apart](Seen& seen, int i) { seen.missed_deadlines = i % apart == 0 ? 1 : 0; };
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 99, every(49)).fault, Fault::kDeadlineMissed);
  EXPECT_EQ(TripAfter(State::kSpinning, 1000, every(50)).fault, Fault::kNone);
}

TEST(DeadlineProtection, CountsEveryPeriodOfALongInterruption) {
  const auto once = [](std::uint32_t missed) {
    return [missed](Seen& seen, int i) { seen.missed_deadlines = i == 0 ? missed : 0; };
  };
  EXPECT_EQ(TripAfter(State::kSpinning, 10, once(2)).fault, Fault::kNone);
  EXPECT_EQ(TripAfter(State::kSpinning, 1, once(3)).fault, Fault::kDeadlineMissed);
  EXPECT_EQ(TripAfter(State::kSpinning, 1, once(4'000'000'000U)).fault, Fault::kDeadlineMissed);
}

}  // namespace
}  // namespace levitas::supervisor
