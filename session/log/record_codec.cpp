#include "session/log/record_codec.hpp"

#include <algorithm>
#include <array>
#include <levitas_msg/event_t.hpp>
#include <levitas_msg/session_header_t.hpp>

#include "common/crc32.hpp"
#include "lcmtypes/checked_decode.hpp"
#include "session/log/log_format.hpp"

namespace levitas::session {
namespace {

using Input = std::span<const std::uint8_t>;
using message::kHashBytes;
constexpr std::size_t kCrcBytes = 4;

/// CRC over everything, the last four bytes (the CRC field) taken as zero.
std::uint32_t CrcWithFieldZero(Input bytes) noexcept {
  constexpr std::array<std::uint8_t, kCrcBytes> kZero{};
  return Crc32(kZero.data(), kCrcBytes, Crc32(bytes.data(), bytes.size() - kCrcBytes));
}

bool CrcFits(Input bytes) noexcept {
  return bytes.size() >= kHashBytes + kCrcBytes &&
         CrcWithFieldZero(bytes) ==
             GetBigEndian<std::uint32_t>(bytes.data() + bytes.size() - kCrcBytes);
}

template <class Message>
void EncodeMessage(const Message& message, Bytes& out) {
  out.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(out.data(), 0, static_cast<int>(out.size()));
}

/// Strings of the format end at a zero byte; one inside a text would make the whole unreadable.
std::string UntilZero(const std::string& text) { return text.c_str(); }

void FillCrc(Bytes& out) noexcept {
  PutBigEndian(out.data() + out.size() - kCrcBytes, CrcWithFieldZero(out));
}

void ToVector(const AxisArray& from, std::vector<double>& to) noexcept {
  std::copy_n(from.begin(), to.size(), to.begin());
}

AxisArray ToArray(const std::vector<double>& from, std::size_t axes) noexcept {
  AxisArray to{};
  std::copy_n(from.begin(), std::min(axes, from.size()), to.begin());
  return to;
}

void PutInputs(const cycle::CycleInputs& in, levitas_msg::cycle_record_t& m) noexcept {
  m.cycle = static_cast<std::int64_t>(in.cycle);
  m.frame_present = static_cast<std::int8_t>(in.frame_present);
  m.frame_cycle = static_cast<std::int64_t>(in.frame.cycle);
  m.sample_time_ns = in.frame.sample_time_ns;
  m.rig_session = static_cast<std::int32_t>(in.frame.rig_session);
  m.rig_status = static_cast<std::int32_t>(in.frame.rig_status);
  m.held_currents = static_cast<std::int32_t>(in.frame.held_currents);
  m.frame_axes = static_cast<std::int32_t>(in.frame.axes);
  ToVector(in.frame.position_m, m.position_m);
  m.speed_rad_per_s = in.frame.speed_rad_per_s;
  m.angle_rad = in.frame.angle_rad;
  m.missed_deadlines = static_cast<std::int32_t>(in.missed_deadlines);
  m.command = static_cast<std::int8_t>(in.op.command);
  m.command_speed_rad_per_s = in.op.speed_rad_per_s;
  m.command_acceleration_rad_per_s2 = in.op.acceleration_rad_per_s2;
  ToVector(in.op.excitation_a, m.excitation_a);
  ToVector(in.op.excitation_m, m.excitation_m);
  const auto coils = std::min<std::size_t>(in.coils, in.coil_current_a.size());
  m.coils = static_cast<std::int32_t>(coils);
  m.coil_current_a.assign(in.coil_current_a.begin(),
                          in.coil_current_a.begin() + static_cast<std::ptrdiff_t>(coils));
}

void PutOutputs(const cycle::CycleOutputs& out, levitas_msg::cycle_record_t& m) noexcept {
  m.mode = static_cast<std::int8_t>(out.mode);
  m.fault = static_cast<std::int8_t>(out.fault);
  m.fault_axis = out.fault_axis;
  m.saturated_axes = static_cast<std::int16_t>(out.saturated_axes);
  m.fault_value = out.fault_value;
  m.fault_limit = out.fault_limit;
  m.command_refused = static_cast<std::int8_t>(out.command_refused);
  ToVector(out.reference_m, m.reference_m);
  m.current_cycle = static_cast<std::int64_t>(out.current.cycle);
  m.current_axes = static_cast<std::int32_t>(out.current.axes);
  ToVector(out.current.control_current_a, m.control_current_a);
  m.bias_current_a = out.current.bias_current_a;
  m.speed_set_point_rad_per_s = out.current.speed_set_point_rad_per_s;
  m.acceleration_limit_rad_per_s2 = out.current.acceleration_limit_rad_per_s2;
  m.amplifiers_enabled = static_cast<std::int8_t>(out.current.amplifiers_enabled);
  m.drive_enabled = static_cast<std::int8_t>(out.current.drive_enabled);
}

cycle::CycleInputs GetInputs(const levitas_msg::cycle_record_t& m) noexcept {
  const auto axes = static_cast<std::size_t>(m.axes);
  cycle::CycleInputs in;
  in.cycle = static_cast<std::uint64_t>(m.cycle);
  in.frame_present = m.frame_present != 0;
  in.frame.cycle = static_cast<std::uint64_t>(m.frame_cycle);
  in.frame.sample_time_ns = m.sample_time_ns;
  in.frame.rig_session = static_cast<std::uint32_t>(m.rig_session);
  in.frame.rig_status = static_cast<std::uint32_t>(m.rig_status);
  in.frame.held_currents = static_cast<std::uint32_t>(m.held_currents);
  in.frame.axes = static_cast<std::uint32_t>(m.frame_axes);
  in.frame.position_m = ToArray(m.position_m, axes);
  in.frame.speed_rad_per_s = m.speed_rad_per_s;
  in.frame.angle_rad = m.angle_rad;
  in.missed_deadlines = static_cast<std::uint32_t>(m.missed_deadlines);
  in.op.command = static_cast<OperatorCommand>(m.command);
  in.op.speed_rad_per_s = m.command_speed_rad_per_s;
  in.op.acceleration_rad_per_s2 = m.command_acceleration_rad_per_s2;
  in.op.excitation_a = ToArray(m.excitation_a, axes);
  in.op.excitation_m = ToArray(m.excitation_m, axes);
  const std::size_t coils = std::min(m.coil_current_a.size(), in.coil_current_a.size());
  in.coils = static_cast<std::uint32_t>(coils);
  std::copy_n(m.coil_current_a.begin(), coils, in.coil_current_a.begin());
  return in;
}

cycle::CycleOutputs GetOutputs(const levitas_msg::cycle_record_t& m) noexcept {
  const auto axes = static_cast<std::size_t>(m.axes);
  cycle::CycleOutputs out;
  out.mode = static_cast<Mode>(m.mode);
  out.fault = static_cast<Fault>(m.fault);
  out.fault_axis = m.fault_axis;
  out.saturated_axes = static_cast<std::uint16_t>(m.saturated_axes);
  out.fault_value = m.fault_value;
  out.fault_limit = m.fault_limit;
  out.command_refused = m.command_refused != 0;
  out.reference_m = ToArray(m.reference_m, axes);
  out.current.cycle = static_cast<std::uint64_t>(m.current_cycle);
  out.current.axes = static_cast<std::uint32_t>(m.current_axes);
  out.current.control_current_a = ToArray(m.control_current_a, axes);
  out.current.bias_current_a = m.bias_current_a;
  out.current.speed_set_point_rad_per_s = m.speed_set_point_rad_per_s;
  out.current.acceleration_limit_rad_per_s2 = m.acceleration_limit_rad_per_s2;
  out.current.amplifiers_enabled = m.amplifiers_enabled != 0;
  out.current.drive_enabled = m.drive_enabled != 0;
  return out;
}

/// The words of the record are those that this program knows.
bool WordsFit(const levitas_msg::cycle_record_t& m) noexcept {
  const auto below = [](std::int8_t word, std::uint8_t count) { return word >= 0 && word < count; };
  return below(m.mode, kModeCount) && below(m.fault, kFaultCount) &&
         below(m.command, kOperatorCommandCount);
}

}  // namespace

RecordCodec::RecordCodec(std::size_t axes) : message_{} {
  const std::size_t count = std::min(axes, kMaxAxes);
  message_.axes = static_cast<std::int32_t>(count);
  for (auto* values : {&message_.position_m, &message_.excitation_a, &message_.excitation_m,
                       &message_.reference_m, &message_.control_current_a}) {
    values->resize(count);
  }
  message_.coil_current_a.reserve(2 * kMaxAxes);
}

void RecordCodec::Encode(const cycle::CycleRecord& record, Bytes& out) {
  PutInputs(record.in, message_);
  PutOutputs(record.out, message_);
  message_.crc = 0;
  EncodeMessage(message_, out);
  FillCrc(out);
}

bool RecordCodec::Decode(Input bytes, cycle::CycleRecord& record) {
  // The layout first: it is quickly walked, whatever length a damaged file claims.
  if (!message::Fits(message::kLayout<levitas_msg::cycle_record_t>, bytes)) return false;
  if (!CrcFits(bytes) || !message::DecodeChecked(bytes, message_) || !WordsFit(message_)) {
    return false;
  }
  record = {GetInputs(message_), GetOutputs(message_)};
  return true;
}

void EncodeEvent(const Event& event, Bytes& out) {
  levitas_msg::event_t message;
  message.cycle = static_cast<std::int64_t>(event.cycle);
  message.time_ns = event.time_ns;
  message.severity = static_cast<std::int8_t>(event.severity);
  message.mode = static_cast<std::int8_t>(event.mode);
  message.fault = static_cast<std::int8_t>(event.fault);
  message.axis = event.axis;
  message.value = event.value;
  message.limit = event.limit;
  message.text = UntilZero(event.text);
  EncodeMessage(message, out);
}

bool DecodeEvent(Input bytes, Event& event) {
  levitas_msg::event_t message;
  if (!message::DecodeChecked(bytes, message)) return false;
  // The type has no CRC, so its enumerations are checked.
  if (message.severity < 0 || message.severity > 2 || message.mode < 0 ||
      message.mode >= kModeCount || message.fault < 0 || message.fault >= kFaultCount) {
    return false;
  }
  event = {.cycle = static_cast<std::uint64_t>(message.cycle),
           .time_ns = message.time_ns,
           .severity = static_cast<Event::Severity>(message.severity),
           .mode = static_cast<Mode>(message.mode),
           .fault = static_cast<Fault>(message.fault),
           .axis = message.axis,
           .value = message.value,
           .limit = message.limit,
           .text = message.text};
  return true;
}

void EncodeHeader(const SessionHeader& header, Bytes& out) {
  levitas_msg::session_header_t message;
  message.format_version = kFormatVersion;
  message.program_version = UntilZero(header.program_version);
  message.rig_yaml = UntilZero(header.rig_yaml);
  message.controller_yaml = UntilZero(header.controller_yaml);
  message.scenario_yaml = UntilZero(header.scenario_yaml);
  message.pace = UntilZero(header.pace);
  message.seed = header.seed;
  message.period_ns = header.period_ns;
  message.start_utc_ns = header.start_utc_ns;
  message.machine = UntilZero(header.machine);
  message.source = UntilZero(header.source);
  message.channels = static_cast<std::int32_t>(header.channels.size());
  for (const std::string& channel : header.channels) message.channel.push_back(UntilZero(channel));
  message.excerpt_of = UntilZero(header.excerpt_of);
  message.crc = 0;
  EncodeMessage(message, out);
  FillCrc(out);
}

HeaderResult DecodeHeader(Input bytes, SessionHeader& header, int& version) {
  if (bytes.size() < kHashBytes + 4) return HeaderResult::kDamaged;
  // The version is the first field in all versions, so that it can be told even when the rest of
  // the type, and with it the type's hash, is another.
  constexpr int kHighestBelievable = 1000;
  version = GetBigEndian<std::int32_t>(bytes.data() + kHashBytes);
  const bool other = version != kFormatVersion && version > 0 && version < kHighestBelievable;
  if (!other && !message::Fits(message::kLayout<levitas_msg::session_header_t>, bytes)) {
    return HeaderResult::kDamaged;
  }
  if (!CrcFits(bytes)) return HeaderResult::kDamaged;
  if (other) return HeaderResult::kOtherVersion;
  levitas_msg::session_header_t message;
  if (!message::DecodeChecked(bytes, message)) return HeaderResult::kDamaged;
  header = {.program_version = message.program_version,
            .rig_yaml = message.rig_yaml,
            .controller_yaml = message.controller_yaml,
            .scenario_yaml = message.scenario_yaml,
            .pace = message.pace,
            .seed = message.seed,
            .period_ns = message.period_ns,
            .start_utc_ns = message.start_utc_ns,
            .machine = message.machine,
            .source = message.source,
            .channels = message.channel,
            .excerpt_of = message.excerpt_of};
  return HeaderResult::kGood;
}

}  // namespace levitas::session
