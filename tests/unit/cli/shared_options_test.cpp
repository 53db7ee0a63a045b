// What the commands of amb share: options, JSON files, and what they say about a session.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/commands/session_text.hpp"
#include "cli/commands/what_if_csv.hpp"
#include "cli/json_file.hpp"
#include "cli/options/analysis_options.hpp"
#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The options of an analysis command after this command line; throws what CLI11 throws.
AnalysisOptions Parsed(const std::string& line, std::vector<double> default_rpm = {0.0}) {
  CLI::App app;
  AnalysisOptions options;
  AddRigOption(app, options);
  AddControllerOption(app, options);
  AddSpeedOption(app, options, std::move(default_rpm));
  AddJsonOption(app, options);
  app.parse(line);
  return options;
}

TEST(AnalysisOptions, AreTheShippedRigAndTheCommandsOwnSpeedsWithoutAnyWord) {
  const AnalysisOptions options = Parsed("", {0.0, 6000.0});
  EXPECT_EQ(options.rig_name, "flexible_rotor");
  EXPECT_EQ(options.controller_name, "");
  EXPECT_THAT(options.speeds_rpm, ElementsAre(0.0, 6000.0));
  EXPECT_EQ(options.json_path, "");
}

TEST(AnalysisOptions, TakeTheControllerThatTheRigNamesUnlessOneIsAskedFor) {
  AnalysisOptions options = Parsed("");
  EXPECT_EQ(LoadController(options, LoadRig(options)).file.name, "flexible_rotor");
  options = Parsed("--rig geared_rotor_4dof");
  EXPECT_EQ(LoadController(options, LoadRig(options)).file.name, "geared_rotor");
  options = Parsed("--rig geared_rotor_4dof --controller geared_rotor_passive");
  EXPECT_EQ(LoadController(options, LoadRig(options)).file.name, "geared_rotor_passive");
}

TEST(AnalysisOptions, TellTheControllersFileAndThatAmbRunTakesAnotherOnlyWhereItDoes) {
  const auto note = [](const std::string& line) {
    const AnalysisOptions options = Parsed(line);
    return GainsNote(options, LoadRig(options));
  };
  const AnalysisOptions options = Parsed("");
  EXPECT_THAT(ControllerText(LoadController(options, LoadRig(options))),
              HasSubstr("controllers/flexible_rotor.yaml"));
  EXPECT_THAT(note(""), HasSubstr("--controller flexible_rotor_commissioned"));
  // Asked for, or named by the rig file and so taken by amb run as well.
  EXPECT_EQ(note("--controller flexible_rotor"), "");
  EXPECT_EQ(note("--rig geared_rotor_4dof"), "");
}

TEST(AnalysisOptions, TakeSeveralSpeedsInEveryWayAndDropTheDefault) {
  for (const char* line :
       {"--speed-rpm 0,1500,-3e3", "--speeds 0 1500 -3e3", "--speed-rpm=0,1500 --speed-rpm -3e3"}) {
    EXPECT_THAT(Parsed(line, {42.0}).speeds_rpm, ElementsAre(0.0, 1500.0, -3000.0)) << line;
  }
}

TEST(AnalysisOptions, RefuseASpeedThatNoRotorHasAndSayWhatIsAllowed) {
  for (const char* word : {"nan", "inf", "-inf", "fast", "1e999", "30rpm"}) {
    try {
      (void)Parsed(std::string("--speed-rpm 0,") + word);
      ADD_FAILURE() << word << " was accepted";
    } catch (const CLI::ParseError& error) {
      EXPECT_THAT(error.what(), HasSubstr("'" + std::string(word) + "'")) << word;
      EXPECT_THAT(error.what(), HasSubstr("-1e6 to 1e6 revolutions per minute")) << word;
    }
  }
}

TEST(AnalysisOptions, LoadTheShippedFilesByName) {
  const AnalysisOptions options = Parsed("");
  const configuration::RigFile rig = LoadRig(options);
  EXPECT_EQ(rig.numbers.name, "flexible_rotor");
  EXPECT_EQ(LoadController(options, rig).file.law.axes.size(), rig.numbers.axes());
  EXPECT_THROW((void)LoadRig(Parsed("--rig flexible_roter")), BadInput);
}

