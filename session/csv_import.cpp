#include "session/csv_import.hpp"

#include "common/output_file.hpp"
#include "session/csv_rows.hpp"
#include "session/mat_rows.hpp"
#include "session/output_path.hpp"
#include "session/session_writer.hpp"

namespace levitas::session {
namespace {

SessionHeader ImportHeader(const ImportOptions& options) {
  SessionHeader header;
  header.program_version = options.program_version;
  header.rig_yaml = options.rig_yaml;
  header.pace = "imported";
  header.period_ns = options.rig.period_ns;
  header.start_utc_ns = options.start_utc_ns;
  header.source = options.data_path;
  header.channels = options.rig.channels;
  return header;
}

ImportReport Import(const ImportOptions& options, RowSource& source) {
  ImportReport report;
  WriteImport(options, [&](const RecordTaker& take) {
    report = ReadRecords(source, {.rig = options.rig, .coils = options.coils}, take);
  });
  return report;
}

}  // namespace

void WriteImport(const ImportOptions& options,
                 const std::function<void(const RecordTaker&)>& read) {
  PartFile part(options.out_path);
  try {
    SessionWriter writer(part, ImportHeader(options));
    read([&writer](const cycle::CycleRecord& record) { writer.Write(record); });
    writer.Close();
  } catch (const WriteFailed& failed) {  // nothing of an import is kept
    CannotWrite(options.out_path, failed.error());
  }
  part.Commit();
}

ImportReport ImportCsv(const ImportOptions& options) {
  CheckOutputPath(options.out_path, options.data_path);
  CsvRows rows(options.data_path, options.rig.channels, options.map);
  return Import(options, rows);
}

ImportReport ImportMat(const ImportOptions& options) {
  CheckOutputPath(options.out_path, options.data_path);
  MatRows rows(options.data_path, options.rig.channels, options.matrix, options.matrix_rows,
               options.map);
  return Import(options, rows);
}

}  // namespace levitas::session
