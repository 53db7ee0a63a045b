// The folder of an answer: made when needed, gone when nothing came of it, never another's.

#include "cli/study/answer_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "cli/study/diagnosis_inputs.hpp"
#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class AnswerFolderTest : public testing::Test {
 protected:
  [[nodiscard]] std::string At(const std::string& name) const { return folder_ / name; }
  std::string Write(const std::string& name, const std::string& text) {
    std::ofstream(At(name)) << text;
    return At(name);
  }
  test::ScratchFolder folder_;
};

TEST_F(AnswerFolderTest, IsMadeWithAllFoldersAboveItAndTheyGoWhenItStaysEmpty) {
  {
    const AnswerFolder answer(At("a/b/c"));
    EXPECT_TRUE(fs::is_directory(At("a/b/c")));
  }
  EXPECT_FALSE(fs::exists(At("a")));
}

TEST_F(AnswerFolderTest, StaysWithEverythingAboveItWhenItHoldsAnAnswer) {
  {
    const AnswerFolder answer(At("a/b"));
    Write("a/b/report.html", "answer");
  }
  EXPECT_TRUE(fs::exists(At("a/b/report.html")));
}

TEST_F(AnswerFolderTest, ThatWasThereBeforeStaysEvenWhenItIsEmpty) {
  fs::create_directories(At("mine/empty"));
  { const AnswerFolder answer(At("mine/empty")); }
  EXPECT_TRUE(fs::is_directory(At("mine/empty")));
}

TEST_F(AnswerFolderTest, WithASlashBehindItIsTheSameFolder) {
  {
    const AnswerFolder answer(At("d/"));
    EXPECT_TRUE(fs::is_directory(At("d")));
  }
  EXPECT_FALSE(fs::exists(At("d")));
}

TEST_F(AnswerFolderTest, UnderAFileIsRefusedWithTheOptionAndThePath) {
  Write("file", "no folder");
  try {
    const AnswerFolder answer(At("file/answer"));
    FAIL() << "a folder below a file";
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(),
                AllOf(HasSubstr("--out"), HasSubstr("file/answer"), HasSubstr("name another")));
  }
  EXPECT_TRUE(fs::is_regular_file(At("file")));
}

using SameFilesTest = AnswerFolderTest;

std::string Refusal(const std::vector<std::string>& data, const std::vector<std::string>& holdout,
                    const std::vector<std::string>& healthy) {
  try {
    RefuseSameFiles(data, holdout, healthy);
    return {};
  } catch (const BadInput& refused) {
    return refused.what();
  }
}

TEST_F(SameFilesTest, DifferentRecordsAreTakenInEveryRole) {
  // The last two are as long as each other and differ in the last byte.
  const std::string standing = Write("standing.csv", "rows of one");
  const std::string spinning = Write("spinning.csv", "rows of it 1");
  const std::string earlier = Write("earlier.csv", "rows of it 2");
  EXPECT_EQ(Refusal({standing}, {spinning}, {earlier}), "");
}

TEST_F(SameFilesTest, OneRecordGivenTwiceWouldCountTwice) {
  const std::string one = Write("one.csv", "rows");
  EXPECT_THAT(Refusal({one, one}, {}, {}), HasSubstr("evidence would count twice"));
}

TEST_F(SameFilesTest, ACopyUnderAnotherNameIsTheSameData) {
  const std::string one = Write("one.csv", "rows");
  const std::string copy = Write("copy.csv", "rows");
  EXPECT_THAT(Refusal({one, copy}, {}, {}), AllOf(HasSubstr("copy.csv"), HasSubstr("one.csv")));
  EXPECT_THAT(Refusal({one}, {copy}, {}), HasSubstr("--holdout"));
  EXPECT_THAT(Refusal({one}, {}, {copy}), HasSubstr("--healthy"));
}

TEST_F(SameFilesTest, ALinkToARecordIsThatRecord) {
  const std::string one = Write("one.csv", "rows");
  fs::create_symlink(one, At("link.csv"));
  EXPECT_THAT(Refusal({one}, {At("link.csv")}, {}), HasSubstr("what was fitted cannot judge"));
}

TEST_F(SameFilesTest, AFileThatIsNotThereIsLeftToItsReader) {
  const std::string one = Write("one.csv", "rows");
  EXPECT_EQ(Refusal({one, At("absent.csv")}, {At("absent too.csv")}, {}), "");
}

}  // namespace
}  // namespace levitas::cli
