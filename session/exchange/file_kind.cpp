#include "session/exchange/file_kind.hpp"

#include <fmt/core.h>
#include <sys/stat.h>

#include <array>
#include <fstream>

#include "common/problem.hpp"

namespace levitas::session {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kThen =
    " Then: amb import FILE.csv --rig RIG --guess, which prints what each column probably is";

struct KnownKind {
  std::string_view start;
  std::string_view name;
  std::string_view remedy;  ///< a sentence; empty: the one of a spreadsheet or archive
  bool then{true};          ///< whether the result is a CSV file with names of others
};

constexpr std::array<KnownKind, 19> kKinds{
    {{"PAR1"sv, "a Parquet file",
      "Write it as CSV, for instance: python3 -c \"import pandas; "
      "pandas.read_parquet('FILE.parquet').to_csv('FILE.csv', index=False)\"."},
     {"TDSm"sv, "a TDMS file (LabVIEW)",
      "Write it as CSV: in DIAdem or LabVIEW by exporting to text, or python3 -c \"import nptdms; "
      "nptdms.TdmsFile('FILE.tdms').as_dataframe().to_csv('FILE.csv', index=False)\"."},
     {"TDSh"sv, "the index of a TDMS file (LabVIEW), without its data",
      "Write the .tdms file beside it as CSV: in DIAdem or LabVIEW by exporting to text, or "
      "python3 "
      "-c \"import nptdms; nptdms.TdmsFile('FILE.tdms').as_dataframe().to_csv('FILE.csv', "
      "index=False)\"."},
     {"\x89MCAP0\r\n"sv, "an MCAP file",
      "If amb export wrote it: import nothing, the session that it was made of is what every "
      "command "
      "takes; amb export SESSION --csv FILE.csv writes it as text. Else export the channels as CSV "
      "where it was recorded (Foxglove, PlotJuggler)."},
     {"\x89HDF\r\n\x1a\n"sv, "an HDF5 file",
      "A MATLAB file of version 7.3 is read by the ending .mat; of another one write the channels "
      "as "
      "CSV, for instance with h5py and numpy.savetxt."},
     {"MATLAB 5.0 MAT-file"sv, "a MATLAB file", "Give it the ending .mat.", false},
     {"MATLAB 7.3 MAT-file"sv, "a MATLAB file", "Give it the ending .mat.", false},
     {"MDF     "sv, "an MDF file (ASAM measurement data)",
      "Write one raster as CSV: in CANape, INCA or the tool asammdf by its export to CSV."},
     {"#ROSBAG V"sv, "a ROS bag", "Export the topics as CSV (PlotJuggler does)."},
     {"SQLite format 3"sv, "an SQLite file (a ROS 2 bag is one)",
      "Export the tables or topics as CSV."},
     {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1"sv, "an Excel workbook of the old kind (.xls)",
      "Save the sheet as CSV: in Excel \"Save As, CSV UTF-8\", or soffice --headless --convert-to "
      "csv FILE.xls."},
     {"\x1F\x8B"sv, "compressed by gzip", "Unpack it first: gunzip FILE.gz.", false},
     {"BZh"sv, "compressed by bzip2", "Unpack it first: bunzip2 FILE.bz2.", false},
     {"\x28\xB5\x2F\xFD"sv, "compressed by zstd",
      "If it is a session (.lcm.zst) it is what every command takes: import nothing. Else unpack "
      "it "
      "first: unzstd FILE.zst.",
      false},
     {"\xFF\xFE"sv, "text in UTF-16",
      "Save it as UTF-8: iconv -f UTF-16 -t UTF-8 FILE > FILE.csv."},
     {"\xFE\xFF"sv, "text in UTF-16",
      "Save it as UTF-8: iconv -f UTF-16 -t UTF-8 FILE > FILE.csv."},
     {"\xED\xA1\xDA\x01"sv, "an LCM log",
      "If it is a session it is what every command takes: import nothing. Another log: write its "
      "channels as CSV.",
      false},
     {"{"sv, "JSON", "Write one row per sample as CSV."},
     {"<"sv, "XML or HTML", "Write one row per sample as CSV."}}};

std::string Sentence(const std::string& path, const KnownKind& kind) {
  return fmt::format("{}: is {}, which is not read here. {}{}", path, kind.name, kind.remedy,
                     kind.then ? kThen : ""sv);
}

/// Excel's and OpenDocument's files are zip archives.
std::string Archive(const std::string& path, std::string_view start) {
  const auto holds = [start](std::string_view word) {
    return start.find(word) != std::string_view::npos;
  };
  if (holds("[Content_Types].xml") || holds("xl/")) {
    return Sentence(path, {{},
                           "an Excel workbook",
                           "Save the sheet as CSV: in Excel \"Save As, CSV UTF-8\", or soffice "
                           "--headless --convert-to csv FILE.xlsx."});
  }
  if (holds("opendocument.spreadsheet")) {
    return Sentence(path, {{},
                           "an OpenDocument spreadsheet",
                           "Save the sheet as CSV: soffice --headless --convert-to csv FILE.ods."});
  }
  return Sentence(path, {{}, "a zip archive", "Unpack it first.", false});
}

}  // namespace

std::string OtherKind(const std::string& path, std::string_view start) {
  if (start.starts_with("PK\x03\x04")) return Archive(path, start);
  if (start.starts_with("\xFD"
                        "7zXZ")) {
    if (path.ends_with(".xz")) return {};
    return Sentence(path, {{}, "compressed by xz", "Give it the ending .csv.xz.", false});
  }
  for (const KnownKind& kind : kKinds) {
    if (start.starts_with(kind.start)) return Sentence(path, kind);
  }
  return {};
}

void RefuseOtherKind(const std::string& path) {
  struct stat status {};
  // What comes through a pipe comes once: its first bytes are those of the rows.
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  std::array<char, 4096> bytes{};
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), bytes.size());
  const std::string text = OtherKind(path, {bytes.data(), static_cast<std::size_t>(file.gcount())});
  if (!text.empty()) throw BadInput(text);
}

}  // namespace levitas::session
