#include "cli/standard_output.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

/// What `print` leaves in a file that stands for standard output, and what Finish says of it.
struct Printed {
  std::string text, refused;
};

template <class Print>
Printed PrintedInto(const std::string& path, Print print) {
  std::fflush(stdout);
  const int kept = ::dup(STDOUT_FILENO);
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  ::dup2(file, STDOUT_FILENO);
  ::close(file);
  Printed printed;
  {
    StandardOutput output;
    print();
    printed.refused = output.Finish();
  }
  ::dup2(kept, STDOUT_FILENO);
  ::close(kept);
  if (path.starts_with("/dev")) return printed;
  std::ifstream stream(path, std::ios::binary);
  printed.text = {std::istreambuf_iterator<char>(stream), {}};
  return printed;
}

TEST(StandardOutput, LeavesEveryCharacterWholeWhereverItsBufferEnds) {
  const test::ScratchFolder scratch;
  // 1, 2, 3 and 4 bytes: 10 in all, which divide no power of two.
  std::string text;
  for (int i = 0; i < 20'000; ++i) text += "aµ磁𝄞";
  const Printed printed = PrintedInto(scratch / "out", [&] {
    fmt::print("{}", text);
    for (const char byte : text) std::fwrite(&byte, 1, 1, stdout);
  });
  EXPECT_TRUE(printed.text == text + text);  // too long to be printed
  EXPECT_EQ(printed.refused, "");
}

TEST(StandardOutput, ShowsControlCharactersAndACharacterThatIsCutOff) {
  const test::ScratchFolder scratch;
  const Printed printed =
      PrintedInto(scratch / "out", [] { fmt::print("row\t\x1b[2J\r\nend\xe7\xa3"); });
  EXPECT_EQ(printed.text, "row\t\\x1b[2J\\x0d\nend\\xe7\\xa3");
}

TEST(StandardOutput, TellsWhatAFullDiskHasRefused) {
  EXPECT_EQ(PrintedInto("/dev/full", [] { fmt::print("x"); }).refused, "No space left on device");
  EXPECT_EQ(PrintedInto("/dev/full", [] {}).refused, "") << "nothing was lost";
}

}  // namespace
}  // namespace levitas::cli
