#include "session/exchange/mcap_export.hpp"

#include <array>
#include <vector>

#include "common/enums.hpp"
#include "common/output_file.hpp"
#include "session/exchange/export_rows.hpp"
#include "session/exchange/mcap_writer.hpp"
#include "session/exchange/protobuf_schema.hpp"

namespace levitas::session {
namespace {

constexpr const char* kProtobuf = "protobuf";

std::uint16_t AddCycles(McapWriter& writer, const std::vector<std::string>& names) {
  std::vector<ProtobufField> fields;
  fields.reserve(names.size());
  for (const std::string& name : names) fields.push_back({name});
  const auto schema = writer.AddSchema("levitas.Cycle", kProtobuf, ProtobufSchema("Cycle", fields));
  return writer.AddChannel(schema, "/levitas/cycle", kProtobuf);
}

std::uint16_t AddEvents(McapWriter& writer) {
  const std::array<ProtobufField, 3> fields{{{"text", true}, {"mode", true}, {"fault", true}}};
  const auto schema = writer.AddSchema("levitas.Event", kProtobuf, ProtobufSchema("Event", fields));
  return writer.AddChannel(schema, "/levitas/event", kProtobuf);
}

void AddHeader(McapWriter& writer, const SessionHeader& header) {
  writer.AddMetadata("levitas", {{"program_version", header.program_version},
                                 {"rig", header.rig_yaml},
                                 {"controller", header.controller_yaml},
                                 {"scenario", header.scenario_yaml},
                                 {"pace", header.pace},
                                 {"machine", header.machine},
                                 {"source", header.source}});
}

void WriteEvents(McapWriter& writer, std::uint16_t channel, const SessionReader& reader) {
  for (const Event& event : reader.events()) {
    std::string message;
    AppendText(1, event.text, message);
    AppendText(2, Name(event.mode), message);
    AppendText(3, Name(event.fault), message);
    const auto after_ns = static_cast<std::int64_t>(event.cycle) * reader.header().period_ns;
    writer.Write(channel, reader.header().start_utc_ns + after_ns, message);
  }
}

}  // namespace

ExportReport ExportMcap(SessionReader& reader, const std::string& mcap_path,
                        const ExportSelection& selection) {
  ExportRows rows(reader.header(), selection, LoadTorsion(reader.path()));
  OutputFile file(mcap_path);
  McapWriter writer([&file](std::string_view bytes) { file.Write(bytes); }, "levitas");
  const std::uint16_t cycles = AddCycles(writer, rows.names());
  const std::uint16_t events = AddEvents(writer);
  AddHeader(writer, reader.header());
  std::vector<double> row;
  std::string message;
  const ExportReport report =
      rows.ForEach(reader, [&](std::int64_t time_ns, const std::vector<double>& values) {
        row.assign(1, 1e-9 * static_cast<double>(time_ns));
        row.insert(row.end(), values.begin(), values.end());
        message.clear();
        AppendDoubles(row, message);
        writer.Write(cycles, reader.header().start_utc_ns + time_ns, message);
      });
  WriteEvents(writer, events, reader);
  writer.Finish();
  file.Commit();
  return report;
}

}  // namespace levitas::session
