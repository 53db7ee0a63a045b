#include "identification/record/record.hpp"

#include <filesystem>
#include <random>

#include "analysis/recorded_rows.hpp"
#include "session/csv_import.hpp"
#include "session/session_reader.hpp"

namespace levitas::identification {
namespace {

namespace fs = std::filesystem;

/// A file name of its own that disappears with the object.
class ScratchFile {
 public:
  ScratchFile()
      : path_(fs::temp_directory_path() /
              ("levitas_import_" + std::to_string(std::random_device{}()) + ".lcm")) {}
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() {
    std::error_code ignored;  // a file that is gone already is gone
    fs::remove(path_, ignored);
  }
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  fs::path path_;
};

Record Columns(const std::vector<analysis::RecordedRow>& rows, const RigNumbers& rig) {
  Record record;
  record.period_s = rig.period_s();
  record.channels = rig.channels;
  record.sensor_range_m = rig.sensor_range_m;
  for (std::size_t i = 0; i < rig.axes(); ++i) {
    record.sensor_ranges_m.push_back(rig.SensorRangeOf(i / 2));
  }
  record.current_limit_a =
      std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  const std::size_t axes = rig.axes();
  for (auto* columns : {&record.position_m, &record.current_a, &record.excitation_a}) {
    columns->assign(axes, {});
    for (Column& column : *columns) column.reserve(rows.size());
  }
  record.cycle.reserve(rows.size());
  record.levitated.reserve(rows.size());
  record.speed_rad_per_s.reserve(rows.size());
  record.angle_rad.reserve(rows.size());
  for (const auto& row : rows) {
    record.cycle.push_back(row.cycle);
    record.levitated.push_back(row.levitated ? 1 : 0);
    record.speed_rad_per_s.push_back(row.sample.speed_rad_per_s);
    record.angle_rad.push_back(row.sample.angle_rad);
    for (std::size_t axis = 0; axis < axes; ++axis) {
      record.position_m[axis].push_back(rig.sensor_polarity[axis] * row.sample.position_m[axis]);
      record.current_a[axis].push_back(rig.actuator_polarity[axis] *
                                       row.sample.command.control_current_a[axis]);
      record.excitation_a[axis].push_back(row.excitation_a[axis]);
    }
  }
  return record;
}

Record ReadSession(const std::string& path, const RigNumbers& rig) {
  session::SessionReader session(path);
  return Columns(analysis::ReadRows(session, rig), rig);
}

}  // namespace

Record ReadRecord(const std::string& path, const config::RigFile& rig) {
  Record record;
  if (path.ends_with(".csv") || path.ends_with(".csv.xz")) {
    const ScratchFile scratch;
    static_cast<void>(session::ImportCsv({.data_path = path,
                                          .out_path = scratch.path(),
                                          .rig = rig.numbers,
                                          .rig_yaml = config::WriteRig(rig),
                                          .program_version = "import",
                                          .start_utc_ns = 0}));
    record = ReadSession(scratch.path(), rig.numbers);
  } else {
    record = ReadSession(path, rig.numbers);
  }
  record.name = path;
  return record;
}

}  // namespace levitas::identification
