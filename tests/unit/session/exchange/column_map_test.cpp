// Files of others: a map of columns, a guess of one, and the dialects of loggers.

#include "session/exchange/column_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "common/problem.hpp"
#include "session/exchange/column_guess.hpp"
#include "session/exchange/csv_import.hpp"
#include "session/exchange/file_kind.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

RigNumbers TwoBearings() {
  RigNumbers rig;
  rig.name = "bench";
  rig.channels = {"front_x", "front_y", "rear_x", "rear_y"};
  rig.bearings = {"front", "rear"};
  rig.period_ns = 100'000;
  rig.bias_current_a = 2.0;
  rig.max_coil_current_a = 4.0;
  rig.sensor_range_m = 400e-6;
  return rig;
}

ImportOptions OptionsOf(const std::string& data, const std::string& out, const RigNumbers& rig,
                        const ColumnMap* map) {
  ImportOptions options;
  options.data_path = data;
  options.out_path = out;
  options.rig = rig;
  options.rig_yaml = "name: bench\n";
  options.map = map;
  return options;
}

constexpr const char* kMap = R"(kind: import_map
columns:
  - {column: "t [ms]", is: time, unit: ms}
  - {column: phi, is: rotor_angle, unit: deg}
  - {column: "XA", is: position_front_x, unit: mm, sign: -1, offset: 0.5}
  - {column: "YA", is: position_front_y, unit: um}
  - {column: "XB", is: position_rear_x, unit: m, scale: 1e-4}
  - {column: "YB", is: position_rear_y, unit: m}
  - {column: IXA, is: control_current_front_x, unit: ma}
  - {column: IYA, is: control_current_front_y, unit: a}
  - {column: IXB, is: control_current_rear_x, unit: a}
  - {column: IYB, is: control_current_rear_y, unit: a}
)";
constexpr const char* kColumnNames = "t [ms]\tphi\tXA\tYA\tXB\tYB\tIXA\tIYA\tIXB\tIYB\ttemp\n";

