// One loader for every format: the same run gives the same recording, in the bearing frame, and a
// bad file is refused with the text of its importer.

#include "session/exchange/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>

#include "common/problem.hpp"
#include "session/exchange/candump_import.hpp"
#include "session/exchange/csv_export.hpp"
#include "session/exchange/csv_import.hpp"
#include "session/exchange/mat_export.hpp"
#include "session/log/repack.hpp"
#include "tests/unit/session/exchange/bus_log.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr std::array<double, 4> kProbe{-1.0, 1.0, 1.0, -1.0};
constexpr std::array<double, 4> kCoils{1.0, -1.0, 1.0, -1.0};

configuration::RigFile Rig() {
  configuration::RigFile rig;
  rig.numbers.name = "bench";
  rig.numbers.channels = Header().channels;
  rig.numbers.bearings = {"de", "nde"};
  rig.numbers.bias_current_a = 1.0;
  rig.numbers.max_coil_current_a = 2.0;
  rig.numbers.sensor_range_m = 400e-6;
  rig.numbers.max_speed_rad_per_s = 600.0;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    rig.numbers.sensor_polarity[axis] = kProbe[axis];
    rig.numbers.actuator_polarity[axis] = kCoils[axis];
  }
  rig.plant.bearings.resize(2);
  return rig;
}

/// A run with one lost frame: the record repeats the frame before.
std::vector<cycle::CycleRecord> SomeRun(std::size_t count) {
  auto records = DrawRecords(count);
  for (auto& record : records) {
    // Within the +-1 A that the coils leave, so that the bus can carry it.
    for (double& current_a : record.out.current.control_current_a) current_a *= 0.5;
  }
  records[10].in.frame = records[9].in.frame;
  records[10].in.frame_present = false;
  return records;
}

