#include "session/csv_export.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <memory>
#include <numbers>

#include "common/problem.hpp"
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

/// Columns of an injection into the measured position are written when the scenario asks for one.
bool InjectsPosition(const SessionHeader& header) {
  return header.scenario_yaml.find("point: measured_position") != std::string::npos;
}

std::string ColumnNames(const std::vector<std::string>& channels, bool position_excitation) {
  std::string line = "time_s,rotor_angle_rad,speed_rpm";
  for (const auto& channel : channels) line += fmt::format(",position_{}_m", channel);
  for (const auto& channel : channels) line += fmt::format(",control_current_{}_a", channel);
  for (const auto& channel : channels) line += fmt::format(",excitation_{}_a", channel);
  for (std::size_t i = 0; position_excitation && i < channels.size(); ++i) {
    line += fmt::format(",excitation_{}_m", channels[i]);
  }
  return line + "\n";
}

/// Time of the samples on one axis that never goes back.
class TimeAxis {
 public:
  explicit TimeAxis(const SessionHeader& header)
      : period_ns_(header.period_ns), from_zero_(header.pace == "realtime") {}

  std::int64_t Of(const cycle::CycleInputs& in) {
    if (!started_) {
      offset_ns_ = from_zero_ ? -in.frame.sample_time_ns : 0;
    } else if (in.frame.rig_session != rig_session_) {
      // A new rig counts anew: the controller's own count bridges the restart.
      const auto cycles = static_cast<std::int64_t>(in.cycle - cycle_);
      offset_ns_ = time_ns_ + cycles * period_ns_ - in.frame.sample_time_ns;
    }
    started_ = true;
    rig_session_ = in.frame.rig_session;
    cycle_ = in.cycle;
    time_ns_ = in.frame.sample_time_ns + offset_ns_;
    return time_ns_;
  }

 private:
  std::int64_t period_ns_;
  bool from_zero_;
  bool started_{false};
  std::uint32_t rig_session_{};
  std::uint64_t cycle_{};
  std::int64_t time_ns_{};
  std::int64_t offset_ns_{};
};

void Row(fmt::memory_buffer& out, const cycle::CycleRecord& record, std::int64_t time_ns,
         std::size_t axes, bool position_excitation) {
  constexpr double kRpmPerRadPerS = 30.0 / std::numbers::pi;
  const SensorFrame& frame = record.in.frame;
  fmt::format_to(std::back_inserter(out), "{}", SecondsText(time_ns));
  Number(out, frame.angle_rad);
  fmt::format_to(std::back_inserter(out), ",{:.12g}", frame.speed_rad_per_s * kRpmPerRadPerS);
  for (const AxisArray* values :
       {&frame.position_m, &record.out.current.control_current_a, &record.in.op.excitation_a}) {
    for (std::size_t axis = 0; axis < axes; ++axis) Number(out, (*values)[axis]);
  }
  for (std::size_t axis = 0; position_excitation && axis < axes; ++axis) {
    Number(out, record.in.op.excitation_m[axis]);
  }
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
  const auto& channels = reader.header().channels;
  const bool position_excitation = InjectsPosition(reader.header());
  TimeAxis time(reader.header());
  fmt::memory_buffer out;
  fmt::format_to(std::back_inserter(out), "{}", ColumnNames(channels, position_excitation));
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
    Row(out, record, time.Of(record.in), channels.size(), position_excitation);
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
