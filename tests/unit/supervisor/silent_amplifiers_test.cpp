// Amplifiers that are off because they were told to be are no evidence of a fault when the lift
// begins; those that stay off after it are.

#include <gtest/gtest.h>

#include "tests/unit/supervisor/supervisor_rig.hpp"

namespace levitas::supervisor {
namespace {

constexpr int kAnswer = static_cast<int>(kAmplifierAnswerCycles);

/// A rig that has lain for a long time with its amplifiers off and is then lifted.
Fault LiftedAfterALongRest(int answers_after_cycles) {
  Driver driver;
  driver.seen.rig_status = kRigAmplifiersOff;
  (void)driver.Steps(10 * kAnswer);
  (void)driver.Step(OperatorCommand::kLift);
  int silent = 0;
  for (int i = 0; i < 3 * kAnswer; ++i) {
    const State before = driver.supervisor.decision().state;
    if (before != State::kOff && before != State::kSelfTest && ++silent > answers_after_cycles) {
      driver.seen.rig_status = 0;
    }
    (void)driver.Step();
  }
  return driver.supervisor.decision().latch.finding.fault;
}

TEST(SilentAmplifiers, ARestWithoutCurrentIsNotCountedAgainstTheLift) {
  EXPECT_EQ(LiftedAfterALongRest(1), Fault::kNone);
  EXPECT_EQ(LiftedAfterALongRest(kAnswer - 1), Fault::kNone);
}

TEST(SilentAmplifiers, AmplifiersThatDoNotComeOnAreFoundWithTheLift) {
  EXPECT_EQ(LiftedAfterALongRest(kAnswer + 1), Fault::kAmplifierFault);
}

}  // namespace
}  // namespace levitas::supervisor