class RecordingTest : public ::testing::Test {
 protected:
  Recording OfSession(const std::vector<cycle::CycleRecord>& records) {
    WriteSession(session_, records);
    return LoadRecording(session_, Rig());
  }
  static std::string Refusal(const std::function<void()>& act) {
    try {
      act();
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  }
  std::string LoadRefusal(const std::string& path, const configuration::RigFile& rig = Rig()) {
    return Refusal([&] { static_cast<void>(LoadRecording(path, rig)); });
  }
  /// The same run in two recordings: levitated rows, one after the other.
  static void ExpectSameRun(const Recording& a, const Recording& b, double step_m, double step_a) {
    const auto runs_a = a.LevitatedIntervals();
    const auto runs_b = b.LevitatedIntervals();
    ASSERT_EQ(runs_a.size(), runs_b.size());
    for (std::size_t run = 0; run < runs_a.size(); ++run) {
      ASSERT_EQ(runs_a[run].end - runs_a[run].begin, runs_b[run].end - runs_b[run].begin);
      for (std::size_t i = runs_a[run].begin, j = runs_b[run].begin; i < runs_a[run].end;
           ++i, ++j) {
        EXPECT_EQ(a.cycle[i] - a.cycle[0], b.cycle[j] - b.cycle[0]);
        for (std::size_t axis = 0; axis < 4; ++axis) {
          EXPECT_NEAR(a.position_m[axis][i], b.position_m[axis][j], step_m);
          EXPECT_NEAR(a.current_a[axis][i], b.current_a[axis][j], step_a);
        }
      }
    }
  }
  Folder folder_;
  std::string session_{folder_ / "s.lcm"};
};

TEST_F(RecordingTest, UndoesThePolarityOfProbesAndCoils) {
  const auto records = SomeRun(50);
  const Recording recording = OfSession(records);
  ASSERT_EQ(recording.rows(), 50U);
  for (std::size_t row = 0; row < 50; ++row) {
    for (std::size_t axis = 0; axis < 4; ++axis) {
      EXPECT_EQ(recording.position_m[axis][row],
                kProbe[axis] * records[row].in.frame.position_m[axis]);
      EXPECT_EQ(recording.current_a[axis][row],
                kCoils[axis] * records[row].out.current.control_current_a[axis]);
      EXPECT_EQ(recording.ExcitationOf(axis, row), records[row].in.op.excitation_a[axis])
          << "excitation is added in the bearing frame";
    }
  }
}

TEST_F(RecordingTest, OfCsvAndMatIsThatOfTheSession) {
  const Recording of_session = OfSession(SomeRun(200));
  for (const std::string name : {"s.csv", "s.mat"}) {
    SessionReader reader(session_);
    const std::string path = folder_ / name;
    if (name == "s.csv") {
      static_cast<void>(ExportCsv(reader, path));
    } else {
      static_cast<void>(ExportMat(reader, path));
    }
    const Recording recording = LoadRecording(path, Rig());
    SCOPED_TRACE(name);
    EXPECT_EQ(recording.rows(), 199U) << "without the lost frame";
    ExpectSameRun(of_session, recording, 0.0, 0.0);
    EXPECT_EQ(recording.ExcitationOf(2, 0), of_session.ExcitationOf(2, 0));
    EXPECT_EQ(recording.angle_rad[5], of_session.angle_rad[5]);
    // A CSV file has 12 digits of speed_rpm: half a unit of the last of 960 rpm is 5e-11 rad/s.
    EXPECT_NEAR(recording.speed_rad_per_s[5], of_session.speed_rad_per_s[5], 1e-10);
    EXPECT_EQ(recording.bias_current_a[5], of_session.bias_current_a[5]);
  }
}

TEST_F(RecordingTest, OfABusLogIsThatOfTheSessionWithinTheStepsOfTheBus) {
  configuration::RigFile rig = Rig();
  rig.buses.resize(1);
  rig.buses[0].rates = {.arbitration_bit_per_s = 1e6, .data_bit_per_s = 8e6};
  const auto records = SomeRun(100);
  const auto layout = can::MakeLayout(rig.numbers, can::FormatOf(rig.buses));
  WriteFile(folder_ / "run.log", BusLog(records, layout));
  // Half a step of 16 bits over +-400 um (20 nm) and over the currents (0.1 mA), and rounding.
  ExpectSameRun(OfSession(records), LoadRecording(folder_ / "run.log", rig), 10.2e-9, 0.051e-3);
}

TEST_F(RecordingTest, OfGapsAndDutiesCountsThemInTheGapAndCurrentOfTheMagnet) {
  configuration::RigFile rig;
  rig.numbers.channels = {"x"};
  rig.numbers.bearings = {"b"};
  rig.numbers.sensor_polarity[0] = 1.0;
  rig.numbers.actuator_polarity[0] = -1.0;
  rig.plant.bearings.resize(1);
  rig.plant.bearings[0].magnet.gap_m = 1e-3;
  rig.plant.bearings[0].magnet.max_coil_current_a = 2.0;
  rig.log = {.matrix = "log", .rows = {"time_s", "gap_x_m", "duty_towards_x", "duty_away_x"}};
  WriteFile(folder_ / "d.csv", "time_s,gap_x_mm,duty_towards_x,duty_away_x\n0,0.4,0.75,0.25\n");
  WriteFile(folder_ / "d.mat", Matrix("log", 4, {0.0, 0.4e-3, 0.75, 0.25}));
  for (const std::string name : {"d.csv", "d.mat"}) {
    const Recording recording = LoadRecording(folder_ / name, rig);
    SCOPED_TRACE(name);
    ASSERT_EQ(recording.rows(), 1U);
    EXPECT_DOUBLE_EQ(recording.position_m[0][0], 0.6e-3) << "1 mm less 0.4 mm";
    EXPECT_DOUBLE_EQ(recording.current_a[0][0], -0.5) << "half of 2 A x (0.75 - 0.25), reversed";
    EXPECT_DOUBLE_EQ(recording.bias_current_a[0], 1.0) << "half of 2 A x (0.75 + 0.25)";
  }
}

TEST_F(RecordingTest, ShowsLostFramesAsGapsBetweenLevitatedIntervals) {
  const Recording recording = OfSession(SomeRun(20));
  EXPECT_THAT(recording.Gaps(), ElementsAre(10U, 11U)) << "the count repeats, then leaps";
  EXPECT_THAT(recording.LevitatedIntervals(), ElementsAre(RowRange{0, 10}, RowRange{11, 20}));
}

TEST_F(RecordingTest, IsNotLevitatedWhereTheRotorRestsOrAPositionIsNoNumber) {
  auto records = DrawRecords(40);
  for (std::size_t row = 0; row < 10; ++row) records[row].out.mode = Mode::kOff;
  records[20].in.frame.position_m[3] = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t row = 35; row < 40; ++row) records[row].out.current.amplifiers_enabled = false;
  const Recording recording = OfSession(records);
  EXPECT_THAT(recording.Gaps(), IsEmpty());
  EXPECT_THAT(recording.LevitatedIntervals(), ElementsAre(RowRange{10, 20}, RowRange{21, 35}));
}

