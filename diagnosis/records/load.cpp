#include "diagnosis/records/load.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "analysis/records/recorded_rows.hpp"
#include "common/problem.hpp"

namespace levitas::diagnosis {

Record RecordOf(session::Recording recording) {
  Record record;
  record.name = std::filesystem::path(recording.name).filename().string();
  record.rows = analysis::RowsOf(recording);
  record.times_s = std::move(recording.time_s);
  record.mean_speed_rad_per_s = analysis::MeanSpeed(record.rows);
  return record;
}

Record LoadRecord(const std::string& path, const configuration::RigFile& rig) {
  Record record = RecordOf(session::LoadRecording(path, rig));
  const bool flew = std::any_of(record.rows.begin(), record.rows.end(),
                                [](const analysis::RecordedRow& row) { return row.levitated; });
  if (!flew) {
    throw BadInput(fmt::format(
        "{}: the rotor is never levitated in its {:.2f} s; a diagnosis needs {} s of free flight",
        path, static_cast<double>(record.rows.size()) * rig.numbers.period_s(), kShortest));
  }
  return record;
}

double LargestOrbit(const std::vector<Record>& records, std::size_t axes) {
  double largest_m = 0.0;
  for (const Record& record : records) {
    for (const auto& row : record.rows) {
      for (std::size_t a = 0; a + 1 < axes && row.levitated; a += 2) {
        largest_m =
            std::max(largest_m, std::hypot(row.sample.position_m[a], row.sample.position_m[a + 1]));
      }
    }
  }
  return largest_m;
}

}  // namespace levitas::diagnosis
