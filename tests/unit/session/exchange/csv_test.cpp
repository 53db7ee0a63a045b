// CSV in and out: the contract, foreign dialects, and one clear message for every kind of bad file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <numbers>
#include <sstream>

#include "common/problem.hpp"
#include "session/exchange/csv_columns.hpp"
#include "session/exchange/csv_export.hpp"
#include "session/exchange/csv_import.hpp"
#include "tests/support/paths.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

RigNumbers TwoAxes() {
  RigNumbers rig;
  rig.name = "bench";
  rig.channels = {"de_x", "de_y"};
  rig.bearings = {"de"};
  rig.period_ns = 100'000;
  rig.bias_current_a = 1.5;
  return rig;
}

constexpr const char* kNames =
    "time_s,position_de_x_m,position_de_y_m,control_current_de_x_a,control_current_de_y_a\n";

class Csv : public ::testing::Test {
 protected:
  ImportReport Import(const std::string& content) {
    WriteFile(csv_, content);
    return ImportCsv(Options());
  }
  ImportOptions Options() {
    return {.data_path = csv_,
            .out_path = out_,
            .rig = TwoAxes(),
            .rig_yaml = "name: bench\n",
            .program_version = "0.1.0",
            .start_utc_ns = 5};
  }
  std::vector<cycle::CycleRecord> Records() {
    SessionReader reader(out_);
    return ReadAll(reader);
  }
  std::string Refusal(const std::string& content) {
    try {
      Import(content);
    } catch (const BadInput& problem) {
      EXPECT_FALSE(std::filesystem::exists(out_));
      EXPECT_FALSE(std::filesystem::exists(out_ + ".part"));
      return problem.what();
    }
    return "accepted";
  }
  static std::string WithoutLastColumn(const std::string& table) {
    std::istringstream lines(table);
    std::string text;
    for (std::string line; std::getline(lines, line);)
      text += line.substr(0, line.rfind(',')) + "\n";
    return text;
  }
  Folder folder_;
  std::string csv_{folder_ / "data.csv"};
  std::string out_{folder_ / "s.lcmlog"};
};

