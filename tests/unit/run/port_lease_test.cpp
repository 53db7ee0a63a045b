#include "cli/run/port_lease.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <string>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

/// Tests run beside each other and beside runs: each process looks in a range of its own.
std::uint16_t OwnRange() { return static_cast<std::uint16_t>(20'000 + getpid() % 300 * 100); }

int BindUdp(std::uint16_t port) {
  const int bound = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  sockaddr generic{};
  std::memcpy(&generic, &address, sizeof address);
  EXPECT_EQ(bind(bound, &generic, sizeof address), 0);
  return bound;
}

TEST(PortLease, TwoLeasesNeverShareAPort) {
  const PortLease first = PortLease::FirstFree(OwnRange());
  const PortLease second = PortLease::FirstFree(OwnRange());
  EXPECT_GE(second.base_port(), first.base_port() + PortLease::kCount);
}

TEST(PortLease, IsFreeAgainWhenItEnds) {
  std::optional<PortLease> lease = PortLease::FirstFree(OwnRange());
  const std::uint16_t base = lease->base_port();
  EXPECT_THROW(PortLease::Claim(base), Problem);
  lease.reset();
  EXPECT_EQ(PortLease::Claim(base).base_port(), base);
}

TEST(PortLease, PassesOverPortsAnotherProgramHasBound) {
  const std::uint16_t base = PortLease::FirstFree(OwnRange()).base_port();
  const int foreign = BindUdp(static_cast<std::uint16_t>(base + 2));
  const PortLease lease = PortLease::FirstFree(OwnRange());
  EXPECT_GE(lease.base_port(), base + PortLease::kCount);
  close(foreign);
}

// A tool that listens on the ports (lcm-spy) does not stop a run that was told to use them.
TEST(PortLease, ClaimsNamedPortsAlthoughAToolListens) {
  const std::uint16_t base = PortLease::FirstFree(OwnRange()).base_port();
  const int tool = BindUdp(base);
  EXPECT_EQ(PortLease::Claim(base).base_port(), base);
  close(tool);
}

TEST(PortLease, NamesThePortsThatAreTaken) {
  const PortLease lease = PortLease::FirstFree(OwnRange());
  try {
    PortLease::Claim(lease.base_port());
    FAIL() << "one set of ports was given out twice";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    EXPECT_THAT(problem.what(), testing::HasSubstr(std::to_string(lease.base_port()) + " to " +
                                                   std::to_string(lease.base_port() + 3)));
  }
}

TEST(PortLease, MovesWithoutLosingThePorts) {
  PortLease lease = PortLease::FirstFree(OwnRange());
  const PortLease moved = std::move(lease);
  EXPECT_THROW(PortLease::Claim(moved.base_port()), Problem);
}

}  // namespace
}  // namespace levitas::cli
