// Controller and scenario that a rig file names for itself.

#include "configuration/run_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/problem.hpp"

namespace levitas::configuration {
namespace {

std::string Refusal(const RunDefaults& own) {
  try {
    return "found " + FindController(own, "", "flexible_rotor");
  } catch (const BadInput& problem) {
    return problem.what();
  }
}

TEST(RunFiles, AreTheGivenOneElseTheRigsOwnElseTheUsual) {
  const RunDefaults own{"geared_rotor", "lift"};
  EXPECT_TRUE(FindController(own, "flexible_rotor", "x").ends_with("/flexible_rotor.yaml"));
  EXPECT_TRUE(FindController(own, "", "flexible_rotor").ends_with("/geared_rotor.yaml"));
  EXPECT_TRUE(FindController({}, "", "flexible_rotor").ends_with("/flexible_rotor.yaml"));
}

TEST(RunFiles, AFileBesideTheRigIsFound) {
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / "run_files_law.yaml";
  std::ofstream(file) << "kind: controller\n";
  EXPECT_EQ(FindController({file.string(), ""}, "", "flexible_rotor"), file.string());
  std::filesystem::remove(file);
}

// A rig written into another folder, or into a session, still finds what it names.
TEST(RunFiles, OfARigThatIsReadAreWholePaths) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "own_rig";
  std::filesystem::create_directories(folder);
  RigFile rig = LoadRig(FindConfig("flexible_rotor", "rigs"));
  rig.run = {"./own.yaml", "levitate"};
  std::ofstream(folder / "rig.yaml") << WriteRig(rig);
  const std::filesystem::path from_here = std::filesystem::relative(folder / "rig.yaml");
  EXPECT_EQ(LoadRig(from_here.string()).run.controller, (folder / "own.yaml").string());
  std::filesystem::remove_all(folder);
}

TEST(RunFiles, AUsualControllerThatDoesNotFitIsNotBlamed) {
  RigFile rig = LoadRig(FindConfig("geared_rotor_8dof", "rigs"));
  const std::string usual = FindController({}, "", "flexible_rotor");
  rig.run = {};
  rig.numbers.bearings = {"front", "rear"};
  rig.numbers.channels = {"front_x", "front_y", "rear_x", "rear_y"};
  const auto refusal = [&](const std::string& given) -> std::string {
    try {
      static_cast<void>(LoadFound(usual, rig, given));
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "";
  };
  EXPECT_NE(refusal("").find("names no controller (run.controller)"), std::string::npos);
  EXPECT_EQ(refusal("").find(usual), std::string::npos);
  EXPECT_NE(refusal("flexible_rotor").find(usual), std::string::npos);  // named: to be mended
}

TEST(RunFiles, WhatIsMissingIsNamedWithItsKeyAndWhereAPathCountsFrom) {
  const std::string path = Refusal({"rigs/nothing.yaml", ""});
  EXPECT_NE(path.find("run.controller of the rig file: rigs/nothing.yaml: no such file"),
            std::string::npos)
      << path;
  EXPECT_NE(path.find("from the folder of that file"), std::string::npos) << path;
  const std::string name = Refusal({"my_law.yaml", ""});
  EXPECT_NE(name.find("run.controller"), std::string::npos) << name;
  EXPECT_NE(name.find("./my_law.yaml"), std::string::npos) << name;
}

}  // namespace
}  // namespace levitas::configuration
