#include "session/csv_export.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <vector>

#include "common/problem.hpp"
#include "session/export_rows.hpp"
#include "session/output_path.hpp"

namespace levitas::session {
namespace {

struct Closer {
  // NOLINTNEXTLINE(cppcoreguidelines-owning-memory): this is the owner's deleter
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};

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

void Row(fmt::memory_buffer& out, std::int64_t time_ns, const std::vector<double>& values) {
  fmt::format_to(std::back_inserter(out), "{}", SecondsText(time_ns));
  Number(out, values[ExportRows::kAngle]);
  fmt::format_to(std::back_inserter(out), ",{:.12g}", values[ExportRows::kSpeed]);
  for (std::size_t i = ExportRows::kSpeed + 1; i < values.size(); ++i) Number(out, values[i]);
  out.push_back('\n');
}

}  // namespace

std::string SecondsText(std::int64_t time_ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t magnitude = time_ns < 0 ? -time_ns : time_ns;
  std::string text =
      fmt::format("{}{}.{:09}", time_ns < 0 ? "-" : "", magnitude / kSecond, magnitude % kSecond);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

ExportReport ExportCsv(SessionReader& reader, const std::string& csv_path) {
  PartFile part(csv_path);
  std::unique_ptr<std::FILE, Closer> file(std::fopen(part.part_path().c_str(), "we"));
  if (!file) {
    throw BadInput(
        fmt::format("{}: cannot be written: {}. Name a file in a folder you may write to.",
                    csv_path, std::strerror(errno)));
  }
  ExportRows rows(reader.header());
  std::vector<double> values;
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "{}", Joined(rows.names()));
  bool sound = true;
  const auto write = [&] {
    sound = sound && std::fwrite(out.data(), 1, out.size(), file.get()) == out.size();
    out.clear();
  };
  ExportReport report;
  cycle::CycleRecord record;
  while (reader.Next(record)) {
    if (!record.in.frame_present) {
      ++report.cycles_without_frame;
      continue;
    }
    Row(out, rows.Next(record, values), values);
    ++report.rows;
    constexpr std::size_t kBlockBytes = std::size_t{1} << 18;
    if (out.size() > kBlockBytes) write();
  }
  write();
  sound = sound && std::fflush(file.get()) == 0;
  file.reset();
  if (!sound) {
    throw Problem(ExitStatus::kOther, fmt::format("{}: writing failed: disk full?", csv_path));
  }
  part.Commit();
  return report;
}

}  // namespace levitas::session
