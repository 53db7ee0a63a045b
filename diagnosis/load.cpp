#include "diagnosis/load.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "analysis/coil_scales.hpp"
#include "analysis/recorded_rows.hpp"
#include "common/problem.hpp"
#include "session/csv_import.hpp"

namespace levitas::diagnosis {
namespace {

bool IsCsv(const std::string& path) { return path.ends_with(".csv") || path.ends_with(".csv.xz"); }
bool IsMat(const std::string& path) { return path.ends_with(".mat"); }

std::vector<analysis::RecordedRow> Rows(const std::string& session_path,
                                        const config::RigFile& rig) {
  session::SessionReader session(session_path);
  return analysis::ReadRows(session, rig.numbers);
}

}  // namespace

Record LoadRecord(const std::string& path, const config::RigFile& rig,
                  const std::string& scratch_folder) {
  Record record;
  record.name = std::filesystem::path(path).filename().string();
  if (IsCsv(path) || IsMat(path)) {
    const std::string scratch =
        (std::filesystem::path(scratch_folder) / (record.name + ".import.lcm")).string();
    session::ImportOptions import{.data_path = path,
                                  .out_path = scratch,
                                  .rig = rig.numbers,
                                  .rig_yaml = config::WriteRig(rig),
                                  .program_version = "diagnose",
                                  .start_utc_ns = 0,
                                  .coils = analysis::CoilScales(rig.plant, rig.numbers.axes()),
                                  .matrix = rig.log.matrix,
                                  .matrix_rows = rig.log.rows};
    IsMat(path) ? session::ImportMat(import) : session::ImportCsv(import);
    record.rows = Rows(scratch, rig);
    std::filesystem::remove(scratch);
  } else {
    record.rows = Rows(path, rig);
  }
  const auto levitated = static_cast<double>(
      std::count_if(record.rows.begin(), record.rows.end(),
                    [](const analysis::RecordedRow& row) { return row.levitated; }));
  if (levitated * rig.numbers.period_s() < kShortest) {
    throw BadInput(fmt::format("{}: {:.2f} s levitated, a diagnosis needs at least {} s", path,
                               levitated * rig.numbers.period_s(), kShortest));
  }
  record.mean_speed_rad_per_s = analysis::MeanSpeed(record.rows);
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