TEST_F(RecordingTest, HoldsNoExcitationAndNoCoilCurrentsOfARunWithoutThem) {
  auto records = DrawRecords(30);
  for (auto& record : records) record.in.op.excitation_a = {};
  const Recording recording = OfSession(records);
  for (const Column& column : recording.excitation_a) EXPECT_THAT(column, IsEmpty());
  EXPECT_EQ(recording.ExcitationOf(1, 29), 0.0);
  EXPECT_THAT(recording.coil_current_a, IsEmpty());
}

TEST_F(RecordingTest, HoldsExcitationThatBeginsLateInItsRows) {
  auto records = DrawRecords(30);
  for (std::size_t row = 0; row < 12; ++row) records[row].in.op.excitation_a = {};
  const Recording recording = OfSession(records);
  ASSERT_EQ(recording.excitation_a[1].size(), 30U);
  EXPECT_EQ(recording.excitation_a[1][11], 0.0);
  EXPECT_EQ(recording.excitation_a[1][12], records[12].in.op.excitation_a[1]);
}

TEST_F(RecordingTest, HoldsTheExcitationOfReadingsAsTheOperatorAskedForIt) {
  auto records = DrawRecords(30);
  for (std::size_t row = 0; row < 30; ++row) {
    records[row].in.op.excitation_m = {};
    if (row > 11) records[row].in.op.excitation_m[0] = 1e-6 * static_cast<double>(row);
  }
  const Recording recording = OfSession(records);
  ASSERT_EQ(recording.excitation_m[0].size(), 30U);
  EXPECT_EQ(recording.PositionExcitationOf(0, 11), 0.0);
  // The probe of axis 0 is reversed; the excitation is added behind its correction.
  EXPECT_EQ(recording.PositionExcitationOf(0, 12), 12e-6);
  EXPECT_THAT(recording.excitation_m[1], IsEmpty());
  EXPECT_EQ(recording.PositionExcitationOf(1, 29), 0.0);
}

TEST_F(RecordingTest, NamesTheLimitsOfTheRigWhereReadingsAndCurrentsEnd) {
  configuration::RigFile rig = Rig();
  rig.numbers.sensor_ranges_m = {300e-6, 400e-6};
  rig.numbers.bias_current_a = 1.0;
  rig.numbers.max_coil_current_a = 1.7;
  WriteSession(session_, DrawRecords(3));
  const Recording recording = LoadRecording(session_, rig);
  EXPECT_THAT(recording.sensor_range_m, ElementsAre(300e-6, 300e-6, 400e-6, 400e-6));
  // The coil that is strengthened reaches 1.7 A before the other one reaches zero.
  EXPECT_DOUBLE_EQ(recording.current_limit_a, 0.7);
}

TEST_F(RecordingTest, HoldsMeasuredCoilCurrentsWithoutPolarity) {
  auto records = DrawRecords(30);
  for (auto& record : records) {
    record.in.coils = 8;
    for (std::size_t coil = 0; coil < 8; ++coil) {
      record.in.coil_current_a[coil] = 1.0 + 0.01 * static_cast<double>(coil);
    }
  }
  const Recording recording = OfSession(records);
  ASSERT_EQ(recording.coil_current_a.size(), 8U);
  ASSERT_EQ(recording.coil_current_a[3].size(), 30U);
  EXPECT_NEAR(recording.coil_current_a[3][7], 1.03, 1e-6) << "of the coil that measures it";
}

