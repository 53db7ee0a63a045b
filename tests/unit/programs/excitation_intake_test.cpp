// Test signals from the request to the desk's inbox: made, refused, ended before they began.

#include "programs/controller/excitation_intake.hpp"

#include <gtest/gtest.h>

#include <future>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/waiting.hpp"
#include "tests/unit/programs/signal_requests.hpp"

namespace levitas::controller_program {
namespace {

using levitas::test::Eventually;
using test::Request;

/// The intake, and what it refused. A request for channel "gate" stays at work until Open.
class ExcitationRequests : public testing::Test {
 protected:
  static constexpr std::int64_t kGate = 1000;

  void TearDown() override { Open(); }
  /// The thread of the intake stands still from here on.
  void Close() {
    ASSERT_TRUE(intake_.Take(Request(kGate, "no_channel")));
    ASSERT_TRUE(Eventually([this] { return RefusedCount() == 1; }));
  }
  void Open() {
    if (!std::exchange(open_, true)) gate_.set_value();
  }
  void Refused(const std::string& why, const CommandOrigin& origin) {
    {
      const std::lock_guard lock(mutex_);
      refused_.emplace_back(origin.sequence, why);
    }
    if (origin.sequence == kGate) opened_.wait();
  }
  std::size_t RefusedCount() {
    const std::lock_guard lock(mutex_);
    return refused_.size();
  }
  std::pair<std::int64_t, std::string> RefusedAt(std::size_t i) {
    const std::lock_guard lock(mutex_);
    return refused_.at(i);
  }
  /// The next command that the desk would be given.
  loop::RemoteCommand Given() {
    loop::RemoteCommand command;
    EXPECT_TRUE(Eventually([&] { return inbox_.ring().Take(command); }));
    return command;
  }

  RigNumbers rig_ = test::ShippedRig();
  CommandInbox inbox_;
  StopLatch stops_;
  std::mutex mutex_;
  std::vector<std::pair<std::int64_t, std::string>> refused_;
  std::promise<void> gate_;
  std::shared_future<void> opened_ = gate_.get_future().share();
  bool open_{false};
  ExcitationIntake intake_{
      rig_, inbox_, stops_,
      [this](const std::string& why, const CommandOrigin& origin) { Refused(why, origin); }};
};

TEST_F(ExcitationRequests, BecomeCommandsWithASignalInTheOrderInWhichTheyCame) {
  for (const std::int64_t sequence : {1, 2, 3}) ASSERT_TRUE(intake_.Take(Request(sequence)));
  for (const std::int64_t sequence : {1, 2, 3}) {
    const loop::RemoteCommand given = Given();
    EXPECT_EQ(given.command, OperatorCommand::kExcite);
    EXPECT_EQ(given.origin.sequence, sequence);
    EXPECT_NE(given.excitation, nullptr);
  }
  EXPECT_EQ(RefusedCount(), 0U);
}

TEST_F(ExcitationRequests, ThatCannotBeMetAreRefusedWithTheReasonAndTheirNumber) {
  ASSERT_TRUE(intake_.Take(Request(7, "no_channel")));
  ASSERT_TRUE(Eventually([this] { return RefusedCount() == 1; }));
  const auto [sequence, why] = RefusedAt(0);
  EXPECT_EQ(sequence, 7);
  EXPECT_TRUE(why.starts_with("command excite refused: ")) << why;
  EXPECT_NE(why.find("no_channel"), std::string::npos) << why;
  ASSERT_TRUE(intake_.Take(Request(8)));
  EXPECT_EQ(Given().origin.sequence, 8);
}

TEST_F(ExcitationRequests, FindNoRoomBehindThoseThatWait) {
  Close();
  for (std::size_t i = 0; i < ExcitationIntake::kWaiting; ++i) {
    EXPECT_TRUE(intake_.Take(Request(static_cast<std::int64_t>(i))));
  }
  EXPECT_FALSE(intake_.Take(Request(99)));
}

TEST_F(ExcitationRequests, ThatWaitWhenTheSignalIsEndedAreNotBegun) {
  Close();
  for (const std::int64_t sequence : {1, 2}) ASSERT_TRUE(intake_.Take(Request(sequence)));
  intake_.EndWaiting();
  ASSERT_TRUE(intake_.Take(Request(3)));  // asked for after the end
  Open();
  EXPECT_EQ(Given().origin.sequence, 3);
  ASSERT_EQ(RefusedCount(), 3U);
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(RefusedAt(i).first, static_cast<std::int64_t>(i));
    EXPECT_NE(RefusedAt(i).second.find("it was ended before it began"), std::string::npos);
  }
}

TEST_F(ExcitationRequests, ThatCameBeforeAnEmergencyStopAreNotBegunAfterIt) {
  Close();
  ASSERT_TRUE(intake_.Take(Request(1)));
  stops_.Ask(1, {});
  transport::NetworkExcitation later = Request(2);
  later.stops_before = 1;
  ASSERT_TRUE(intake_.Take(later));
  Open();
  EXPECT_EQ(Given().origin.sequence, 2);
  ASSERT_EQ(RefusedCount(), 2U);
  EXPECT_NE(RefusedAt(1).second.find("an emergency stop came before it began"), std::string::npos);
}

TEST_F(ExcitationRequests, BeyondThePlacesOfThePoolAreRefusedUntilOneIsGivenBack) {
  std::vector<loop::RemoteCommand> given;
  for (std::size_t i = 0; i < loop::ExcitationPool::kSlots; ++i) {
    ASSERT_TRUE(intake_.Take(Request(1)));
    given.push_back(Given());
  }
  ASSERT_TRUE(intake_.Take(Request(2)));
  ASSERT_TRUE(Eventually([this] { return RefusedCount() == 1; }));
  EXPECT_NE(RefusedAt(0).second.find("too many at once"), std::string::npos);
  loop::ExcitationPool::GiveBack(given[0].excitation);
  ASSERT_TRUE(intake_.Take(Request(3)));
  EXPECT_EQ(Given().origin.sequence, 3);
}

// A refusal must not keep the place: after more refusals than there are places one still begins.
TEST_F(ExcitationRequests, ThatFindTheInboxFullGiveTheirPlaceBack) {
  while (inbox_.Post({.command = OperatorCommand::kNone})) {
  }
  for (std::size_t i = 1; i <= 2 * loop::ExcitationPool::kSlots; ++i) {
    ASSERT_TRUE(intake_.Take(Request(5)));
    ASSERT_TRUE(Eventually([&] { return RefusedCount() == i; }));
    EXPECT_NE(RefusedAt(i - 1).second.find("too many commands at once"), std::string::npos);
  }
  loop::RemoteCommand command;
  while (inbox_.ring().Take(command)) {
  }
  ASSERT_TRUE(intake_.Take(Request(6)));
  EXPECT_EQ(Given().origin.sequence, 6);
}

}  // namespace
}  // namespace levitas::controller_program
