#include "session/exchange/csv_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "common/output_file.hpp"

namespace levitas::session {
namespace {

void Number(fmt::memory_buffer& out, double value) {
  if (std::isnan(value)) {  // one spelling, whatever sign the bits have
    fmt::format_to(std::back_inserter(out), ",nan");
  } else {
    fmt::format_to(std::back_inserter(out), ",{}", value);
  }
}

std::string Joined(const std::vector<std::string>& names) {
  std::string line;
  for (const std::string& name : names) line += (line.empty() ? "" : ",") + name;
  return line + "\n";
}

void Row(fmt::memory_buffer& out, std::int64_t time_ns, const std::vector<double>& values,
         std::size_t speed_column) {
  fmt::format_to(std::back_inserter(out), "{}", SecondsText(time_ns));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == speed_column) {
      fmt::format_to(std::back_inserter(out), ",{:.12g}", values[i]);
    } else {
      Number(out, values[i]);
    }
  }
  out.push_back('\n');
}

}  // namespace

std::string SecondsText(std::int64_t time_ns) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  const auto bits = static_cast<std::uint64_t>(time_ns);
  const std::uint64_t magnitude = time_ns < 0 ? 0U - bits : bits;
  std::string text =
      fmt::format("{}{}.{:09}", time_ns < 0 ? "-" : "", magnitude / kSecond, magnitude % kSecond);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

ExportReport ExportCsv(SessionReader& reader, const std::string& csv_path,
                       const ExportSelection& selection) {
  ExportRows rows(reader.header(), selection, LoadTorsion(reader.path()));
  OutputFile file(csv_path);
  fmt::memory_buffer out;
  file.Write(Joined(rows.names()));
  const auto& names = rows.names();
  const auto speed = static_cast<std::size_t>(
      std::find(names.begin() + 1, names.end(), "speed_rpm") - (names.begin() + 1));
  const ExportReport report =
      rows.ForEach(reader, [&](std::int64_t time_ns, const std::vector<double>& values) {
        Row(out, time_ns, values, speed);
        file.Write({out.data(), out.size()});
        out.clear();
      });
  file.Commit();
  return report;
}

}  // namespace levitas::session
