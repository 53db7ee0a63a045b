#include "programs/controller/command_intake.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "programs/controller/command_inbox.hpp"
#include "tests/unit/programs/signal_requests.hpp"

namespace levitas::controller_program {
namespace {

transport::NetworkCommand Land() {
  transport::NetworkCommand land;
  land.command = OperatorCommand::kLand;
  return land;
}

class Intake : public testing::Test {
 protected:
  RigNumbers rig_ = test::ShippedRig();
  std::vector<std::string> warnings_;
  CommandIntake intake_{rig_, [this](const std::string& text) { warnings_.push_back(text); },
                        [](const std::string&, const CommandOrigin&) {}};
  transport::OperatorHandlers handlers_ = intake_.Handlers({});
};

TEST_F(Intake, HandsACommandToTheDeskAsItCame) {
  ASSERT_TRUE(handlers_.take({.command = OperatorCommand::kSpin,
                              .speed_rad_per_s = 100.0,
                              .acceleration_rad_per_s2 = 10.0,
                              .origin = {.sender = 9, .sequence = 4},
                              .stops_before = 2}));
  loop::RemoteCommand given;
  ASSERT_TRUE(intake_.commands().Take(given));
  EXPECT_EQ(given.command, OperatorCommand::kSpin);
  EXPECT_EQ(given.speed_rad_per_s, 100.0);
  EXPECT_EQ(given.acceleration_rad_per_s2, 10.0);
  EXPECT_EQ(given.origin.sender, 9U);
  EXPECT_EQ(given.origin.sequence, 4);
  EXPECT_EQ(given.stops_before, 2U);
  EXPECT_FALSE(intake_.commands().Take(given));
}

TEST_F(Intake, TakesNoMoreThanItHasRoomForAndAgainOnceThereIsRoom) {
  for (std::size_t i = 0; i < CommandInbox::kRoom; ++i) {
    EXPECT_TRUE(handlers_.take(Land())) << i;
  }
  EXPECT_FALSE(handlers_.take(Land()));
  loop::RemoteCommand given;
  ASSERT_TRUE(intake_.commands().Take(given));
  EXPECT_TRUE(handlers_.take(Land()));
}

// Calls are far closer together than kSayEvery: a line of the log for each would be a flood.
TEST_F(Intake, SaysThatThereIsNoRoomAndNotForEach) {
  constexpr int kDropped = 100'000;
  for (int i = 0; i < kDropped; ++i) handlers_.dropped();
  ASSERT_FALSE(warnings_.empty());
  EXPECT_NE(warnings_[0].find("1 found no room"), std::string::npos) << warnings_[0];
  EXPECT_LT(warnings_.size(), std::size_t{kDropped} / 100);
}

TEST_F(Intake, LetsTheStopPassWhereCommandsFindNoRoom) {
  while (handlers_.take(Land())) {
  }
  intake_.stops().Ask(1, {.sender = 3, .sequence = 1});
  EXPECT_TRUE(intake_.stops().Take());
}

TEST_F(Intake, GivesTheStopThreadWhatItWasToldToEnterWith) {
  bool entered = false;
  intake_.Handlers([&entered] { entered = true; }).enter_stop_thread();
  EXPECT_TRUE(entered);
}

}  // namespace
}  // namespace levitas::controller_program