TEST_F(Csv, ImportTakesEveryNumberAndTellsWhatItDoesNotKnow) {
  const auto report = Import(std::string(kNames) + "0,1e-6,2e-6,0.5,-0.5\n0.0001,3e-6,4e-6,0,1\n");
  EXPECT_EQ(report.rows, 2U);
  EXPECT_EQ(report.drop_outs, 0U);
  EXPECT_FALSE(report.has_rotation);
  EXPECT_DOUBLE_EQ(report.duration_s, 1e-4);
  const auto records = Records();
  ASSERT_EQ(records.size(), 2U);
  EXPECT_EQ(records[0].in.cycle, 0U);
  EXPECT_EQ(records[1].in.cycle, 1U);
  EXPECT_EQ(records[1].in.frame.sample_time_ns, 100'000);
  EXPECT_TRUE(records[1].in.frame_present);
  EXPECT_EQ(records[1].in.frame.axes, 2U);
  EXPECT_EQ(records[1].in.frame.position_m[0], 3e-6);
  EXPECT_EQ(records[0].out.current.control_current_a[1], -0.5);
  EXPECT_EQ(records[0].out.current.bias_current_a, 1.5);
  EXPECT_EQ(records[0].out.mode, Mode::kLevitating);
  const SessionReader reader(out_);
  EXPECT_EQ(reader.header().pace, "imported");
  EXPECT_EQ(reader.header().source, csv_);
  EXPECT_EQ(reader.header().rig_yaml, "name: bench\n");
  EXPECT_EQ(reader.header().controller_yaml, "");
}

TEST_F(Csv, ImportUnderstandsEveryUnit) {
  Import(
      "position_de_y_mm,time_s,control_current_de_x_ma,excitation_de_y_ma,position_de_x_um,"
      "control_current_de_y_a,excitation_de_x_a\n"
      "0.002,0,500,20,1,0.25,0.03\n");
  const auto record = Records().at(0);
  EXPECT_EQ(record.in.frame.position_m[0], 1e-6);
  EXPECT_EQ(record.in.frame.position_m[1], 2e-6);
  EXPECT_EQ(record.out.current.control_current_a[0], 0.5);
  EXPECT_EQ(record.out.current.control_current_a[1], 0.25);
  EXPECT_EQ(record.in.op.excitation_a[0], 0.03);
  EXPECT_EQ(record.in.op.excitation_a[1], 0.02);
}

TEST_F(Csv, ImportReadsTheDialectsOfSpreadsheets) {
  const std::string semicolons =
      "\xEF\xBB\xBF\"time_s\";position_de_x_m; position_de_y_m;control_current_de_x_a;"
      "control_current_de_y_a\r\n0;1e-6;2e-6;0,5;+0,25\r\n\r\n0,0001;1e-6;2e-6;0,5;0,25";
  EXPECT_EQ(Import(semicolons).rows, 2U);
  EXPECT_EQ(Records().at(1).out.current.control_current_a[1], 0.25);
  EXPECT_EQ(Records().at(1).in.cycle, 1U);
}

TEST_F(Csv, GapsInTimeBecomeMissingCycles) {
  const auto report = Import(std::string(kNames) + "1,0,0,0,0\n1.0001,0,0,0,0\n1.0011,0,0,0,0\n");
  EXPECT_EQ(report.drop_outs, 1U);
  EXPECT_EQ(report.missing_cycles, 9U);
  SessionReader reader(out_);
  const auto records = ReadAll(reader);
  EXPECT_EQ(records.at(2).in.cycle, 11U);
  EXPECT_EQ(reader.damage().missing_cycles, 9U);
}

TEST_F(Csv, SpeedComesFromTheSlopeOfTheAngleWrappedOrNot) {
  // 100 rad/s; the second half comes wrapped after a drop-out of half a second (8 turns).
  constexpr double kSpeed = 100.0;
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::string text = std::string("rotor_angle_rad,") + kNames;
  for (int i = 0; i < 400; ++i) {
    const int cycle = i < 200 ? i : i + 5000;
    const double time_s = cycle * 1e-4;
    const double angle = i < 200 ? kSpeed * time_s : std::fmod(kSpeed * time_s, kTurn);
    char line[100];
    std::snprintf(line, sizeof line, "%.12g,%.4f,0,0,0,0\n", angle, time_s);
    text += line;
  }
  const auto report = Import(text);
  EXPECT_TRUE(report.has_rotation);
  const auto records = Records();
  for (const auto& record : records) {
    // 12 digits over one period of 1e-4 s: 1e-10 / 1e-4.
    ASSERT_NEAR(record.in.frame.speed_rad_per_s, kSpeed, 1e-5) << record.in.cycle;
    ASSERT_GE(record.in.frame.angle_rad, 0.0);
    ASSERT_LT(record.in.frame.angle_rad, kTurn);
    EXPECT_EQ(record.out.mode, Mode::kSpinning);
  }
}

TEST_F(Csv, AngleIsTheIntegralOfTheSpeed) {
  std::string text = std::string("speed_rpm,") + kNames;
  for (int i = 0; i <= 1000; ++i) {
    text += std::to_string(60 * i) + "," + SecondsText(i * 100'000) + ",0,0,0,0\n";
  }
  Import(text);
  // From 0 to 1000 turns/s in 0.1 s: 50 turns. Trapezoids are exact for a ramp; 1e-9 for rounding.
  EXPECT_NEAR(std::remainder(Records().back().in.frame.angle_rad, 2.0 * std::numbers::pi), 0.0,
              1e-9);
}

TEST_F(Csv, UnknownColumnsAreIgnoredAndListed) {
  const auto report = Import(
      "temperature,time_s,position_de_x_m,position_de_y_m,control_current_de_x_a,"
      "control_current_de_y_a\nwarm,0,0,0,0,0\n");
  EXPECT_THAT(report.ignored_columns, ElementsAre("temperature"));
}

TEST_F(Csv, MoreColumnsThanAreAllowedAreRefusedAndTheMostAreNot) {
  const std::string names =
      "time_s,position_de_x_m,position_de_y_m,control_current_de_x_a,control_current_de_y_a";
  const auto more = [](std::size_t count) { return std::string(count - 5, ','); };
  EXPECT_EQ(Import(names + more(kMostColumns) + "\n0,0,0,0,0" + more(kMostColumns) + "\n").rows,
            1U);
  std::filesystem::remove(out_);
  EXPECT_THAT(Refusal(names + more(kMostColumns + 1) + "\n"),
              HasSubstr("has 10001 columns, at most 10000 are allowed"));
}

TEST_F(Csv, OfAColumnWithoutEndTheBeginningIsComparedAndSaid) {
  const std::string endless(900'000, 'x');
  const std::string text = Refusal("time_s,position_de_x_" + endless + "\n");
  EXPECT_THAT(text, HasSubstr("did you mean \"position_de_x_m\""));
  EXPECT_LT(text.size(), 1000U);
  EXPECT_THAT(Refusal("time_s," + endless + "\n"), Not(HasSubstr("did you mean")));
}

TEST_F(Csv, EveryProblemOfTheColumnNamesIsListedAtOnce) {
  const std::string text = Refusal(
      "time,position_de_x_a,position_de_y_m,position_de_y_um,control_curent_de_x_a,"
      "excitation_nde_x_a\n");
  EXPECT_THAT(text, AllOf(HasSubstr("data.csv: line 1"), HasSubstr("did you mean \"time_s\""),
                          HasSubstr("column 2 \"position_de_x_a\" is not known"),
                          HasSubstr("column 4 \"position_de_y_um\" is given twice"),
                          HasSubstr("did you mean \"control_current_de_x_a\""),
                          HasSubstr("column 6 \"excitation_nde_x_a\" is not known"),
                          HasSubstr("channels of the rig: de_x, de_y"),
                          HasSubstr("columns missing: time_s, position_de_x_m (or mm, um), "
                                    "control_current_de_x_a (or ma), control_current_de_y_a")));
}

TEST_F(Csv, ANameInCapitalsIsNotIgnoredButOfferedInSmallLetters) {
  const std::string whole =
      "time_s,position_de_x_m,position_de_y_m,control_current_de_x_a,control_current_de_y_a";
  EXPECT_THAT(Refusal(whole + ",EXCITATION_DE_X_A\n"),
              HasSubstr("\"EXCITATION_DE_X_A\" is not known (channels of the rig: de_x, de_y); did "
                        "you mean \"excitation_de_x_a\"?"));
  EXPECT_THAT(Refusal(whole + ",Speed_RPM\n"), HasSubstr("did you mean \"speed_rpm\"?"));
}

TEST_F(Csv, OfAHundredUnknownNamesTheRestIsCounted) {
  std::string names = "time_s";
  for (int i = 0; i < 100; ++i) names += ",position_de_x_" + std::to_string(i);
  // 20 are compared with the names known; 80 are left.
  EXPECT_THAT(Refusal(names + "\n"), HasSubstr("80 more unknown columns"));
}

TEST_F(Csv, ColumnsOfAnotherRigAreToldInOneSentence) {
  const std::string text = Refusal(
      "time_s,position_ball_x_m,position_ball_y_m,control_current_ball_x_a,"
      "control_current_ball_y_a\n");
  EXPECT_THAT(text, AllOf(HasSubstr("line 1"), HasSubstr("channels ball_x, ball_y"),
                          HasSubstr("the rig has de_x, de_y"), HasSubstr("--rig")));
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST_F(Csv, EveryKindOfBadRowIsToldWithLineAndColumn) {
  const std::string names = kNames;
  const std::string good = "0,0,0,0,0\n";
  const auto row = [&](const std::string& bad) { return Refusal(names + good + bad); };
  EXPECT_THAT(row("0.0001,0,x,0,0\n"),
              AllOf(HasSubstr("data.csv: line 3: column 3 (position_de_y_m)"),
                    HasSubstr("found \"x\", expected a number")));
  EXPECT_THAT(row("0.0001,0,,0,0\n"), HasSubstr("line 3: column 3 (position_de_y_m): found \"\""));
  EXPECT_THAT(row("0.0001,0,1.5e,0,0\n"), HasSubstr("found \"1.5e\""));
  EXPECT_THAT(row("0.0001,0,1e999,0,0\n"), HasSubstr("found \"1e999\""));
  EXPECT_THAT(row("0.0001,0,0,nan,0\n"),
              AllOf(HasSubstr("column 4"), HasSubstr("expected a finite number")));
  EXPECT_THAT(row("inf,0,0,0,0\n"), HasSubstr("column 1 (time_s): found \"inf\""));
  EXPECT_THAT(row("0.0001,0,0,0\n"), HasSubstr("line 3: 4 cells, but line 1 names 5 columns"));
  EXPECT_THAT(row("0.0001,0,0,0,0,0\n"), HasSubstr("line 3: 6 cells"));
  EXPECT_THAT(row("0,0,0,0,0\n"), HasSubstr("line 3: time_s goes from 0 to 0"));
  EXPECT_THAT(row("-0.0001,0,0,0,0\n"), HasSubstr("line 3: time_s goes from 0 to -0.0001"));
  EXPECT_THAT(row("0.00005,0,0,0,0\n"), HasSubstr("a step of 0.5 periods"));
  EXPECT_THAT(row("0.00015,0,0,0,0\n"), HasSubstr("must be a whole number of periods"));
}

TEST_F(Csv, ATimeThatNoCountOfNanosecondsHoldsIsRefused) {
  for (const char* time : {"1e300", "-1e300", "5e9", "-4.1e9"}) {
    try {
      Import(std::string(kNames) + time + ",0,0,0,0\n");
      ADD_FAILURE() << time << " was taken";
    } catch (const BadInput& problem) {
      EXPECT_THAT(problem.what(), ::testing::HasSubstr("line 2"));
      EXPECT_THAT(problem.what(), ::testing::HasSubstr("time_s is"));
    }
  }
  EXPECT_EQ(Import(std::string(kNames) + "1.9e9,0,0,0,0\n").rows, 1U) << "seconds since 1970";
}

TEST_F(Csv, FilesWithoutRowsOrNamesAreRefused) {
  EXPECT_THAT(Refusal(""), HasSubstr("line 1: no column names; the file is empty"));
  EXPECT_THAT(Refusal(kNames), HasSubstr("no rows follow the column names"));
  EXPECT_THAT(Refusal(std::string("\0\1\2\3", 4)), HasSubstr("columns missing"));
}

TEST_F(Csv, FilesThatCannotBeReadAreRefusedWithTheReason) {
  ImportOptions options = Options();
  options.data_path = folder_ / "absent.csv";
  EXPECT_THROW(ImportCsv(options), BadInput);
  options.data_path = folder_ / "";
  EXPECT_THROW(ImportCsv(options), BadInput);
  WriteFile(folder_ / "broken.csv.xz", "this is not compressed");
  options.data_path = folder_ / "broken.csv.xz";
  try {
    ImportCsv(options);
    FAIL();
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("broken.csv.xz"));
  }
  WriteFile(csv_, std::string(kNames) + "0,0,0,0,0\n");
  options = Options();
  options.out_path = csv_;
  EXPECT_THROW(ImportCsv(options), Problem);
  EXPECT_TRUE(std::filesystem::exists(csv_));
}

TEST_F(Csv, ForeignRecordImportsFromItsCompressedFile) {
  ImportOptions options = Options();
  options.rig.channels = Header().channels;
  options.data_path = levitas::test::DataFolder() + "/records/standing_2s.csv.xz";
  const auto report = ImportCsv(options);
  EXPECT_EQ(report.rows, 20'000U);
  EXPECT_EQ(report.drop_outs, 0U);
  EXPECT_TRUE(report.has_excitation);
  // First and second line of the file, by eye.
  const auto records = Records();
  EXPECT_EQ(records[0].in.frame.position_m[0], -1.9043e-06);
  EXPECT_EQ(records[1].out.current.control_current_a[3], 0.622214);
}

// Of a controller that lowers it; of all others the rig's is known.
TEST_F(Csv, ABiasThatMovedIsExportedAndReadBack) {
  auto records = DrawRecords(20, 7);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].out.current.bias_current_a = 1.0 - 0.01 * static_cast<double>(i);
  }
  SessionHeader header = Header();
  header.controller_yaml += "\nbias_saving:\n  lowest_current_a: 0.2\n";
  WriteSession(out_, records, header);
  {
    SessionReader reader(out_);
    ExportCsv(reader, csv_);
  }
  EXPECT_NE(ReadFile(csv_).find(",bias_current_a,mode\n"), std::string::npos);
  ImportOptions options = Options();
  options.rig.channels = Header().channels;
  static_cast<void>(ImportCsv(options));
  const auto read = Records();
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].out.current.bias_current_a, records[i].out.current.bias_current_a);
  }
}

TEST_F(Csv, ExportImportExportGivesTheSameBytes) {
  auto records = DrawRecords(3000, 99);
  for (std::size_t i = 1000; i < 1010; ++i) records[i].in.frame_present = false;
  records[5].in.frame.position_m[1] = std::numeric_limits<double>::quiet_NaN();
  WriteSession(out_, records);
  {
    SessionReader reader(out_);
    ExportCsv(reader, csv_);
  }
  const std::string first = ReadFile(csv_);
  ImportOptions options = Options();
  options.rig.channels = Header().channels;
  const auto report = ImportCsv(options);
  EXPECT_EQ(report.missing_cycles, 10U);
  SessionReader reader(out_);
  ExportCsv(reader, csv_);
  EXPECT_EQ(WithoutLastColumn(ReadFile(csv_)), WithoutLastColumn(first)) << "but for the modes";
}

}  // namespace
}  // namespace levitas::session