TEST(JsonFile, HoldsTheContentInItsOrderWithEveryBit) {
  const test::ScratchFolder folder;
  const nlohmann::ordered_json content{{"zeta", 0.1 + 0.2}, {"alpha", {1, 2}}, {"name", "µ\"\\"}};
  NameJson("margins");
  WriteJsonFile(folder / "out.json", content);
  std::ifstream file(folder / "out.json");
  auto read = nlohmann::ordered_json::parse(file);
  EXPECT_EQ(read.begin().key(), "schema");
  EXPECT_EQ(read["schema"], "levitas_margins_1");
  EXPECT_TRUE(read["version"].is_string());
  read.erase("schema");
  read.erase("version");
  EXPECT_EQ(read, content);
  EXPECT_EQ(read.begin().key(), "zeta");
  EXPECT_EQ(read["zeta"].get<double>(), 0.1 + 0.2);
}

TEST(JsonFile, NobodyAskedForIsNotWrittenAndOneThatCannotBeIsBadInput) {
  EXPECT_NO_THROW(WriteJsonFile("", {}));
  for (const char* path : {"/nowhere/out.json", "/"}) {
    try {
      WriteJsonFile(path, {{"a", 1}});
      ADD_FAILURE() << path << " was written";
    } catch (const BadInput& problem) {
      EXPECT_THAT(problem.what(), HasSubstr(std::string(path) + ": cannot be written"));
    }
  }
}

TEST(JsonFile, OnAFullDiskIsNoFaultOfTheInput) {
  try {
    WriteJsonFile("/dev/full", {{"a", 1}});
    ADD_FAILURE() << "it was written";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kOther);
    EXPECT_THAT(problem.what(), HasSubstr("No space left on device"));
  }
}

session::SessionHeader Header() {
  session::SessionHeader header;
  header.pace = "lockstep";
  header.period_ns = 100'000;
  header.start_utc_ns = 1'763'700'301'999'999'999;
  header.channels = {"de_x", "de_y"};
  return header;
}

TEST(SessionText, TellsPaceTimePeriodAndChannels) {
  // 1 763 700 301 s after 1970 is 2025-11-21 04:45:01 UTC (date -u -d @1763700301).
  EXPECT_EQ(Describe("s.lcmlog", Header()),
            "s.lcmlog: lockstep 2025-11-21T04:45:01Z, every 100 us, channels de_x de_y");
  session::SessionHeader fine = Header();
  fine.period_ns = 62'500;  // 16 kHz is no whole number of microseconds
  EXPECT_THAT(Describe("s", fine), HasSubstr("every 62.5 us"));
}

TEST(SessionText, PrintsDamageOnlyWhereThereIsSome) {
  testing::internal::CaptureStdout();
  PrintDamage({});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  testing::internal::CaptureStdout();
  PrintDamage({.missing_cycles = 7});
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("7"));
  EXPECT_EQ(DamageJson({.corrupt_records = 3, .truncated = true})["corrupt_records"], 3);
  EXPECT_TRUE(DamageJson({.truncated = true})["truncated"].get<bool>());
}

TEST(WhatIfCsv, PutsRecordedBesideOtherPerChannelWithShortestNumbers) {
  const test::ScratchFolder folder;
  WhatIfCsv csv(folder / "w.csv", Header());
  cycle::CycleRecord record;
  record.in.cycle = 3;
  record.out.current.control_current_a = {0.1, -0.25, 99.0};  // a third axis is not the rig's
  cycle::CycleOutputs other;
  other.current.control_current_a = {1e-9, 2.0, 99.0};
  csv.Add(record, other);
  csv.Finish();
  std::stringstream text;
  text << std::ifstream(folder / "w.csv").rdbuf();
  EXPECT_EQ(text.str(),
            "time_s,recorded_de_x_a,recorded_de_y_a,other_de_x_a,other_de_y_a\n"
            "0.0003,0.1,-0.25,1e-09,2\n");
}

TEST(WhatIfCsv, WithoutAPathDoesNothingAndIntoAFullDiskSaysSo) {
  WhatIfCsv none("", Header());
  none.Add({}, {});
  EXPECT_NO_THROW(none.Finish());
  EXPECT_THROW(WhatIfCsv("/nowhere/w.csv", Header()), BadInput);
  WhatIfCsv full("/dev/full", Header());
  full.Add({}, {});
  EXPECT_THROW(full.Finish(), Problem);
}

}  // namespace
}  // namespace levitas::cli
