// A session whose probes and coils are wired the other way round gives pictures of the same run.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "configuration/rig_file.hpp"
#include "report/session/recording.hpp"
#include "session/log/session_writer.hpp"

namespace levitas::report {
namespace {

/// One cycle of the shipped rotor; `probe` is the sign in the rig file of the probe of de_y,
/// `coils` that of the coils of nde_x.
Recording Recorded(double probe, double coils, const cycle::CycleRecord& record) {
  configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  rig.plant.sensor_polarity[1] = rig.numbers.sensor_polarity[1] = probe;
  rig.plant.actuator_polarity[2] = rig.numbers.actuator_polarity[2] = coils;
  session::SessionHeader header;
  header.rig_yaml = configuration::WriteRig(rig);
  header.period_ns = rig.numbers.period_ns;
  header.channels = rig.numbers.channels;
  const std::string path =
      std::filesystem::temp_directory_path() / ("levitas_reversed_" + std::to_string(getpid()));
  session::SessionWriter writer(path, header);
  writer.Write(record);
  writer.Close();
  Recording loaded = Load(path);
  std::filesystem::remove(path);
  return loaded;
}

cycle::CycleRecord Record(const AxisArray& position_m, const AxisArray& current_a) {
  cycle::CycleRecord record;
  record.in.cycle = record.in.frame.cycle = 1;
  record.in.frame_present = true;
  record.in.frame.axes = record.out.current.axes = 4;
  record.in.frame.position_m = position_m;
  record.out.current.control_current_a = current_a;
  return record;
}

TEST(LoadedRecording, IsInTheBearingFrameHoweverTheRigIsWired) {
  const Recording straight =
      Recorded(1.0, 1.0, Record({1e-5, 2e-5, 3e-5, 4e-5}, {0.1, 0.2, 0.3, 0.4}));
  const cycle::CycleRecord on_wires = Record({1e-5, -2e-5, 3e-5, 4e-5}, {0.1, 0.2, -0.3, 0.4});
  const Recording reversed = Recorded(-1.0, -1.0, on_wires);
  EXPECT_EQ(reversed.position_m, straight.position_m);
  EXPECT_EQ(reversed.current_a, straight.current_a);
  const Recording mistaken = Recorded(1.0, 1.0, on_wires);
  EXPECT_EQ(mistaken.position_m[1][0], -straight.position_m[1][0]);
  EXPECT_EQ(mistaken.current_a[2][0], -straight.current_a[2][0]);
}

}  // namespace
}  // namespace levitas::report
