#include "session/exchange/candump_import.hpp"

#include <fmt/core.h>

#include <charconv>
#include <optional>
#include <stdexcept>

#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "hil/can/assemblers.hpp"
#include "session/exchange/line_source.hpp"
#include "session/log/output_path.hpp"
#include "session/log/session_writer.hpp"

namespace levitas::session {
namespace {

constexpr std::uint32_t kErrorFlag = 0x2000'0000;  // of the kernel, as candump prints it

[[noreturn]] void NoLine() {
  throw std::invalid_argument(
      "no line of candump; expected (seconds) interface identifier#data, as candump -l writes");
}

std::uint32_t Hex(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) NoLine();
  return value;
}

/// Words of a line, at most three.
std::array<std::string_view, 3> Words(std::string_view line) {
  std::array<std::string_view, 3> words;
  for (auto& word : words) {
    const auto begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) break;
    line.remove_prefix(begin);
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    word = line.substr(0, end);
    line.remove_prefix(end);
  }
  return words;
}

Mode ModeOf(const CurrentFrame& current, double speed_rad_per_s) {
  if (!current.amplifiers_enabled) return Mode::kOff;
  return speed_rad_per_s != 0.0 ? Mode::kSpinning : Mode::kLevitating;
}

class Converter {
 public:
  Converter(const can::Layout& layout, const RecordTaker& take, CandumpReport& report)
      : layout_(layout), rig_(layout), commands_(layout), take_(take), report_(report) {}

  void Take(const can::WireFrame& wire) {
    SensorFrame sensor;
    const can::Outcome from_rig = rig_.Take(wire, sensor);
    if (from_rig == can::Outcome::kFrame) {
      Begin(sensor);
      return;
    }
    if (from_rig != can::Outcome::kForeign) return;
    CurrentFrame current;
    const can::Outcome to_rig = commands_.Take(wire, newest_cycle_, current);
    if (to_rig == can::Outcome::kForeign) ++report_.other_lines;
    if (to_rig != can::Outcome::kFrame && to_rig != can::Outcome::kGoodbye) return;
    current_ = current;
    if (pending_ && current.cycle == newest_cycle_) answered_ = true;
  }

  void Finish() {
    Flush();
    const auto sum = [&](can::Outcome outcome) {
      return rig_.outcomes()[outcome] + commands_.outcomes()[outcome];
    };
    report_.damaged = sum(can::Outcome::kDamaged);
    report_.out_of_order = sum(can::Outcome::kRepeated) + sum(can::Outcome::kOutOfOrder);
    report_.missing_cycles = rig_.lost();
    report_.duration_s =
        static_cast<double>(next_cycle_) * static_cast<double>(layout_.period_ns) * 1e-9;
  }

 private:
  void Begin(const SensorFrame& sensor) {
    if (pending_ && sensor.rig_session == session_ && sensor.cycle == newest_cycle_) return;
    Flush();
    if (session_ != sensor.rig_session) {
      if (session_ != 0) ++report_.rig_restarts;
      // The session counts on where the rig's own count begins anew.
      offset_ = static_cast<std::int64_t>(next_cycle_) - static_cast<std::int64_t>(sensor.cycle);
      commands_ = can::CommandAssembler(layout_);
      session_ = sensor.rig_session;
    }
    newest_cycle_ = sensor.cycle;
    pending_ = sensor;
    answered_ = false;
  }

  void Flush() {
    if (!pending_) return;
    cycle::CycleRecord record;
    const auto cycle =
        static_cast<std::uint64_t>(static_cast<std::int64_t>(pending_->cycle) + offset_);
    record.in.cycle = cycle;
    record.in.frame_present = true;
    record.in.frame = *pending_;
    record.in.frame.sample_time_ns = static_cast<std::int64_t>(cycle) * layout_.period_ns;
    record.out.current = current_;
    record.out.current.cycle = pending_->cycle;
    record.out.current.axes = pending_->axes;
    record.out.mode = ModeOf(current_, pending_->speed_rad_per_s);
    take_(record);
    ++report_.records;
    if (!answered_) ++report_.without_answer;
    next_cycle_ = cycle + 1;
    pending_.reset();
  }

  const can::Layout& layout_;
  can::RigAssembler rig_;
  can::CommandAssembler commands_;
  const RecordTaker& take_;
  CandumpReport& report_;
  std::optional<SensorFrame> pending_;  ///< waits for its currents
  CurrentFrame current_{};
  bool answered_{false};
  std::uint32_t session_{0};
  std::uint64_t newest_cycle_{0};
  std::uint64_t next_cycle_{0};
  std::int64_t offset_{0};
};

}  // namespace

bool ParseCandumpLine(const std::string& line, can::WireFrame& frame) {
  const auto words = Words(line);
  const auto hash = words[2].find('#');
  if (words[0].size() < 3 || words[0].front() != '(' || words[0].back() != ')' ||
      hash == std::string_view::npos) {
    NoLine();
  }
  const std::string_view id = words[2].substr(0, hash);
  std::string_view data = words[2].substr(hash + 1);
  const std::uint32_t number = Hex(id);
  frame = {};
  frame.id = number;
  frame.fd = data.starts_with('#');
  if (frame.fd) {
    if (data.size() < 2) NoLine();
    data.remove_prefix(2);  // the second mark and the flags
  }
  if (data.starts_with('R') || id.size() != 3 || (number & kErrorFlag) != 0) return false;
  const std::size_t most = frame.fd ? can::kMaxPayload : 8;
  if (data.size() % 2 != 0 || data.size() / 2 > most) NoLine();
  frame.length = static_cast<std::uint8_t>(data.size() / 2);
  for (std::size_t byte = 0; byte < frame.length; ++byte) {
    frame.data[byte] = static_cast<std::uint8_t>(Hex(data.substr(2 * byte, 2)));
  }
  return true;
}

CandumpReport ReadCandump(const std::string& path, const can::Layout& layout,
                          const RecordTaker& take) {
  CandumpReport report;
  Converter converter(layout, take, report);
  LineSource lines(path);
  std::string_view text;
  while (lines.Next(text)) {
    if (text.empty()) continue;
    ++report.lines;
    can::WireFrame wire;
    try {
      if (ParseCandumpLine(std::string(text), wire)) {
        converter.Take(wire);
      } else {
        ++report.other_lines;
      }
    } catch (const std::invalid_argument& error) {
      throw BadInput(fmt::format("{}:{}: {}", path, lines.line_number(), error.what()));
    }
  }
  converter.Finish();
  if (report.records == 0) {
    throw BadInput(
        fmt::format("{}: {} lines and no position frame of this rig among them ({} "
                    "damaged); is it the rig of the log?",
                    path, report.lines, report.damaged));
  }
  return report;
}

CandumpReport ImportCandump(const ImportOptions& options, const can::Layout& layout) {
  CheckOutputPath(options.out_path, options.data_path);
  CandumpReport report;
  WriteImport(options, [&](const RecordTaker& take) {
    report = ReadCandump(options.data_path, layout, take);
  });
  return report;
}

}  // namespace levitas::session
