// Controller and scenario that a rig file names for itself.

#include "configuration/run_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/problem.hpp"

namespace levitas::config {
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
}  // namespace levitas::config
