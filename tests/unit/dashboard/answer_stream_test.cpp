#include "dashboard/answer_stream.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <chrono>

#include "common/file_descriptor.hpp"

namespace levitas::dashboard {
namespace {

TEST(AnswerStream, GivesTheTimeForTakingAnAnswerFromItsFirstByteOn) {
  std::array<int, 2> pair{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, pair.data()), 0);
  const FileDescriptor ours(pair[0]);
  const FileDescriptor theirs(pair[1]);
  std::chrono::steady_clock::time_point now{};
  constexpr std::chrono::seconds kWithin{30};
  AnswerStream stream(ours.handle(), "", kWithin, [&now] { return now; });
  // A controller that is silent for long: that it was is still told.
  now += 2 * kWithin;
  EXPECT_EQ(stream.write("a", 1), 1);
  now += kWithin;
  EXPECT_EQ(stream.write("a", 1), 1);
  now += std::chrono::nanoseconds(1);
  EXPECT_EQ(stream.write("a", 1), -1);
}

}  // namespace
}  // namespace levitas::dashboard
