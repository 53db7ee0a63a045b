#include "common/output_file.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace levitas {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void Put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

template <class Work>
std::pair<ExitStatus, std::string> Refusal(const Work& work) {
  try {
    work();
  } catch (const Problem& problem) {
    return {problem.status(), problem.what()};
  }
  return {ExitStatus::kDone, "accepted"};
}

class Output : public testing::Test {
 protected:
  [[nodiscard]] std::ptrdiff_t Files() const {
    return std::distance(fs::directory_iterator(fs::path(scratch_ / "x").parent_path()), {});
  }
  test::ScratchFolder scratch_;
};

TEST_F(Output, AppearsUnderItsNameOnlyWithCommit) {
  {
    OutputFile file(scratch_ / "x.csv");
    file.Write("half");
    EXPECT_FALSE(fs::exists(scratch_ / "x.csv"));
  }
  EXPECT_EQ(Files(), 0) << "nothing is left of what was not committed";
  WriteWholeFile(scratch_ / "x.csv", "whole");
  EXPECT_EQ(Content(scratch_ / "x.csv"), "whole");
  EXPECT_EQ(Files(), 1);
}

TEST_F(Output, KeepsAnEarlierTextOfOtherContentBesideIt) {
  const std::string path = scratch_ / "law.yaml";
  WriteWholeFile(path, "one");
  WriteWholeFile(path, "one");
  EXPECT_TRUE(TakeKeptNames().empty()) << "the same text is nothing to be kept";
  WriteWholeFile(path, "two");
  EXPECT_EQ(Content(path), "two");
  EXPECT_EQ(Content(path + ".old"), "one");
  EXPECT_EQ(TakeKeptNames(), std::vector<std::string>{path + ".old"});
  EXPECT_TRUE(TakeKeptNames().empty()) << "told once";
  WriteWholeFile(path, "six");  // as long as "two"
  EXPECT_EQ(Content(path + ".old"), "two");
  WriteWholeFile(path, "four", Earlier::kReplaced);
  EXPECT_EQ(Content(path + ".old"), "two");
  EXPECT_EQ(TakeKeptNames().size(), 1U);
  EXPECT_EQ(Files(), 2);
}

TEST_F(Output, IsAsItWasWhereTheEarlierTextCannotBeKept) {
  const std::string path = scratch_ / "law.yaml";
  WriteWholeFile(path, "one");
  fs::create_directory(path + ".old");
  EXPECT_THROW(WriteWholeFile(path, "two"), BadInput);
  EXPECT_EQ(Content(path), "one");
  EXPECT_EQ(Files(), 2);
  EXPECT_TRUE(TakeKeptNames().empty());
}

TEST_F(Output, UnderItsNameIsNeverMadeThroughALink) {
  Put(scratch_ / "target", "the user's own");
  for (const char* target : {"target", "nowhere"}) {
    fs::create_symlink(scratch_ / target, scratch_ / "link");
    EXPECT_THROW((void)OpenUnderItsName(scratch_ / "link", Standing::kKept), BadInput);
    EXPECT_TRUE(fs::is_symlink(scratch_ / "link"));
    const int file = OpenUnderItsName(scratch_ / "link", Standing::kReplaced);
    EXPECT_EQ(::write(file, "new", 3), 3);
    ::close(file);
    EXPECT_FALSE(fs::is_symlink(scratch_ / "link"));
    EXPECT_EQ(Content(scratch_ / "link"), "new");
    fs::remove(scratch_ / "link");
  }
  EXPECT_EQ(Content(scratch_ / "target"), "the user's own");
  EXPECT_FALSE(fs::exists(scratch_ / "nowhere"));
}

// To open it for writing as any file waits for a reader, whatever signal comes that has a handler.
TEST_F(Output, APipeIsOpenedWhereItIsReadAndRefusedWhereItIsNot) {
  const std::string pipe = scratch_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& open :
       std::vector<std::function<void()>>{[&] { ::close(OpenUnderItsName(pipe, Standing::kKept)); },
                                          [&] { EXPECT_TRUE(RefuseDeafPipe(pipe).is_open()); }}) {
    const auto refused = Refusal(open);
    EXPECT_EQ(refused.first, ExitStatus::kBadInput);
    EXPECT_THAT(refused.second, HasSubstr("a pipe that nobody reads. Start its reader first"));
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    EXPECT_EQ(Refusal(open).second, "accepted");
    ::close(reader);
  }
  EXPECT_FALSE(RefuseDeafPipe(scratch_ / "no pipe").is_open());
}

