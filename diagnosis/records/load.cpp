#include "diagnosis/records/load.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "analysis/recorded_rows.hpp"
#include "common/problem.hpp"
#include "session/coil_scales.hpp"
#include "session/csv_import.hpp"

namespace levitas::diagnosis {
namespace {

bool IsCsv(const std::string& path) { return path.ends_with(".csv") || path.ends_with(".csv.xz"); }
bool IsMat(const std::string& path) { return path.ends_with(".mat"); }

/// The scratch session of an import; gone whatever happens.
struct Scratch {
  explicit Scratch(std::string name) : path(std::move(name)) {}
  ~Scratch() {
    std::error_code absent;
    std::filesystem::remove(path, absent);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  Scratch(Scratch&&) = delete;
  Scratch& operator=(Scratch&&) = delete;
  std::string path;
};

/// What a file without a known ending must be: a session, which begins with the sync word of an
/// LCM event. A damaged one is the session reader's to judge.
void RefuseOtherKinds(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4096> start{};
  file.read(start.data(), start.size());
  if (!file && file.gcount() == 0) return;
  const std::string_view read(start.data(), static_cast<std::size_t>(file.gcount()));
  constexpr std::string_view kSync("\xED\xA1\xDA\x01");
  if (read.find(kSync) != std::string_view::npos) return;
  throw BadInput(fmt::format(
      "{}: not a session. A diagnosis takes sessions (amb run --record), CSV by the ending .csv or "
      ".csv.xz and MAT by .mat, with the columns of docs/formats.md; amb import makes a session "
      "of them",
      path));
}

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
    const Scratch scratch(
        (std::filesystem::path(scratch_folder) / (record.name + ".import.lcm")).string());
    session::ImportOptions import{.data_path = path,
                                  .out_path = scratch.path,
                                  .rig = rig.numbers,
                                  .rig_yaml = config::WriteRig(rig),
                                  .program_version = "diagnose",
                                  .start_utc_ns = 0,
                                  .coils = session::CoilScales(rig.plant, rig.numbers.axes()),
                                  .matrix = rig.log.matrix,
                                  .matrix_rows = rig.log.rows};
    IsMat(path) ? session::ImportMat(import) : session::ImportCsv(import);
    record.rows = Rows(scratch.path, rig);
  } else {
    RefuseOtherKinds(path);
    try {
      record.rows = Rows(path, rig);
    } catch (const BadInput& refused) {
      // That it is another rig's is told without a name.
      const std::string text = refused.what();
      throw BadInput(text.starts_with(path) ? text : fmt::format("{}: {}", path, text));
    }
  }
  const bool flew = std::any_of(record.rows.begin(), record.rows.end(),
                                [](const analysis::RecordedRow& row) { return row.levitated; });
  if (!flew) {
    throw BadInput(fmt::format(
        "{}: the rotor is never levitated in its {:.2f} s; a diagnosis needs {} s of free flight",
        path, static_cast<double>(record.rows.size()) * rig.numbers.period_s(), kShortest));
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
