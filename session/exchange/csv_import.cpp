#include "session/exchange/csv_import.hpp"

#include <fmt/core.h>

#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "session/exchange/csv_rows.hpp"
#include "session/exchange/mat_rows.hpp"
#include "session/log/output_path.hpp"
#include "session/log/session_writer.hpp"

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

/// Nothing could be learnt from a session of such numbers, and every command would try.
void RefuseImpossible(const ImportOptions& options, const ImportReport& report) {
  std::string text;
  for (const ImplausibleColumn& column : report.implausible) {
    if (column.impossible) text += "\n" + column.sentence;
  }
  if (text.empty()) return;
  throw BadInput(fmt::format(
      "{}: its numbers cannot be of rig {}:{}\nSay the unit, scale or offset in the map of amb "
      "import (--guess prints one, --map takes it), or give the rig file that the data are of",
      options.data_path, options.rig.name, text));
}

ImportReport Import(const ImportOptions& options, RowSource& source) {
  ImportReport report;
  WriteImport(options, [&](const RecordTaker& take) {
    report = ReadRecords(source, {.rig = options.rig, .coils = options.coils}, take);
    RefuseImpossible(options, report);
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