class MappedFile : public ::testing::Test {
 protected:
  ImportReport Import(const std::string& content, const std::string& map = kMap) {
    std::filesystem::remove(out_);
    WriteFile(csv_, content);
    const ColumnMap columns = ParseColumnMap(map, "map.yaml");
    return ImportCsv(OptionsOf(csv_, out_, TwoBearings(), &columns));
  }
  std::string Refusal(const std::string& content, const std::string& map = kMap) {
    try {
      Import(content, map);
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  }
  cycle::CycleRecord First() {
    SessionReader reader(out_);
    return ReadAll(reader).at(0);
  }
  Folder folder_;
  std::string csv_{folder_ / "data.txt"};
  std::string out_{folder_ / "s.lcmlog"};
};

TEST_F(MappedFile, IsReadInItsUnitsSignsScalesAndOffsets) {
  const auto report = Import(std::string(kColumnNames) +
                             "0\t90\t0.4\t7\t2\t1e-6\t500\t0.25\t0\t0\twarm\n"
                             "0.1\t180\t0.4\t7\t2\t1e-6\t500\t0.25\t0\t0\twarm\n");
  EXPECT_EQ(report.rows, 2U);
  EXPECT_EQ(report.drop_outs, 0U);
  EXPECT_THAT(report.ignored_columns, ElementsAre("temp"));
  const auto record = First();
  EXPECT_NEAR(record.in.frame.position_m[0], 0.1e-3, 1e-18);  // -(0.4 - 0.5) mm
  EXPECT_NEAR(record.in.frame.position_m[1], 7e-6, 1e-20);
  EXPECT_NEAR(record.in.frame.position_m[2], 2e-4, 1e-18);
  EXPECT_EQ(record.out.current.control_current_a[0], 0.5);
  EXPECT_NEAR(record.in.frame.angle_rad, 0.5 * std::numbers::pi, 1e-15);
}

TEST_F(MappedFile, OfAnyDialectGivesTheSameNumbers) {
  const std::string numbers = "0\t90\t0.4\t7\t2\t1e-6\t500\t0.25\t0\t0\t1\n";
  Import(std::string(kColumnNames) + numbers);
  const auto expected = First();
  const auto with = [&](std::string text, char separator, bool comma) {
    for (char& c : text) {
      if (comma && c == '.') c = ',';
      if (c == '\t') c = separator;
    }
    return text;
  };
  const std::string units = "[ms]\t[°]\t[mm]\t[µm]\t[V]\t[m]\t[mA]\t[A]\t[A]\t[A]\t[°C]\n";
  for (const std::string& text :
       {"# rig 7\n\n# by me\n" + std::string(kColumnNames) + numbers,
        "Logger 3\nrows\t1\n" + std::string(kColumnNames) + numbers,
        std::string(kColumnNames) + units + numbers, "# " + std::string(kColumnNames) + numbers,
        with(kColumnNames, ';', false) + with(numbers, ';', true),
        "sep=;\n" + with(kColumnNames, ';', false) + with(numbers, ';', true),
        with(kColumnNames, ',', false) + with(numbers, ',', false)}) {
    EXPECT_EQ(Import(text).rows, 1U) << text;
    EXPECT_EQ(First().in.frame.position_m, expected.in.frame.position_m) << text;
    EXPECT_EQ(First().out.current.control_current_a, expected.out.current.control_current_a);
  }
}

TEST_F(MappedFile, WithoutNamesOrTimesIsReadByNumberAndRate) {
  std::string map = "kind: import_map\nrate_hz: 10000\ncolumns:\n";
  int number = 0;
  for (const char* is :
       {"position_front_x", "position_front_y", "position_rear_x", "position_rear_y"}) {
    map += "  - {column: \"#" + std::to_string(++number) + "\", is: " + is + ", unit: um}\n";
  }
  for (const char* is : {"control_current_front_x", "control_current_front_y",
                         "control_current_rear_x", "control_current_rear_y"}) {
    map += "  - {column: \"#" + std::to_string(++number) + "\", is: " + is + ", unit: a}\n";
  }
  const auto report = Import("1 2 3 4 0.1 0.2 0.3 0.4\n1 2 3 4 0.1 0.2 0.3 0.4\n", map);
  EXPECT_EQ(report.rows, 2U);
  EXPECT_DOUBLE_EQ(report.duration_s, 1e-4);
  EXPECT_NEAR(First().in.frame.position_m[3], 4e-6, 1e-20);
  EXPECT_EQ(First().out.current.control_current_a[3], 0.4);
}

TEST_F(MappedFile, ThatLacksAMappedColumnIsRefusedWithTheNamesItHas) {
  const std::string text = Refusal("t [ms]\tphi\tX1\n0\t0\t0\n");
  EXPECT_THAT(text,
              AllOf(HasSubstr("data.txt: line 1: its columns are \"t [ms]\", \"phi\", \"X1\""),
                    HasSubstr("\"XA\" of the map is no column of the file; did you mean "
                              "\"X1\"?"),
                    HasSubstr("\"IYB\" of the map")));
}

TEST_F(MappedFile, ProblemsOfTheMapAreListedAtOnce) {
  const std::string text = Refusal("", R"(kind: import_map
columns:
  - {column: t, is: time, unit: mm}
  - {column: a, is: positions_front_x, unit: um}
  - {column: b, is: position_front_y, unit: um, sign: 0}
  - {column: c, is: position_front_y, unit: inch}
)");
  EXPECT_THAT(text, AllOf(HasSubstr("found \"mm\", but time may be in s, ms, us, ns"),
                          HasSubstr("\"positions_front_x\" is no quantity"),
                          HasSubstr("allowed -1 or 1"), HasSubstr("inch")));
  EXPECT_THAT(text, HasSubstr("4 problems"));  // a wrong unit is one of them, not two
}

TEST_F(MappedFile, HasUnitsAsPeopleWriteThem) {
  const auto unit = [](const std::string& is, const std::string& written) {
    const std::string map =
        "kind: import_map\ncolumns:\n  - {column: t, is: " + is + ", unit: \"" + written + "\"}\n";
    return ParseColumnMap(map, "map.yaml").columns.at(0).unit;
  };
  EXPECT_EQ(unit("control_current_front_x", "mA"), "ma");
  EXPECT_EQ(unit("control_current_front_x", "A"), "a");
  EXPECT_EQ(unit("position_front_x", "µm"), "um");
  EXPECT_EQ(unit("speed", "1/min"), "rpm");
  EXPECT_EQ(unit("speed", "Hz"), "hz");
  EXPECT_EQ(unit("rotor_angle", "°"), "deg");
  EXPECT_EQ(unit("duty_away_front_x", "%"), "percent");
  EXPECT_EQ(unit("duty_away_front_x", "share"), "share");
  EXPECT_THROW(unit("speed", "mA"), BadInput);
}

TEST_F(MappedFile, InVoltsIsToldToGiveTheSensitivity) {
  const std::string text = Refusal("", R"(kind: import_map
columns:
  - {column: a, is: position_front_x, unit: V}
  - {column: b, is: control_current_front_x, unit: counts}
  - {column: c, is: position_front_y, unit: inch}
)");
  EXPECT_THAT(text, AllOf(HasSubstr("found \"V\", but position_front_x may be in m, mm, um, nm. "
                                    "Numbers in V need the sensitivity: unit: mm with scale: as "
                                    "many mm as one V stands for"),
                          HasSubstr("unit: ma with scale: as many ma as one count stands for"),
                          ::testing::EndsWith("position_front_y may be in m, mm, um, nm")));
}

TEST_F(MappedFile, IsNotReadWithoutItsMapButTheNamesFoundAndTheWayOutAreTold) {
  WriteFile(csv_, std::string(kColumnNames) + "0\t90\t0.4\t7\t2\t1e-6\t500\t0.25\t0\t0\t1\n");
  try {
    ImportCsv(OptionsOf(csv_, out_, TwoBearings(), nullptr));
    FAIL();
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(),
                AllOf(HasSubstr("columns missing: time_s"), HasSubstr("columns found: \"t [ms]\""),
                      HasSubstr("--guess"), HasSubstr("--map")));
  }
}

