#include "dashboard/access.hpp"

#include <gtest/gtest.h>

namespace levitas::dashboard {
namespace {

TEST(Access, TakesOnlyAddressesOfThisMachineForLoopback) {
  for (const char* own : {"127.0.0.1", "127.8.9.10", "localhost", "::1"}) {
    EXPECT_TRUE(IsLoopback(own)) << own;
  }
  for (const char* other : {"", "0.0.0.0", "192.168.1.5", "128.0.0.1", "::", "127.evil.example",
                            "localhost.evil.example", "1127.0.0.1"}) {
    EXPECT_FALSE(IsLoopback(other)) << other;
  }
}

TEST(Access, RefusesAHostNameThatWasMadeToPointHere) {
  EXPECT_TRUE(HostIsLoopback("127.0.0.1:8970"));
  EXPECT_TRUE(HostIsLoopback("localhost:1"));
  EXPECT_TRUE(HostIsLoopback("[::1]:8970"));
  EXPECT_TRUE(HostIsLoopback("[::1]"));
  for (const char* bad : {"", "evil.example:8970", "127.0.0.1.evil.example:8970", "[::1", "[::2]:1",
                          "[::1]evil.example"}) {
    EXPECT_FALSE(HostIsLoopback(bad)) << bad;
  }
}

TEST(Access, AcceptsTheWholeTokenAndNothingElse) {
  EXPECT_TRUE(TokenMatches("abcdef", "abcdef"));
  for (const char* bad : {"", "abcde", "abcdeg", "abcdeff", "Abcdef"}) {
    EXPECT_FALSE(TokenMatches(bad, "abcdef")) << bad;
  }
  EXPECT_FALSE(TokenMatches("", "")) << "no token is no permission";
}

TEST(Access, MakesATokenOf128BitsThatDoesNotRepeat) {
  const std::string token = NewToken();
  EXPECT_EQ(token.size(), 32U);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(token, NewToken());
}

}  // namespace
}  // namespace levitas::dashboard
