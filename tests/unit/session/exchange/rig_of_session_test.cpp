#include "session/exchange/rig_of_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

class RigOfSessionTest : public ::testing::Test {
 protected:
  void WriteSessionOf(const std::string& rig_yaml) {
    SessionHeader header = testing::Header();
    header.rig_yaml = rig_yaml;
    testing::WriteSession(path_, testing::DrawRecords(3), header);
  }
  testing::Folder folder_;
  std::string path_{folder_ / "s.lcmlog"};
};

TEST_F(RigOfSessionTest, IsTheOneItsHeaderHoldsToTheLastDigit) {
  auto rig = configuration::LoadRig(test::SourceFolder() + "/config/rigs/flexible_rotor.yaml");
  rig.numbers.name = "that_of_the_session";  // so that no shipped file can stand in for it
  const std::string text = configuration::WriteRig(rig);
  WriteSessionOf(text);
  const auto found = RigOfSession(path_);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->numbers.name, "that_of_the_session");
  EXPECT_EQ(configuration::WriteRig(*found), text);
}

TEST_F(RigOfSessionTest, OfAHeaderThatNamesAnUnreadableRigIsRefusedByTheNameOfTheSession) {
  WriteSessionOf("name: of a rig to come\nunheard_of: 1\n");
  try {
    static_cast<void>(RigOfSession(path_));
    ADD_FAILURE() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), ::testing::HasSubstr(path_));
  }
}

TEST_F(RigOfSessionTest, IsNoneWhereThereIsNoSession) {
  EXPECT_FALSE(RigOfSession(folder_ / "missing.lcmlog"));
  testing::WriteFile(path_, "no session\n");
  EXPECT_FALSE(RigOfSession(path_));
  WriteSessionOf("");
  EXPECT_FALSE(RigOfSession(path_)) << "a header without a rig";
  const std::string csv = folder_ / "data.csv";
  testing::WriteFile(csv, "time_s\n0\n");
  EXPECT_FALSE(RigOfSession(csv));
}

}  // namespace
}  // namespace levitas::session
