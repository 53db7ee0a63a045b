#include "cli/run/disk_room.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

TEST(NoRoom, SaysNothingOfDisksThatTakeMore) {
  const test::ScratchFolder scratch;
  EXPECT_EQ(NoRoom({scratch / "", scratch / "file", "file", "/nowhere/at/all"}), "");
}

// /proc has no blocks at all, so nothing can be written there.
TEST(NoRoom, NamesEachFullDiskOnce) {
  const test::ScratchFolder scratch;
  EXPECT_EQ(NoRoom({"/proc/x", scratch / "file", "/proc/y"}), "no space is left in /proc");
}

TEST(RecordingStopped, FindsTheControllersSentence) {
  const test::ScratchFolder scratch;
  std::ofstream(scratch / "log")
      << "amb-controller: rig found\n"
         "amb-controller: cycle 0: /d/x.lcm: recording stopped: No space left on device. What was "
         "written before is readable.\n";
  EXPECT_EQ(RecordingStopped(scratch / "log"), "recording stopped: No space left on device");
}

TEST(RecordingStopped, IsEmptyWithoutOne) {
  const test::ScratchFolder scratch;
  std::ofstream(scratch / "log") << "amb-controller: rig found\n";
  EXPECT_EQ(RecordingStopped(scratch / "log"), "");
  EXPECT_EQ(RecordingStopped(scratch / "none"), "");
}

}  // namespace
}  // namespace levitas::cli
