#include "session/log/output_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::session {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// Status and text of the refusal; "accepted" without one.
std::pair<ExitStatus, std::string> Refusal(const std::string& output, const std::string& input) {
  try {
    CheckOutputPath(output, input);
  } catch (const Problem& problem) {
    return {problem.status(), problem.what()};
  }
  return {ExitStatus::kDone, "accepted"};
}

class OutputPath : public ::testing::Test {
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

/// The refusal of a command that reads `read` and writes `one` and `other`.
std::string Clash(const std::string& read, const std::string& one, const std::string& other) {
  try {
    RefuseClash({{"--csv", one}, {"--json", other}}, {{"DATA", read}});
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
    return problem.what();
  }
  return "accepted";
}

TEST_F(OutputPath, RefusesTwoOutputsThatAreOneFileHoweverItIsNamed) {
  std::ofstream(scratch_ / "there") << "x";
  std::filesystem::create_symlink(scratch_ / "there", scratch_ / "link");
  std::filesystem::create_hard_link(scratch_ / "there", scratch_ / "inode");
  for (const auto& [one, other] : {std::pair{"new", "new"},
                                   {"new", "./new"},
                                   {"new", "../"},
                                   {"there", "link"},
                                   {"there", "inode"},
                                   {"link", "inode"}}) {
    const std::string second =
        std::string(other) == "../" ? scratch_ / "sub/../new" : scratch_ / other;
    EXPECT_THAT(Clash("", scratch_ / one, second),
                AllOf(HasSubstr("--csv"), HasSubstr("--json"), HasSubstr("the same file")))
        << one << " " << other;
  }
  EXPECT_EQ(Clash("", scratch_ / "new", scratch_ / "other"), "accepted");
  EXPECT_EQ(Clash("", scratch_ / "new", scratch_ / "there"), "accepted");
  EXPECT_EQ(Clash("", "", ""), "accepted");
}

TEST_F(OutputPath, RefusesAnOutputThatIsReadAndNamesBoth) {
  std::ofstream(scratch_ / "there") << "x";
  EXPECT_THAT(Clash(scratch_ / "there", "", scratch_ / "./there"),
              AllOf(HasSubstr("--json"), HasSubstr("DATA"), HasSubstr("would be lost")));
}

TEST_F(OutputPath, LetsADeviceTakeAll) {
  EXPECT_EQ(Clash("/dev/null", "/dev/null", "/dev/null"), "accepted");
}

TEST_F(OutputPath, RefusesARecordThroughALinkUnlessItMayBeReplaced) {
  std::filesystem::create_symlink(scratch_ / "nowhere", scratch_ / "link");
  EXPECT_THROW(CheckNoRecording(scratch_ / "link", false), Problem);
  EXPECT_NO_THROW(CheckNoRecording(scratch_ / "link", true));
  std::filesystem::create_symlink("/dev/null", scratch_ / "device");
  EXPECT_NO_THROW(CheckNoRecording(scratch_ / "device", false));
}

}  // namespace
}  // namespace levitas::session
