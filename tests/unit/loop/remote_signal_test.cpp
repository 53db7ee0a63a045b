// A test signal of the network alone, state by state; with the desk around it:
// excitation_arbiter_test.cpp.

#include "controller/loop/remote_signal.hpp"

#include <gtest/gtest.h>

namespace levitas::loop {
namespace {

class Signal : public testing::Test {
 protected:
  static constexpr double kPeriodS = 1e-4;

  ExcitationPool::Slot* Place(int cycles) {
    scenario::Excitation bits;
    bits.axis = 1;
    bits.order = 5;
    bits.amplitude_a = 0.25;
    scenario::Step step;
    step.hold_s = cycles * kPeriodS;
    step.excitation.push_back(bits);
    return pool_.Put(step, kPeriodS);
  }
  /// A cycle with this command of others; what it becomes.
  cycle::OperatorInput Cycle(OperatorCommand command = OperatorCommand::kNone,
                             bool run_ends = false) {
    cycle::OperatorInput input{.command = command};
    (void)signal_.AddTo(input, view_, run_ends);
    return input;
  }
  void Begin(int cycles) {
    signal_.Excite(Place(cycles));
    (void)Cycle(OperatorCommand::kExcite);
    (void)Cycle();
    ASSERT_EQ(signal_.state(), SignalState::kPlaying);
  }
  /// Places that nobody holds.
  std::size_t Free() {
    std::size_t free = 0;
    while (Place(1) != nullptr) ++free;
    return free;
  }

  ExcitationPool pool_;
  RemoteSignal signal_;
  OperatorView view_{.mode = Mode::kLevitating, .amplifiers_enabled = true};
};

TEST_F(Signal, IsAnsweredInTheCycleAfterItsCommand) {
  signal_.Excite(Place(10));
  view_.command_refused = true;  // the answer to an earlier command
  (void)Cycle(OperatorCommand::kExcite);
  EXPECT_EQ(signal_.state(), SignalState::kAsked);
  view_.command_refused = false;
  (void)Cycle();
  EXPECT_EQ(signal_.state(), SignalState::kPlaying);
}

TEST_F(Signal, ThatIsRefusedIsGivenBackAndNeverTold) {
  signal_.Excite(Place(10));
  (void)Cycle(OperatorCommand::kExcite);
  view_.command_refused = true;
  EXPECT_EQ(Cycle().command, OperatorCommand::kNone);
  EXPECT_EQ(signal_.state(), SignalState::kNone);
  EXPECT_EQ(Free(), ExcitationPool::kSlots);
}

// A refusal of what somebody else asked for does not end it.
TEST_F(Signal, ThatPlaysHearsNoRefusal) {
  Begin(10);
  view_.command_refused = true;
  (void)Cycle();
  EXPECT_EQ(signal_.state(), SignalState::kPlaying);
}

TEST_F(Signal, TellsItsEndInTheFirstCycleThatHasNoOtherCommand) {
  Begin(10);
  EXPECT_EQ(Cycle(OperatorCommand::kLand, true).command, OperatorCommand::kLand);
  EXPECT_EQ(signal_.state(), SignalState::kEndedUntold);
  EXPECT_EQ(Cycle(OperatorCommand::kSpin, true).command, OperatorCommand::kSpin);
  EXPECT_EQ(Cycle(OperatorCommand::kNone, true).command, OperatorCommand::kEndExcitation);
  EXPECT_EQ(Cycle(OperatorCommand::kNone, true).command, OperatorCommand::kNone);
}

TEST_F(Signal, ThatEndsByItsLengthInAFreeCycleTellsItAtOnce) {
  Begin(3);
  int told = 0;
  for (int i = 0; i < 10; ++i) {
    if (Cycle().command == OperatorCommand::kEndExcitation) ++told;
  }
  EXPECT_EQ(told, 1);
  EXPECT_EQ(signal_.state(), SignalState::kNone);
}

TEST_F(Signal, ThatIsReplacedOrEndedByCommandGivesItsPlaceBackAndIsNotToldAgain) {
  Begin(10);
  signal_.Excite(Place(10));
  (void)Cycle(OperatorCommand::kExcite);
  signal_.End();
  EXPECT_EQ(Cycle(OperatorCommand::kEndExcitation).command, OperatorCommand::kEndExcitation);
  EXPECT_EQ(Cycle().command, OperatorCommand::kNone);
  EXPECT_EQ(Free(), ExcitationPool::kSlots);
}

TEST_F(Signal, ThatIsAskedForWithoutAPlaceEndsWhatPlays) {
  Begin(10);
  signal_.Excite(nullptr);
  EXPECT_EQ(signal_.state(), SignalState::kNone);
  EXPECT_EQ(Free(), ExcitationPool::kSlots);
}

}  // namespace
}  // namespace levitas::loop
