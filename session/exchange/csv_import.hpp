#pragma once
// Measured data of others: a CSV or MAT file of the contract in docs/formats.md becomes a session.
//
// Records   as measured_data.hpp makes them; a drop-out leaves its cycles out of the session.
// Failure   BadInput with line and column, and where no number of a column can be of the rig
//           (plausible_values.hpp); then no output file is left behind.
// Thread    any.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "session/exchange/measured_data.hpp"

namespace levitas::session {

struct ImportOptions {
  std::string data_path;  ///< .csv, compressed .csv.xz, or .mat
  std::string out_path;
  RigNumbers rig;
  std::string rig_yaml;  ///< complete text, goes into the header
  std::string program_version;
  std::int64_t start_utc_ns{};
  std::vector<CoilScale> coils{};          ///< per axis; needed for columns of gap and duty
  std::string matrix{};                    ///< of a MAT file without vectors of our names
  std::vector<std::string> matrix_rows{};  ///< names of its rows
  const ColumnMap* map{};                  ///< what the columns are; null: as their names say
};

ImportReport ImportCsv(const ImportOptions& options);
/// The same from a MAT file; see mat_rows.hpp.
ImportReport ImportMat(const ImportOptions& options);

/// Writes the session of an import: `read` hands every record to the taker it is given. When it
/// throws, or the disk refuses, no output file is left behind.
void WriteImport(const ImportOptions& options, const std::function<void(const RecordTaker&)>& read);

}  // namespace levitas::session
