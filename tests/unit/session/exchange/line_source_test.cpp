#include "session/exchange/line_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "common/problem.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using ::testing::ElementsAre;
using testing::Folder;
using ::testing::HasSubstr;
using testing::WriteFile;

class Lines : public ::testing::Test {
 protected:
  std::vector<std::string> Read(const std::string& content, const LineSource::Limits& limits = {}) {
    WriteFile(path_, content);
    LineSource source(path_, limits);
    std::vector<std::string> lines;
    for (std::string_view line; source.Next(line);) lines.emplace_back(line);
    EXPECT_EQ(source.line_number(), lines.size());
    return lines;
  }
  static std::string Refusal(const std::string& path, const LineSource::Limits& limits = {}) {
    try {
      LineSource source(path, limits);
      for (std::string_view line; source.Next(line);) {
      }
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "read";
  }
  Folder folder_;
  std::string path_{folder_ / "data.csv"};
};

TEST_F(Lines, EndAtLineFeedsWithOrWithoutCarriageReturnAndAtTheEnd) {
  EXPECT_THAT(Read("a\r\n\nb\nc"), ElementsAre("a", "", "b", "c"));
  EXPECT_THAT(Read("a\n"), ElementsAre("a"));
  EXPECT_THAT(Read(""), ElementsAre());
  EXPECT_THAT(Read("\xEF\xBB\xBFtime_s\n"), ElementsAre("time_s"));
}

TEST_F(Lines, AreWholeWhereverTheFileIsCutIntoPieces) {
  std::string content;
  std::vector<std::string> expected;
  for (std::size_t i = 0; i < 3000; ++i) {
    expected.emplace_back(i % 97, static_cast<char>('a' + i % 26));
    content += expected.back() + "\n";
  }
  EXPECT_EQ(Read(content), expected);  // 144 kB, read in pieces of 64 KiB
}

TEST_F(Lines, OfTheLargestLengthAreReadAndOneByteMoreIsRefused) {
  const LineSource::Limits limits{.line = 100'000};
  EXPECT_EQ(Read(std::string(100'000, 'x') + "\ny\n", limits).size(), 2U);
  WriteFile(path_, "a\n" + std::string(100'001, 'x') + "\n");
  EXPECT_THAT(Refusal(path_, limits), HasSubstr("line 2 is longer than 100000 bytes"));
}

TEST_F(Lines, OfAnEndlessDeviceAreRefused) {
  EXPECT_THAT(Refusal("/dev/zero"), HasSubstr("/dev/zero: line 1 is longer than 1048576 bytes"));
}

TEST_F(Lines, OfASmallFileThatUnpacksToALargeOneAreRefused) {
  WriteFile(path_, std::string(20'000'000, '\n'));
  ASSERT_EQ(std::system(("xz -0 " + path_).c_str()), 0);
  EXPECT_THAT(Refusal(path_ + ".xz", {.bytes = 1'000'000}),
              HasSubstr("longer than 1000000 bytes when unpacked"));
  EXPECT_EQ(Refusal(path_ + ".xz"), "read");
}

}  // namespace
}  // namespace levitas::session