TEST(ContractNames, MayHaveARowOfUnitsThatAgreesAndNoOther) {
  const Folder folder;
  RigNumbers rig;
  rig.channels = {"x"};
  rig.bearings = {"b"};
  rig.period_ns = 100'000;
  const auto import = [&](const std::string& units) {
    WriteFile(folder / "d.csv",
              "time_ms,position_x_um,control_current_x_a\n" + units + "0.1,5,1\n");
    std::filesystem::remove(folder / "s.lcm");
    ImportCsv(OptionsOf(folder / "d.csv", folder / "s.lcm", rig, nullptr));
    SessionReader reader(folder / "s.lcm");
    return ReadAll(reader).at(0).in.frame.position_m[0];
  };
  EXPECT_NEAR(import(""), 5e-6, 1e-20);
  EXPECT_NEAR(import("[ms],[µm],[A]\n"), 5e-6, 1e-20);
  try {
    import("ms,mm,A\n");
    FAIL();
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(), AllOf(HasSubstr("position_x_um"), HasSubstr("says mm")));
  }
}

std::string QuantityOf(const std::string& name, const std::string& unit = "") {
  const auto guess = GuessColumns({{name}, {unit}, {{0.0, 1e-5}}}, TwoBearings());
  return guess.columns[0].quantity + (guess.columns[0].unit.empty() ? "" : " in ") +
         guess.columns[0].unit;
}

TEST(ColumnGuess, ReadsTheNamesOfLoggers) {
  EXPECT_EQ(QuantityOf("XA [mm]"), "position_front_x in mm");
  EXPECT_EQ(QuantityOf("Weg_Y2_um"), "position_rear_y in um");
  EXPECT_EQ(QuantityOf("posRearX (µm)"), "position_rear_x in um");
  EXPECT_EQ(QuantityOf("IYB", "a"), "control_current_rear_y in a");
  EXPECT_EQ(QuantityOf("front_y", "ma"), "control_current_front_y in ma");
  EXPECT_EQ(QuantityOf("exc_a_x_a"), "excitation_front_x in a");
  EXPECT_EQ(QuantityOf("Drehzahl [1/min]"), "speed in rpm");
  EXPECT_EQ(QuantityOf("Angle [deg]"), "rotor_angle in deg");
  EXPECT_EQ(QuantityOf("Winkel [Grad]"), "rotor_angle in deg");
  EXPECT_EQ(QuantityOf("t", "ms"), "time in ms");
  EXPECT_EQ(QuantityOf("X_vorn", "um"), "position_front_x in um");
  EXPECT_EQ(QuantityOf("Strom Y hinten", "a"), "control_current_rear_y in a");
  EXPECT_EQ(QuantityOf("déplacement x arrière", "um"), "position_rear_x in um");
  for (const char* name : {"temperature", "coil_xa_a", "X [mm]", "force_xa", "message"}) {
    EXPECT_EQ(GuessColumns({{name}, {""}, {{1.0}}}, TwoBearings()).columns[0].quantity, "") << name;
  }
}

TEST(ColumnGuess, TakesUnitsThatFitTheRigWhereTheFileSaysNone) {
  const auto unit = [](const std::string& name, std::vector<double> values) {
    const auto guess = GuessColumns({{name}, {""}, {std::move(values)}}, TwoBearings());
    return guess.columns[0].unit;
  };
  EXPECT_EQ(unit("xa", {-20e-6, 20e-6}), "m");
  EXPECT_EQ(unit("xa", {0.48, 0.52}), "mm");  // about an offset of half a millimetre
  EXPECT_EQ(unit("xa", {-20.0, 20.0}), "um");
  EXPECT_EQ(unit("i_xa", {-1.0, 1.0}), "a");
  EXPECT_EQ(unit("i_xa", {-1000.0, 1000.0}), "ma");
  EXPECT_EQ(unit("time", {0.0, 0.1, 0.2, 0.3}), "ms");
  EXPECT_EQ(unit("time", {0.0, 2e-4, 4e-4}), "s");
  // What does not move tells nothing: a rotor at rest, a first stretch of zeros.
  EXPECT_EQ(unit("angle", {0.0, 0.0, 0.0}), "");
  EXPECT_EQ(unit("i_xa", {0.0, 0.0}), "");
}

