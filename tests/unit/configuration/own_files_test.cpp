// A rig file of a user: files that it names beside it, and what it may leave out.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "configuration/text/read_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::configuration {
namespace {

using testing::HasSubstr;

std::string Shipped(const std::string& kind, const std::string& name) {
  return ReadText(FindConfig(name, kind));
}

std::string WithRun(const std::string& controller, const std::string& scenario) {
  return Shipped("rigs", "flexible_rotor") + "\nrun:\n  controller: " + controller +
         "\n  scenario: " + scenario + "\n";
}

std::string WithoutKeys(std::string text, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    for (auto at = text.find(key + ":"); at != std::string::npos; at = text.find(key + ":")) {
      const auto begin = text.rfind('\n', at) + 1;
      text.erase(begin, text.find('\n', at) + 1 - begin);
    }
  }
  return text;
}

class OwnFiles : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    const std::string path = folder_ / name;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream(path) << text;
    return path;
  }
  levitas::test::ScratchFolder folder_;
};

TEST_F(OwnFiles, AreNamedByAPathFromTheFolderOfTheRigFile) {
  const std::string path = Write("rigs/own.yaml", WithRun("../laws/my law.yaml", "./s.yaml"));
  const RigFile rig = LoadRig(path);
  EXPECT_EQ(rig.run.controller, folder_ / "laws/my law.yaml");
  EXPECT_EQ(rig.run.scenario, folder_ / "rigs/s.yaml");
  // As a session's header holds it, the text is read again to the same paths.
  EXPECT_EQ(ParseRig(WriteRig(rig), "header").run.controller, rig.run.controller);
}

TEST_F(OwnFiles, AShippedNameAndAWholePathStayAsTheyAre) {
  const RigFile rig = LoadRig(Write("own.yaml", WithRun("flexible_rotor", "/etc/s.yaml")));
  EXPECT_EQ(rig.run.controller, "flexible_rotor");
  EXPECT_EQ(rig.run.scenario, "/etc/s.yaml");
}

TEST_F(OwnFiles, APathWithControlCharactersIsRefused) {
  try {
    static_cast<void>(ParseRig(WithRun("\"a\\x07b\"", "s"), "own.yaml"));
    FAIL();
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr("a text of 1 to 1000 characters"));
  }
}

TEST_F(OwnFiles, MayLeaveOutWhatATouchdownBearingUsuallyIsButNotItsClearance) {
  const std::string text = Shipped("rigs", "flexible_rotor");
  const std::vector<std::string> usual{"stiffness_n_per_m", "damping_n_s_per_m", "friction",
                                       "journal_radius_mm"};
  const auto touchdown = ParseRig(WithoutKeys(text, usual), "own.yaml").plant.bearings[1].touchdown;
  EXPECT_EQ(touchdown.stiffness_n_per_m, 2e7);
  EXPECT_EQ(touchdown.damping_n_s_per_m, 2000.0);
  EXPECT_EQ(touchdown.friction, 0.05);
  EXPECT_EQ(touchdown.journal_radius_m, 0.015);
  EXPECT_THROW(static_cast<void>(ParseRig(WithoutKeys(text, {"clearance_um"}), "own.yaml")),
               BadInput);
}

}  // namespace
}  // namespace levitas::configuration
