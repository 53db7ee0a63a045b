#include "cli/run/run_folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>  // setenv

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

class RunFolderTest : public testing::Test {
 protected:
  RunFolderTest() { setenv("TMPDIR", (scratch_ / "").c_str(), 1); }
  ~RunFolderTest() override { unsetenv("TMPDIR"); }
  RunFolderTest(const RunFolderTest&) = delete;
  RunFolderTest& operator=(const RunFolderTest&) = delete;

  /// A folder as a tripped run leaves it, `age` hours ago.
  std::string Tripped(int age) {
    RunFolder folder;
    std::ofstream(folder / "session.lcmlog") << "record";
    folder.Keep();
    fs::last_write_time(folder.path(), fs::file_time_type::clock::now() - std::chrono::hours(age));
    return folder.path();
  }

  test::ScratchFolder scratch_;
};

TEST_F(RunFolderTest, IsRemovedUnlessItIsKept) {
  std::string path;
  {
    const RunFolder folder;
    path = folder.path();
    EXPECT_TRUE(fs::is_directory(path));
  }
  EXPECT_FALSE(fs::exists(path));
  EXPECT_TRUE(fs::is_directory(Tripped(0)));
}

TEST_F(RunFolderTest, LeavesTheNewestOfThoseThatWereKept) {
  std::vector<std::string> kept;
  for (int age = 20; age > 0; --age) kept.push_back(Tripped(age));
  const RunFolder folder;
  std::size_t there = 0;
  for (const std::string& path : kept) there += fs::exists(path) ? 1U : 0U;
  EXPECT_EQ(there, RunFolder::kKept);
  EXPECT_TRUE(fs::exists(kept.back()));
  EXPECT_FALSE(fs::exists(kept.front()));
}

TEST_F(RunFolderTest, TouchesNoFolderOfARunThatIsUnderWay) {
  const RunFolder running;
  fs::last_write_time(running.path(), fs::file_time_type::clock::now() - std::chrono::hours(1000));
  for (int age = 20; age > 0; --age) Tripped(age);
  EXPECT_TRUE(fs::is_directory(running.path()));
}

TEST_F(RunFolderTest, TouchesNothingThatIsNotItsOwn) {
  const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1000);
  const std::string without_lock = scratch_ / "amb-run-abcdef";
  const std::string other_name = scratch_ / "amb-run-notes";
  const std::string target = scratch_ / "precious";
  for (const std::string& path : {without_lock, other_name, target}) fs::create_directory(path);
  for (const std::string& path : {other_name, target}) std::ofstream(path + "/run.lock") << "x";
  fs::create_directory_symlink(target, scratch_ / "amb-run-linked");
  for (const std::string& path : {without_lock, other_name, target}) fs::last_write_time(path, old);
  for (int age = 20; age > 0; --age) Tripped(age);
  for (const std::string& path : {without_lock, other_name, target + "/run.lock"}) {
    EXPECT_TRUE(fs::exists(path)) << path;
  }
  EXPECT_TRUE(fs::is_symlink(scratch_ / "amb-run-linked"));
}

}  // namespace
}  // namespace levitas::cli