TEST(ColumnGuess, FindsTheNamesBelowOtherLinesWhereEveryCellHasADecimalComma) {
  const Folder folder;
  const std::string names = "Zeit [ms];XA [mm];YA [mm];XB [mm]\n";
  const std::string rows = "0,0;0,01;-0,02;0,03\n0,1;0,01;-0,02;0,03\n";
  for (const char* above : {"", "Bench 4\n", "Bench 4; turbine; run 17\nDate;14.03.2026\n"}) {
    WriteFile(folder / "d.csv", above + names + rows);
    const SampledColumns sampled = SampleColumns(folder / "d.csv");
    EXPECT_THAT(sampled.names, ElementsAre("Zeit [ms]", "XA [mm]", "YA [mm]", "XB [mm]")) << above;
    EXPECT_THAT(sampled.values.at(2), ElementsAre(-0.02, -0.02)) << above;
  }
}

TEST(ColumnGuess, TellsAnotherRateAndWhatIsMissing) {
  const auto guess =
      GuessColumns({{"t [s]", "XA"}, {"", ""}, {{0.0, 2e-4, 4e-4, 6e-4}, {0.0, 1e-6, 0.0, 1e-6}}},
                   TwoBearings());
  EXPECT_NEAR(guess.periods_a_row, 2.0, 1e-9);
  const std::string text = GuessText(guess, TwoBearings(), "d.csv", "amb import");
  EXPECT_THAT(text, AllOf(HasSubstr("5000 rows a second, rig bench samples 10000 times"),
                          HasSubstr("not found: position_front_y, position_rear_x"),
                          HasSubstr("is: position_front_x, unit: m, sign: 1, offset: 0")));
}

TEST(ColumnGuess, IsAMapThatTheImportTakes) {
  const Folder folder;
  WriteFile(
      folder / "d.txt",
      "t\tXA\tYA\tXB\tYB\tIXA\tIYA\tIXB\tIYB\n[ms]\t[mm]\t[mm]\t[mm]\t[mm]\t[A]\t[A]\t[A]\t[A]\n"
      "0\t0.01\t0.02\t0.03\t0.04\t1\t2\t3\t4\n0.1\t0.01\t0.02\t0.03\t0.04\t1\t2\t3\t4\n");
  const auto guess = GuessColumns(SampleColumns(folder / "d.txt"), TwoBearings());
  EXPECT_THAT(guess.missing, ::testing::IsEmpty());
  const ColumnMap map =
      ParseColumnMap(GuessText(guess, TwoBearings(), "d.txt", "amb import"), "guess.yaml");
  ImportCsv(OptionsOf(folder / "d.txt", folder / "s.lcm", TwoBearings(), &map));
  SessionReader reader(folder / "s.lcm");
  const auto record = ReadAll(reader).at(0);
  EXPECT_NEAR(record.in.frame.position_m[2], 3e-5, 1e-18);
  EXPECT_EQ(record.out.current.control_current_a[1], 2.0);
}

TEST(FileKind, IsToldByTheFirstBytesWithTheStepThatHelps) {
  const auto told = [](std::string_view bytes) { return OtherKind("f.csv", bytes); };
  EXPECT_THAT(told("PK\x03\x04 [Content_Types].xml"), HasSubstr("an Excel workbook"));
  EXPECT_THAT(told("TDSm"), AllOf(HasSubstr("TDMS"), HasSubstr("nptdms"), HasSubstr("--guess")));
  EXPECT_THAT(told("\x89MCAP0\r\n"), AllOf(HasSubstr("MCAP"), HasSubstr("amb export")));
  EXPECT_THAT(told("PAR1"), AllOf(HasSubstr("Parquet"), HasSubstr("to_csv")));
  EXPECT_THAT(told("\xFF\xFEt\0"), HasSubstr("UTF-16"));
  EXPECT_THAT(told("MATLAB 5.0 MAT-file, "), AllOf(HasSubstr(".mat"), Not(HasSubstr("--guess"))));
  EXPECT_THAT(told("\xFD"
                   "7zXZ"),
              HasSubstr(".csv.xz"));
  EXPECT_EQ(OtherKind("f.csv.xz",
                      "\xFD"
                      "7zXZ"),
            "");
  EXPECT_EQ(told("time_s,position_x_m\n"), "");
  EXPECT_EQ(told(""), "");
}

}  // namespace
}  // namespace levitas::session
