// Which rig a command takes for the records it reads, and what it says of one that differs.

#include "cli/options/rig_of_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "common/problem.hpp"
#include "plant_sim/effect/catalogue.hpp"
#include "rt/say.hpp"
#include "session/exchange/csv_import.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

configuration::RigFile Shipped(const std::string& name) {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

configuration::RigFile Heavy() {
  configuration::RigFile rig = Shipped("flexible_rotor");
  rig.numbers.name = "heavy";
  rig.plant.rotor.discs[1].mass_kg = 1.5;
  return rig;
}

class RigOfRecordsTest : public testing::Test {
 protected:
  /// A session of `rig` without a single sample: what it says of its rig is all that is read.
  std::string Session(const std::string& name, const configuration::RigFile& rig) {
    session::ImportOptions options;
    options.out_path = folder_ / name;
    options.rig = rig.numbers;
    options.rig_yaml = configuration::WriteRig(rig);
    session::WriteImport(options, [](const session::RecordTaker&) {});
    return options.out_path;
  }

  /// The rig that the command line and the records give, and what is said on the way.
  configuration::RigFile Given(std::vector<std::string> line,
                               const std::vector<std::string>& records) {
    CLI::App app;
    AnalysisOptions options;
    AddRigOfRecordsOption(app, options);
    std::reverse(line.begin(), line.end());
    app.parse(line);
    testing::internal::CaptureStderr();
    configuration::RigFile rig = LoadRigOfRecords(options, records);
    static_cast<void>(rt::FlushSaid());
    said_ = testing::internal::GetCapturedStderr();
    return rig;
  }

  test::ScratchFolder folder_;
  std::string said_;
};

TEST_F(RigOfRecordsTest, IsTheSessionsOwnWithoutAWord) {
  const std::string heavy = Session("heavy.lcm", Heavy());
  EXPECT_EQ(Given({}, {heavy}).plant.rotor.discs[1].mass_kg, 1.5);
  EXPECT_EQ(said_, "");
  EXPECT_EQ(Given({"--rig", "flexible_rotor"}, {Session("usual.lcm", Shipped("flexible_rotor"))})
                .numbers.name,
            "flexible_rotor");
  EXPECT_EQ(said_, "");
}

TEST_F(RigOfRecordsTest, IsAnotherOnlyWithAWarningThatNamesBoth) {
  const std::string heavy = Session("heavy.lcm", Heavy());
  EXPECT_NE(Given({"--rig", "flexible_rotor"}, {heavy}).plant.rotor.discs[1].mass_kg, 1.5);
  EXPECT_THAT(said_, AllOf(HasSubstr("warning"), HasSubstr("heavy.lcm was recorded with rig heavy"),
                           HasSubstr("--rig names flexible_rotor"),
                           HasSubstr("mass_kg: 1.5 in the session")));
}

TEST_F(RigOfRecordsTest, IsTheUsualOneForRecordsThatHoldNone) {
  EXPECT_EQ(Given({}, {folder_ / "data.csv"}).numbers.name, "flexible_rotor");
  EXPECT_EQ(Given({}, {folder_ / "data.csv", Session("heavy.lcm", Heavy())}).numbers.name, "heavy");
}

TEST_F(RigOfRecordsTest, HasToBeNamedForSessionsOfSeveral) {
  const std::string heavy = Session("heavy.lcm", Heavy());
  const std::string usual = Session("usual.lcm", Shipped("flexible_rotor"));
  try {
    static_cast<void>(LoadRigOfRecords({}, {heavy, usual}));
    FAIL() << "taken for one rig";
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(),
                AllOf(HasSubstr("rig heavy"), HasSubstr("flexible_rotor"), HasSubstr("--rig")));
  }
  EXPECT_EQ(Given({"--rig", "flexible_rotor"}, {heavy, usual}).numbers.name, "flexible_rotor");
}

TEST_F(RigOfRecordsTest, TellsEffectsThatTheModelThenHasToo) {
  configuration::RigFile cracked = Shipped("flexible_rotor");
  cracked.plant.effects.push_back(effect::ClearEntry(effect::Id::kBreathingCrack));
  const std::string session = Session("cracked.lcm", cracked);
  EXPECT_EQ(Given({}, {session}).plant.effects.size(), 1U);
  EXPECT_THAT(said_, HasSubstr("effects of its own (breathing_crack)"));
}

TEST(RigDifference, IsTheFirstValueWithItsGroups) {
  configuration::RigFile other = Shipped("flexible_rotor");
  EXPECT_EQ(RigDifference(Shipped("flexible_rotor"), other), "");
  other.numbers.name = "renamed";
  other.run.controller = "another";
  EXPECT_EQ(RigDifference(Shipped("flexible_rotor"), other), "");
  other.plant.bearings[1].sensor.noise_rms_m = 2e-6;
  EXPECT_EQ(RigDifference(Shipped("flexible_rotor"), other),
            "first difference: bearings, nde, sensor, noise_rms_um: 1 in the session, "
            "noise_rms_um: 2 in the file");
}

}  // namespace
}  // namespace levitas::cli