TEST_F(Output, UnderItsNameReplacesAFileAndNotWhatAnotherNameOfItHolds) {
  Put(scratch_ / "old", "old");
  fs::create_hard_link(scratch_ / "old", scratch_ / "kept");
  EXPECT_THROW((void)OpenUnderItsName(scratch_ / "old", Standing::kKept), BadInput);
  ::close(OpenUnderItsName(scratch_ / "old", Standing::kReplaced));
  EXPECT_EQ(Content(scratch_ / "old"), "");
  EXPECT_EQ(Content(scratch_ / "kept"), "old");
  EXPECT_THROW((void)OpenUnderItsName(scratch_ / "", Standing::kReplaced), BadInput);  // a folder
}

TEST_F(Output, LeavesAFileOfTheUsersWithItsTemporarySuffixAlone) {
  Put(scratch_ / "x.csv.part", "the user's own");
  WriteWholeFile(scratch_ / "x.csv", "whole");
  EXPECT_EQ(Content(scratch_ / "x.csv.part"), "the user's own");
}

TEST_F(Output, TwoWritersOfOneNameDoNotMix) {
  OutputFile first(scratch_ / "x");
  OutputFile second(scratch_ / "x");
  first.Write("first");
  second.Write("second");
  first.Commit();
  EXPECT_EQ(Content(scratch_ / "x"), "first");
  second.Commit();
  EXPECT_EQ(Content(scratch_ / "x"), "second");
}

TEST_F(Output, TemporaryNamesAreNotGuessedFromOneAnother) {
  const PartFile first(scratch_ / "x");
  const PartFile second(scratch_ / "x");
  EXPECT_NE(first.part_path(), second.part_path());
  EXPECT_THAT(first.part_path(), testing::EndsWith(".part"));
}

TEST_F(Output, ReplacesASymbolicLinkAndSparesItsTarget) {
  Put(scratch_ / "precious", "keep");
  fs::create_symlink(scratch_ / "precious", scratch_ / "x.csv");
  WriteWholeFile(scratch_ / "x.csv", "whole");
  EXPECT_EQ(Content(scratch_ / "precious"), "keep");
  EXPECT_FALSE(fs::is_symlink(scratch_ / "x.csv"));
  EXPECT_EQ(Content(scratch_ / "x.csv"), "whole");
}

TEST_F(Output, AFullDiskIsStatusOneAndSaysSo) {
  const auto [status, text] = Refusal([] { WriteWholeFile("/dev/full", "x"); });
  EXPECT_EQ(status, ExitStatus::kOther);
  EXPECT_THAT(text, HasSubstr("/dev/full: writing failed: No space left on device"));
}

TEST_F(Output, ALimitOnTheSizeOfFilesIsStatusOneAndLeavesNothing) {
  struct rlimit before {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const struct rlimit small { .rlim_cur = 1000, .rlim_max = before.rlim_max };
  ::setrlimit(RLIMIT_FSIZE, &small);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const auto [status, text] =
      Refusal([&] { WriteWholeFile(scratch_ / "x", std::string(100'000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(status, ExitStatus::kOther);
  EXPECT_THAT(text, HasSubstr("File too large"));
  EXPECT_EQ(Files(), 0);
}

TEST_F(Output, AFolderAndAMissingFolderAreBadInput) {
  for (const std::string& path : {scratch_ / "", scratch_ / "none/x"}) {
    const auto [status, text] = Refusal([&] { WriteWholeFile(path, "x"); });
    EXPECT_EQ(status, ExitStatus::kBadInput) << path;
    EXPECT_THAT(text, HasSubstr(path));
  }
}

TEST_F(Output, ADeviceIsWrittenAndStays) {
  WriteWholeFile("/dev/null", "x");
  struct stat status {};
  ASSERT_EQ(::stat("/dev/null", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

}  // namespace
}  // namespace levitas
