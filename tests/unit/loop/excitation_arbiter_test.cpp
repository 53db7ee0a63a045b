// Test signals from the network: ExcitationPool and what the command arbiter makes of it.

#include <gtest/gtest.h>

#include <cmath>

#include "controller/loop/command_arbiter.hpp"
#include "controller/loop/excitation_pool.hpp"
#include "tests/support/allocation_guard.hpp"

namespace levitas::loop {
namespace {

constexpr double kPeriodS = 1e-4;
constexpr double kAmplitudeA = 0.25;
constexpr ArbiterOptions kExcitationOptions{
    .period_s = kPeriodS, .stop_acceleration_rad_per_s2 = 50.0, .standstill_rad_per_s = 1.0};
constexpr auto kExcite = OperatorCommand::kExcite;
constexpr auto kEnd = OperatorCommand::kEndExcitation;
constexpr auto kNone = OperatorCommand::kNone;

/// A binary sequence on axis 1: its value is the amplitude, plus or minus, in every cycle.
scenario::Step Bits(int cycles) {
  scenario::Excitation bits;
  bits.axis = 1;
  bits.order = 5;
  bits.amplitude_a = kAmplitudeA;
  scenario::Step step;
  step.hold_s = cycles * kPeriodS;
  step.excitation.push_back(bits);
  return step;
}

class ExcitationDesk : public testing::Test {
 protected:
  void Ask(int cycles) {
    auto* place = shelf_.Put(Bits(cycles), kPeriodS);
    ASSERT_NE(place, nullptr);
    ASSERT_TRUE(ring_.Post({.command = kExcite, .excitation = place}));
  }
  cycle::OperatorInput Next() { return desk_.Next(view_); }
  /// The next cycles with a test signal, up to the first without.
  int Excited() {
    for (int count = 0;; ++count) {
      last_ = Next();
      if (last_.excitation_a[1] == 0.0) return count;
      EXPECT_EQ(std::abs(last_.excitation_a[1]), kAmplitudeA);
      EXPECT_EQ(last_.command, kNone);
    }
  }
  /// As many as are left, without a cycle in between.
  int FreePlaces() {
    int free = 0;
    while (shelf_.Put(Bits(1), kPeriodS) != nullptr) ++free;
    return free;
  }

  ExcitationPool shelf_;
  SpscRing<RemoteCommand> ring_{8};
  CommandArbiter desk_{kExcitationOptions, nullptr, {&ring_}};
  OperatorView view_{.mode = Mode::kLevitating, .amplifiers_enabled = true};
  cycle::OperatorInput last_;
};

TEST_F(ExcitationDesk, ExcitesForItsLengthAndSaysThatItHasEnded) {
  Ask(40);
  const cycle::OperatorInput asked = Next();
  EXPECT_EQ(asked.command, kExcite);
  EXPECT_EQ(asked.excitation_a[1], 0.0);   // the controller has not agreed yet
  EXPECT_EQ(Next().excitation_a[1], 0.0);  // the player's own first cycle
  EXPECT_EQ(Excited(), 40);
  EXPECT_EQ(last_.command, kEnd);
  EXPECT_EQ(Next().command, kNone);
  EXPECT_EQ(FreePlaces(), static_cast<int>(ExcitationPool::kSlots));
}

TEST_F(ExcitationDesk, ExcitesNothingWhenTheControllerRefuses) {
  Ask(40);
  (void)Next();
  view_.command_refused = true;
  EXPECT_EQ(Excited(), 0);
  EXPECT_EQ(last_.command, kNone);
  view_.command_refused = false;
  EXPECT_EQ(Excited(), 0);
  EXPECT_EQ(FreePlaces(), static_cast<int>(ExcitationPool::kSlots));
}

TEST_F(ExcitationDesk, EndsByCommand) {
  Ask(1000);
  for (int i = 0; i < 10; ++i) (void)Next();
  ring_.Post({.command = kEnd});
  const cycle::OperatorInput end = Next();
  EXPECT_EQ(end.command, kEnd);
  EXPECT_EQ(end.excitation_a[1], 0.0);
  EXPECT_EQ(Excited(), 0);
  EXPECT_EQ(last_.command, kNone);
}

TEST_F(ExcitationDesk, EndsWithATripAndWhereTheModeDoesNotPassItOn) {
  for (const Mode mode : {Mode::kTripped, Mode::kLanding, Mode::kOff}) {
    view_ = {.mode = Mode::kLevitating, .amplifiers_enabled = true};
    Ask(1000);
    for (int i = 0; i < 10; ++i) (void)Next();
    view_.mode = mode;
    if (mode == Mode::kTripped) view_.fault = Fault::kOrbitExceeded;
    EXPECT_EQ(Excited(), 0) << Name(mode);
    EXPECT_EQ(last_.command, kEnd) << Name(mode);
  }
  EXPECT_EQ(FreePlaces(), static_cast<int>(ExcitationPool::kSlots));
}

TEST_F(ExcitationDesk, AnEmergencyStopPassesAtOnce) {
  Ask(1000);
  for (int i = 0; i < 10; ++i) (void)Next();
  ring_.Post({.command = OperatorCommand::kEmergencyStop});
  EXPECT_EQ(Next().command, OperatorCommand::kEmergencyStop);
}

TEST_F(ExcitationDesk, ANewSignalReplacesTheOld) {
  Ask(1000);
  for (int i = 0; i < 10; ++i) (void)Next();
  Ask(20);
  EXPECT_EQ(Next().command, kExcite);
  (void)Next();
  EXPECT_EQ(Excited(), 20);
}

TEST_F(ExcitationDesk, OtherCommandsLeaveTheSignalWithoutAGap) {
  Ask(40);
  (void)Next();
  (void)Next();
  ring_.Post({.command = OperatorCommand::kSpin,
              .speed_rad_per_s = 100.0,
              .acceleration_rad_per_s2 = 10.0});
  const cycle::OperatorInput spin = Next();
  EXPECT_EQ(spin.command, OperatorCommand::kSpin);
  EXPECT_EQ(std::abs(spin.excitation_a[1]), kAmplitudeA);
  EXPECT_EQ(Excited(), 39);
}

TEST_F(ExcitationDesk, TheEndOfTheProgramEndsTheSignalAndTakesNoNewOne) {
  Ask(1000);
  for (int i = 0; i < 10; ++i) (void)Next();
  desk_.RequestStop();
  EXPECT_EQ(Next().excitation_a[1], 0.0);
  Ask(1000);
  EXPECT_EQ(Excited(), 0);
  EXPECT_EQ(FreePlaces(), static_cast<int>(ExcitationPool::kSlots));
}

TEST_F(ExcitationDesk, RefusesMoreThanItHasPlacesFor) {
  EXPECT_EQ(FreePlaces(), static_cast<int>(ExcitationPool::kSlots));
  EXPECT_EQ(shelf_.Put(Bits(1), kPeriodS), nullptr);
}

TEST_F(ExcitationDesk, AllocatesNothingInTheLoop) {
  Ask(40);
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) (void)Next();
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace levitas::loop
