#include "programs/controller/controller_options.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

namespace levitas::controller_program {
namespace {

struct Read {
  bool goes_on{};
  ControllerOptions options;
  ExitStatus status{ExitStatus::kDone};
};

/// With the two options that every run needs.
Read With(std::initializer_list<const char*> more) {
  std::vector<std::string> words{"amb-controller", "--rig", "r", "--controller", "c"};
  words.insert(words.end(), more.begin(), more.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  Read read;
  read.goes_on =
      ReadCommandLine(static_cast<int>(argv.size()), argv.data(), read.options, read.status);
  return read;
}

TEST(ControllerOptions, WithoutMoreRunInLockstepOverLcmWithoutARecord) {
  const Read read = With({});
  ASSERT_TRUE(read.goes_on);
  EXPECT_EQ(read.options.rig, "r");
  EXPECT_EQ(read.options.controller, "c");
  EXPECT_EQ(read.options.port, "lcm");
  EXPECT_FALSE(read.options.realtime);
  EXPECT_EQ(read.options.record, "");
  EXPECT_EQ(read.options.commands, transport::CommandWish::kDefault);
}

TEST(ControllerOptions, TakeThePaceByItsName) {
  EXPECT_TRUE(With({"--pace", "realtime"}).options.realtime);
  EXPECT_FALSE(With({"--pace", "lockstep"}).options.realtime);
  EXPECT_FALSE(With({"--pace", "paced"}).options.realtime);
  EXPECT_FALSE(With({"--pace", "fast"}).goes_on);
}

TEST(ControllerOptions, TakeTheBudgetOfTripFilesAsFilesAndMegabytes) {
  const Read read = With({"--trip-budget", "7", "55"});
  ASSERT_TRUE(read.goes_on);
  EXPECT_EQ(read.options.trip_budget, (std::vector<std::size_t>{7, 55}));
  EXPECT_FALSE(With({"--trip-budget", "7"}).goes_on);
  EXPECT_FALSE(With({"--trip-budget", "0", "55"}).goes_on);
}

TEST(ControllerOptions, AllowOneWishAboutCommandsAndNotBoth) {
  EXPECT_EQ(With({"--no-commands"}).options.commands, transport::CommandWish::kNo);
  EXPECT_EQ(With({"--commands"}).options.commands, transport::CommandWish::kYes);
  EXPECT_FALSE(With({"--commands", "--no-commands"}).goes_on);
}

TEST(ControllerOptions, RefuseWhatIsNoTimeNoNumberOrNoOptionAsAMistakeOfUse) {
  for (const auto& words : {std::initializer_list<const char*>{"--duration", "-1"},
                            {"--duration", "soon"},
                            {"--seed", "1.5"},
                            {"--processor", "-2"},
                            {"--recrod", "x"}}) {
    const Read read = With(words);
    EXPECT_FALSE(read.goes_on) << *words.begin();
    EXPECT_EQ(read.status, ExitStatus::kUsage) << *words.begin();
  }
}

TEST(ControllerOptions, HelpEndsTheProgramAndIsNoMistake) {
  const Read read = With({"--help"});
  EXPECT_FALSE(read.goes_on);
  EXPECT_EQ(read.status, ExitStatus::kDone);
}

// The rig's file would be gone.
TEST(ControllerOptions, RefuseToWriteOverWhatTheyRead) {
  EXPECT_THROW((void)With({"--record", "r"}), Problem);
  EXPECT_THROW((void)With({"--json", "c"}), Problem);
}

TEST(ControllerOptions, ReplaceASessionThatIsThereOnlyWhenAskedTo) {
  const levitas::test::ScratchFolder folder;
  const std::string path = folder / "run.levitas";
  std::ofstream(path) << "recorded before";
  EXPECT_THROW((void)With({"--record", path.c_str()}), Problem);
  EXPECT_TRUE(With({"--record", path.c_str(), "--overwrite"}).goes_on);
}

}  // namespace
}  // namespace levitas::controller_program
