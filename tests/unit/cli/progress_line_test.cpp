// The line that shows how far a long command is.

#include "cli/study/progress_line.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace levitas::cli {
namespace {

using std::chrono::seconds;

TEST(ProgressText, ShowsTheShareTheTimeAndTheWork) {
  EXPECT_EQ(ProgressText(0.5, seconds(102), "ranking").substr(0, 46),
            "[###############...............]  1:42 ranking");
  EXPECT_EQ(ProgressText(2.0, seconds(0), "").substr(0, 32), "[" + std::string(30, '#') + "]");
}

TEST(ProgressText, IsAsWideForEveryWorkSoThatItCoversTheLastOne) {
  EXPECT_EQ(ProgressText(0.1, seconds(5), "a").size(),
            ProgressText(0.9, seconds(600), std::string(200, 'x')).size());
}

TEST(ProgressLine, WritesNothingWhereThereIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    ProgressLine line(file, false);
    line.Show(0.5, "ranking");
  }
  EXPECT_EQ(std::ftell(file), 0L);
  std::fclose(file);
}

TEST(ProgressLine, IsGoneWhenItIsClosed) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    ProgressLine line(file, true);
    line.Show(0.5, "ranking");
    line.Show(0.2, "calibrating");  // never back
  }
  std::string text(static_cast<std::size_t>(std::ftell(file)), '\0');
  std::rewind(file);
  ASSERT_EQ(std::fread(text.data(), 1, text.size(), file), text.size());
  std::fclose(file);
  EXPECT_NE(text.find("[###############...............]  0:00 calibrating"), std::string::npos);
  EXPECT_EQ(text.substr(text.size() - 81), "\r" + std::string(79, ' ') + "\r");
}

}  // namespace
}  // namespace levitas::cli
