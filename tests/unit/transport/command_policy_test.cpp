#include "transport/command_policy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "transport/network_key.hpp"

namespace levitas::transport {
namespace {

using testing::HasSubstr;

LcmNetwork Network(int ttl, bool key) {
  LcmNetwork network;
  network.ttl = ttl;
  if (key) network.key = std::make_shared<const NetworkKey>(SealingKey::Bytes{}, "lab.key");
  return network;
}

TEST(CommandPolicy, OnThisMachineCommandsAreTakenAndItIsSaidWhoMayGiveThem) {
  const CommandPolicy policy = DecideCommands(CommandWish::kDefault, Network(0, false), false);
  EXPECT_TRUE(policy.open);
  EXPECT_THAT(policy.who, HasSubstr("every program of this machine"));
}

TEST(CommandPolicy, OnARealBusNoneAreTakenUnlessThereIsAKeyOrTheyAreAskedFor) {
  EXPECT_FALSE(DecideCommands(CommandWish::kDefault, Network(0, false), true).open);
  EXPECT_TRUE(DecideCommands(CommandWish::kDefault, Network(0, true), true).open);
  EXPECT_TRUE(DecideCommands(CommandWish::kYes, Network(0, false), true).open);
  EXPECT_FALSE(DecideCommands(CommandWish::kNo, Network(0, true), true).open);
}

TEST(CommandPolicy, WhereOtherMachinesReachThemCommandsNeedAKeyOrARefusal) {
  for (const CommandWish wish : {CommandWish::kDefault, CommandWish::kYes}) {
    try {
      static_cast<void>(DecideCommands(wish, Network(1, false), false));
      FAIL() << "taken";
    } catch (const Problem& problem) {
      EXPECT_EQ(problem.status(), ExitStatus::kUsage);
      EXPECT_THAT(problem.what(), HasSubstr("--no-commands"));
    }
  }
  EXPECT_FALSE(DecideCommands(CommandWish::kNo, Network(1, false), false).open);
  EXPECT_THAT(DecideCommands(CommandWish::kDefault, Network(1, true), false).who,
              HasSubstr("whoever has the key lab.key, on any machine"));
}

TEST(TakeKey, RefusesANetworkThatOtherMachinesReachWithoutOne) {
  LcmNetwork here = Network(0, false);
  TakeKey(here, "", "play the rig");
  EXPECT_EQ(here.key, nullptr);
  LcmNetwork wide = Network(1, false);
  EXPECT_THROW(TakeKey(wide, "", "play the rig"), Problem);
}

}  // namespace
}  // namespace levitas::transport
