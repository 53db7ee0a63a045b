// Torsion in an export: columns of every coupling before the mode, an instant's own values, and nan
// where the batch was lost.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "session/exchange/csv_export.hpp"
#include "session/log/recorder.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Instants 3, 4 and 7 of the rig of DrawRecord, and 4 of a later start. The torque of the first
/// coupling is 10 times the instant, that of the second 100 times; twists are a millionth of it.
TorsionRecording Measured() {
  TorsionRecording torsion;
  torsion.couplings = {"motor to pinion", "gear to brake"};
  torsion.rig_session = {0x8000'0001U, 0x8000'0001U, 0x8000'0001U, 0x8000'0002U};
  torsion.cycle = {3, 4, 7, 4};
  torsion.torque_n_m = {{30, 40, 70, -40}, {300, 400, 700, -400}};
  torsion.twist_rad = {{30e-6, 40e-6, 70e-6, -40e-6}, {300e-6, 400e-6, 700e-6, -400e-6}};
  return torsion;
}

/// Values of a row at a column.
double ValueAt(const ExportRows& rows, const std::vector<double>& values, const std::string& name) {
  const auto found = std::ranges::find(rows.names(), name);
  if (found == rows.names().end()) return -1.0;
  return values.at(static_cast<std::size_t>(found - rows.names().begin()) - 1);
}

TEST(ExportTorsion, StandsCouplingByCouplingBetweenTheExcitationAndTheMode) {
  const ExportRows rows(Header(), {}, Measured());
  const std::vector<std::string> last(rows.names().end() - 6, rows.names().end());
  EXPECT_THAT(last, ElementsAre("excitation_nde_y_a", "torque_motor_to_pinion_n_m",
                                "twist_motor_to_pinion_rad", "torque_gear_to_brake_n_m",
                                "twist_gear_to_brake_rad", "mode"));
}

TEST(ExportTorsion, IsOfTheInstantOfItsRowAndNoNumberWhereTheBatchWasLost) {
  ExportRows rows(Header(), {}, Measured());
  auto records = DrawRecords(5);  // instants 3 to 7
  records.push_back(records[1]);
  records.back().in.frame.rig_session = 0x8000'0002U;
  std::vector<double> torque;
  for (const auto& record : records) {
    std::vector<double> values;
    rows.Next(record, values);
    ASSERT_EQ(values.size(), rows.names().size() - 1);
    EXPECT_EQ(ValueAt(rows, values, "mode"), static_cast<double>(Mode::kLevitating));
    torque.push_back(ValueAt(rows, values, "torque_motor_to_pinion_n_m"));
    const double twist = ValueAt(rows, values, "twist_gear_to_brake_rad");
    ASSERT_EQ(std::isnan(twist), std::isnan(torque.back()));
    if (std::isnan(twist)) continue;
    EXPECT_EQ(ValueAt(rows, values, "torque_gear_to_brake_n_m"), 10.0 * torque.back());
    EXPECT_NEAR(twist, 1e-5 * torque.back(), 1e-15);
  }
  using ::testing::IsNan;
  EXPECT_THAT(torque, ElementsAre(30.0, 40.0, IsNan(), IsNan(), 70.0, -40.0));
}

TEST(ExportTorsion, IsChosenByTheNamesOfItsColumnsInTheirOrder) {
  const ExportSelection selection{.columns = {"mode", "twist_gear_to_brake_rad"}};
  ExportRows rows(Header(), selection, Measured());
  EXPECT_THAT(rows.names(), ElementsAre("time_s", "mode", "twist_gear_to_brake_rad"));
  std::vector<double> values;
  rows.Next(DrawRecords(1).front(), values);
  EXPECT_THAT(values, ElementsAre(static_cast<double>(Mode::kLevitating), 300e-6));
}

TEST(ExportTorsion, IsNotThereWithoutCouplings) {
  ExportRows rows(Header());
  EXPECT_THAT(rows.names(), ::testing::Each(::testing::Not(HasSubstr("torque_"))));
  EXPECT_THAT(rows.names(), ::testing::Each(::testing::Not(HasSubstr("twist_"))));
  std::vector<double> values;
  rows.Next(DrawRecords(1).front(), values);
  EXPECT_EQ(values.size(), rows.names().size() - 1);
  const ExportSelection selection{.columns = {"torque_motor_to_pinion_n_m"}};
  EXPECT_THROW(ExportRows(Header(), selection), Problem);
}

// From the recorder to the file: names come from the rig of the session's header.
TEST(ExportTorsion, OfASessionIsWhatTheRecorderWasGiven) {
  const Folder folder;
  RecorderOptions options;
  options.session_path = folder / "s.lcmlog";
  options.trip_folder = folder / "";
  options.header = Header();
  options.header.rig_yaml = configuration::WriteRig(
      configuration::LoadRig(configuration::FindConfig("geared_rotor_12dof", "rigs")));
  Recorder recorder(std::move(options));
  TorsionBatch batch{.first_cycle = 4, .rig_session = 0x8000'0001U, .couplings = 2, .samples = 2};
  for (std::size_t i = 0; i < 4; ++i) {  // instant by instant, both couplings of each
    batch.torque_n_m[i] = 1.5 + static_cast<double>(i);
    batch.twist_rad[i] = 0.25 * static_cast<double>(i);
  }
  for (const auto& record : DrawRecords(4)) {  // instants 3 to 6
    if (record.in.frame.cycle == 5) recorder.PostTorsion(batch);
    recorder.Post(record);
  }
  recorder.Finish();
  SessionReader reader(folder / "s.lcmlog");
  ExportCsv(reader, folder / "s.csv",
            {.columns = {"torque_motor_to_pinion_n_m", "twist_motor_to_pinion_rad",
                         "torque_gear_to_brake_n_m", "twist_gear_to_brake_rad"}});
  EXPECT_EQ(ReadFile(folder / "s.csv"),
            "time_s,torque_motor_to_pinion_n_m,twist_motor_to_pinion_rad,"
            "torque_gear_to_brake_n_m,twist_gear_to_brake_rad\n"
            "0,nan,nan,nan,nan\n"
            "0.0001,1.5,0,2.5,0.25\n"
            "0.0002,3.5,0.5,4.5,0.75\n"
            "0.0003,nan,nan,nan,nan\n");
}

}  // namespace
}  // namespace levitas::session
