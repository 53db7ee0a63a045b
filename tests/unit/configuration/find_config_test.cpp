#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "tests/support/paths.hpp"

namespace levitas::configuration {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, and $LEVITAS_CONFIG as it was before.
class FindConfigIn : public testing::Test {
 protected:
  void SetUp() override {
    // The process number keeps test runs that share a machine apart.
    const char* name = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("levitas_" + std::to_string(getpid()) + name);
    fs::create_directories(folder_ / "rigs");
    unsetenv("LEVITAS_CONFIG");
  }
  void TearDown() override {
    unsetenv("LEVITAS_CONFIG");
    fs::remove_all(folder_);
  }
  fs::path Write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  fs::path folder_;
};

template <class Body>
std::string Said(Body body) {
  try {
    body();
  } catch (const BadInput& problem) {
    return problem.what();
  }
  return "";
}

TEST_F(FindConfigIn, TakesAPathAsItIs) {
  const std::string path = Write("mine.yaml", "kind: rig\n");
  EXPECT_EQ(FindConfig(path, "rigs"), path);
}

TEST_F(FindConfigIn, FindsShippedFilesByName) {
  EXPECT_EQ(fs::canonical(FindConfig("flexible_rotor", "rigs")),
            fs::canonical(levitas::test::SourceFolder() + "/config/rigs/flexible_rotor.yaml"));
}

TEST_F(FindConfigIn, PrefersTheFolderOfTheEnvironment) {
  const std::string path = Write("rigs/flexible_rotor.yaml", "kind: rig\n");
  setenv("LEVITAS_CONFIG", folder_.c_str(), 1);
  EXPECT_EQ(FindConfig("flexible_rotor", "rigs"), path);
}

TEST_F(FindConfigIn, ListsWhatThereIsAndTheNearest) {
  Write("rigs/pump.yaml", "");
  Write("rigs/rotor.yaml", "");
  setenv("LEVITAS_CONFIG", folder_.c_str(), 1);
  EXPECT_EQ(Said([] { (void)FindConfig("pmup", "rigs"); }),
            "pmup: no such file, and none of that name among the rigs in " +
                (folder_ / "rigs").string() + " (pump, rotor); nearest pump");
}

TEST_F(FindConfigIn, RefusesAnEmptyName) {
  EXPECT_NE(Said([] { (void)FindConfig("", "rigs"); }), "");
}

TEST_F(FindConfigIn, AFolderOrAMissingFileCannotBeLoaded) {
  EXPECT_EQ(Said([] { (void)LoadRig("/no/such/file.yaml"); }),
            "/no/such/file.yaml: cannot be read; give the path of a file");
  EXPECT_EQ(Said([&] { (void)LoadRig(folder_); }),
            folder_.string() + ": cannot be read; give the path of a file");
}

TEST_F(FindConfigIn, AnEmptyFileIsSaidToBeEmpty) {
  const std::string path = Write("empty.yaml", "");
  EXPECT_EQ(Said([&] { (void)LoadRig(path); }), path + ":1:1: the file is empty");
}

}  // namespace
}  // namespace levitas::configuration
