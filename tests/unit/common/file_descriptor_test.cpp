#include "common/file_descriptor.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace levitas {
namespace {

bool IsOpen(int handle) { return ::fcntl(handle, F_GETFD) != -1; }

std::array<int, 2> Pipe() {
  std::array<int, 2> ends{-1, -1};
  EXPECT_EQ(::pipe(ends.data()), 0);
  return ends;
}

TEST(FileDescriptor, ClosesAtTheEndOfItsScope) {
  const auto ends = Pipe();
  {
    const FileDescriptor from(ends[0]);
    const FileDescriptor to(ends[1]);
    EXPECT_TRUE(from.is_open() && IsOpen(from.handle()));
  }
  EXPECT_FALSE(IsOpen(ends[0]));
  EXPECT_FALSE(IsOpen(ends[1]));
}

TEST(FileDescriptor, MovedIsClosedOnceByItsNewOwner) {
  const auto ends = Pipe();
  FileDescriptor to(ends[1]);
  {
    FileDescriptor from(ends[0]);
    to = std::move(from);
    EXPECT_TRUE(IsOpen(ends[0]));
  }
  EXPECT_EQ(to.handle(), ends[0]);
  EXPECT_TRUE(IsOpen(ends[0]));
  EXPECT_FALSE(IsOpen(ends[1]));  // what the target held before went with the source
  const FileDescriptor last(std::move(to));
  EXPECT_EQ(last.handle(), ends[0]);
}

TEST(FileDescriptor, OfAFailedCallIsNotOpenAndClosesNothing) {
  FileDescriptor none(::open("/nowhere/at/all", O_RDONLY | O_CLOEXEC));
  EXPECT_FALSE(none.is_open());
  none.Close();
  none.Close();
}

TEST(FileDescriptor, ClosedEarlyIsNotClosedAgain) {
  const auto ends = Pipe();
  FileDescriptor from(ends[0]);
  const FileDescriptor to(ends[1]);
  from.Close();
  EXPECT_FALSE(from.is_open());
  const FileDescriptor reused(::dup(to.handle()));  // the kernel gives the lowest free number
  ASSERT_EQ(reused.handle(), ends[0]);
  from.Close();
  EXPECT_TRUE(IsOpen(reused.handle()));
}

}  // namespace
}  // namespace levitas