TEST_F(RecordingTest, IsReadWithoutAFileOnTheWay) {
  static_cast<void>(OfSession(SomeRun(20)));
  {
    SessionReader reader(session_);
    static_cast<void>(ExportCsv(reader, folder_ / "s.csv"));
  }
  const auto files = [&] {
    return std::distance(std::filesystem::directory_iterator(folder_ / ""), {});
  };
  const auto before = files();
  const char* const usual = std::getenv("TMPDIR");
  const std::string kept = usual == nullptr ? "" : usual;
  ::setenv("TMPDIR", "/proc/self/no-folder", 1);  // nowhere to write to
  EXPECT_EQ(LoadRecording(folder_ / "s.csv", Rig()).rows(), 19U);
  usual == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", kept.c_str(), 1);
  EXPECT_EQ(files(), before);
}

TEST_F(RecordingTest, RefusesAFileWithTheTextOfItsImporter) {
  const std::string out = folder_ / "out.lcm";
  configuration::RigFile rig = Rig();
  rig.buses.resize(1);
  rig.buses[0].rates = {.arbitration_bit_per_s = 1e6, .data_bit_per_s = 8e6};
  const auto layout = can::MakeLayout(rig.numbers, can::FormatOf(rig.buses));
  for (const std::string name : {"bad.csv", "bad.csv.xz", "bad.mat", "bad.log", "absent.csv"}) {
    const std::string path = folder_ / name;
    if (name != "absent.csv") WriteFile(path, "time_s,position_de_x_m\n0,1\n");
    const ImportOptions import{.data_path = path,
                               .out_path = out,
                               .rig = rig.numbers,
                               .rig_yaml = "",
                               .program_version = "",
                               .start_utc_ns = 0};
    const std::string text = Refusal([&] {
      if (name == "bad.log") {
        static_cast<void>(ImportCandump(import, layout));
      } else {
        static_cast<void>(name == "bad.mat" ? ImportMat(import) : ImportCsv(import));
      }
    });
    EXPECT_NE(text, "accepted") << name;
    EXPECT_EQ(LoadRefusal(path, rig), text) << name;
  }
}

TEST_F(RecordingTest, RefusesASessionOfAnotherRigWithItsName) {
  static_cast<void>(OfSession(DrawRecords(3)));
  configuration::RigFile slower = Rig();
  slower.numbers.period_ns = 200'000;
  EXPECT_THAT(LoadRefusal(session_, slower), StartsWith(session_ + ": the session was sampled"));
  configuration::RigFile renamed = Rig();
  renamed.numbers.channels[0] = "a_x";
  EXPECT_THAT(LoadRefusal(session_, renamed), StartsWith(session_ + ": the session has the chan"));
}

TEST_F(RecordingTest, OfASessionIsReadWhateverTheEndingOfItsName) {
  WriteSession(folder_ / "run.log", DrawRecords(7));
  EXPECT_EQ(LoadRecording(folder_ / "run.log", Rig()).rows(), 7U);
}

TEST_F(RecordingTest, OfAPackedSessionIsThatOfThePlainOne) {
  const Recording plain = OfSession(SomeRun(50));
  static_cast<void>(Repack(session_, folder_ / "run.lcm.zst"));
  const Recording packed = LoadRecording(folder_ / "run.lcm.zst", Rig());
  ASSERT_EQ(packed.rows(), 50U);
  EXPECT_EQ(packed.cycle, plain.cycle);
  EXPECT_EQ(packed.position_m, plain.position_m);
}

TEST_F(RecordingTest, RefusesWhatIsNoRecordedRunWithTheFormatsThereAre) {
  WriteFile(folder_ / "notes.txt", "time_s,position_de_x_m\n0,1\n");
  EXPECT_THAT(LoadRefusal(folder_ / "notes.txt"), HasSubstr("not a session. A recorded run is"));
  WriteFile(folder_ / "run.log", "(1.0) can0 7FF#0102\n");
  EXPECT_THAT(LoadRefusal(folder_ / "run.log"), HasSubstr("names no CAN buses"));
}

}  // namespace
}  // namespace levitas::session
