#include "session/output_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::session {
namespace {

using testing::HasSubstr;

/// Status and text of the refusal; "accepted" without one.
std::pair<ExitStatus, std::string> Refusal(const std::string& output, const std::string& input) {
  try {
    CheckOutputPath(output, input);
  } catch (const Problem& problem) {
    return {problem.status(), problem.what()};
  }
  return {ExitStatus::kDone, "accepted"};
}

class OutputPath : public testing::Test {
 protected:
  test::ScratchFolder scratch_;
};

TEST_F(OutputPath, AcceptsANewFileInAFolderThatExistsAndNoFileAtAll) {
  EXPECT_EQ(Refusal(scratch_ / "new.json", "").second, "accepted");
  EXPECT_EQ(Refusal("new.json", "").second, "accepted");  // here
  EXPECT_EQ(Refusal("", "").second, "accepted");
}

TEST_F(OutputPath, RefusesAFolderThatDoesNotExistBeforeAnyWorkIsDone) {
  const auto [status, text] = Refusal(scratch_ / "nowhere/new.json", "");
  EXPECT_EQ(status, ExitStatus::kBadInput);
  EXPECT_THAT(text, HasSubstr("nowhere: No such file or directory"));
}

TEST_F(OutputPath, RefusesAFileAsFolder) {
  std::ofstream(scratch_ / "file") << "x";
  EXPECT_EQ(Refusal(scratch_ / "file/new.json", "").first, ExitStatus::kBadInput);
}

TEST_F(OutputPath, RefusesToWriteOverWhatIsRead) {
  std::ofstream(scratch_ / "session") << "x";
  EXPECT_EQ(Refusal(scratch_ / "session", scratch_ / "./session").first, ExitStatus::kUsage);
  EXPECT_EQ(Refusal(scratch_ / "other", scratch_ / "session").second, "accepted");
}

}  // namespace
}  // namespace levitas::session
