#include "dashboard/access.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <functional>
#include <string>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

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

TEST(Access, KnowsWhatABrowserSaysOfOtherPages) {
  EXPECT_FALSE(FromAnotherPage("localhost:8970", "", "")) << "a program";
  EXPECT_FALSE(FromAnotherPage("localhost:8970", "", "none")) << "typed by hand";
  EXPECT_FALSE(FromAnotherPage("localhost:8970", "http://localhost:8970", "same-origin"));
  EXPECT_FALSE(FromAnotherPage("rig.example", "https://rig.example", "")) << "behind a proxy";
  for (const char* origin : {"http://evil.example", "null", "http://localhost", "localhost:8970",
                             "http://localhost:8971", "http://localhost:8970.evil.example"}) {
    EXPECT_TRUE(FromAnotherPage("localhost:8970", origin, "")) << origin;
  }
  EXPECT_TRUE(FromAnotherPage("localhost:8970", "", "cross-site"));
  EXPECT_TRUE(FromAnotherPage("localhost:8970", "http://localhost:8970", "same-site"));
}

ExitStatus StatusOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Problem& problem) {
    return problem.status();
  }
  return ExitStatus::kDone;
}

TEST(Access, RefusesATokenThatCanBeGuessedOrIsNoPartOfAnAddress) {
  const auto check = [](const std::string& token) {
    return StatusOf([&] { CheckToken(token, "--token"); });
  };
  EXPECT_EQ(check("0123456789abcdef"), ExitStatus::kDone);
  EXPECT_EQ(check(NewToken()), ExitStatus::kDone);
  for (const char* bad : {"", "a", "0123456789abcde", "0123456789abcde&", "0123456789 abcdef"}) {
    EXPECT_EQ(check(bad), ExitStatus::kUsage) << bad;
  }
}

TEST(Access, ReadsATokenOnlyFromAFileThatNobodyElseMayReadOrWrite) {
  const test::ScratchFolder folder;
  const std::string path = folder / "token";
  std::ofstream(path) << "0123456789abcdef\nnot this\n";
  const auto read = [&] { return StatusOf([&] { (void)ReadToken(path); }); };
  for (const mode_t open : {0644U, 0640U, 0604U, 0620U, 0601U}) {
    ASSERT_EQ(::chmod(path.c_str(), open), 0);
    EXPECT_EQ(read(), ExitStatus::kBadInput) << open;
  }
  ASSERT_EQ(::chmod(path.c_str(), 0600), 0);
  EXPECT_EQ(ReadToken(path), "0123456789abcdef");
  std::ofstream(path) << "short\n";
  EXPECT_EQ(read(), ExitStatus::kUsage);
  EXPECT_EQ(StatusOf([] { (void)ReadToken("/no/such/file"); }), ExitStatus::kBadInput);
  EXPECT_EQ(StatusOf([] { (void)ReadToken("/dev/zero"); }), ExitStatus::kBadInput);
}

}  // namespace
}  // namespace levitas::dashboard
