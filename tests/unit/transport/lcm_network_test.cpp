#include "transport/lcm_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"

namespace levitas::transport {
namespace {

std::string Refusal(const std::string& text) {
  try {
    (void)ParseLcmNetwork(text);
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    return problem.what();
  }
  return "accepted";
}

TEST(LcmNetwork, DefaultsToTheGroupAndPortOfLcm) {
  const LcmNetwork network = ParseLcmNetwork("lcm");
  EXPECT_EQ(network.Url(Direction::kSensor), "udpm://239.255.76.67:7667?ttl=0");
  EXPECT_EQ(network.Url(Direction::kCommand), "udpm://239.255.76.67:7670?ttl=0");
}

TEST(LcmNetwork, ReadsGroupPortAndTtl) {
  const LcmNetwork network = ParseLcmNetwork("lcm:udpm://239.1.2.3:9000?ttl=1");
  EXPECT_EQ(network.group, "239.1.2.3");
  EXPECT_EQ(network.Port(Direction::kCurrent), 9001);
  EXPECT_EQ(network.ttl, 1);
  EXPECT_EQ(ParseLcmNetwork("lcm:udpm://239.1.2.3:9000").ttl, 0);
}

TEST(LcmNetwork, RefusesWithWhatWasFoundAndWhatIsAllowed) {
  EXPECT_THAT(Refusal("can:vcan0"), testing::HasSubstr("lcm:udpm://<multicast address>"));
  EXPECT_THAT(Refusal("lcm:udpm://10.0.0.1:7667"), testing::HasSubstr("not a multicast address"));
  EXPECT_THAT(Refusal("lcm:udpm://239.1.2.3"), testing::HasSubstr("no port"));
  EXPECT_THAT(Refusal("lcm:udpm://239.1.2.3:65533"), testing::HasSubstr("1 to 65532"));
  EXPECT_THAT(Refusal("lcm:udpm://239.1.2.3:0"), testing::HasSubstr("1 to 65532"));
  EXPECT_THAT(Refusal("lcm:udpm://239.1.2.3:76x7"), testing::HasSubstr("76x7"));
  EXPECT_THAT(Refusal("lcm:udpm://239.1.2.3:7667?tll=1"), testing::HasSubstr("unknown option"));
  EXPECT_THAT(Refusal("lcm:udpm://239.1.2.3:7667?ttl=256"), testing::HasSubstr("0 to 255"));
  EXPECT_THAT(Refusal(""), testing::HasSubstr("unknown form"));
}

}  // namespace
}  // namespace levitas::transport
