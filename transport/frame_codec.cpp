#include "transport/frame_codec.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>

#include "lcmtypes/checked_decode.hpp"
#include "transport/lcm_network.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::transport {

namespace {

// Where the axis count stands in the encoded message: after the fingerprint and the fields before.
constexpr std::size_t kSensorAxesAt = 8 + 8 + 8 + 4 + 4 + 4;
constexpr std::size_t kCurrentAxesAt = 8 + 8;

// Another rig's count would be decoded too, into an array of another length; so it is compared
// first.
template <class Message>
bool DecodeInto(Message& message, std::span<const std::uint8_t> payload, std::size_t axes_at,
                std::size_t axes) noexcept {
  const int size = message.getEncodedSize();
  if (payload.size() != static_cast<std::size_t>(size)) return false;
  const std::array<std::uint8_t, 4> count{0, 0, 0, static_cast<std::uint8_t>(axes)};
  if (std::memcmp(payload.data() + axes_at, count.data(), count.size()) != 0) return false;
  return message::DecodeChecked(payload, message);
}

template <class Message>
std::span<const std::uint8_t> EncodeInto(std::vector<std::uint8_t>& datagram,
                                         const Message& message, std::uint32_t sequence,
                                         const char* channel) noexcept {
  WriteHeader(datagram, sequence, channel);
  const std::size_t header = HeaderSize(channel);
  const int size =
      message.encode(datagram.data() + header, 0, static_cast<int>(datagram.size() - header));
  return std::span(datagram).first(header + static_cast<std::size_t>(std::max(size, 0)));
}

std::size_t Checked(std::size_t axes) {
  if (axes < 1 || axes > kMaxAxes) throw std::invalid_argument("a frame carries 1 to 8 axes");
  return axes;
}

}  // namespace

SensorFrameCodec::SensorFrameCodec(std::size_t axes) : axes_(Checked(axes)) {
  message_.axes = static_cast<std::int32_t>(axes);
  message_.position_m.resize(axes);
  datagram_.resize(HeaderSize(channel::kSensor) +
                   static_cast<std::size_t>(message_.getEncodedSize()));
}

std::span<const std::uint8_t> SensorFrameCodec::Encode(const SensorFrame& frame) noexcept {
  message_.cycle = static_cast<std::int64_t>(frame.cycle);
  message_.sample_time_ns = frame.sample_time_ns;
  message_.rig_session = static_cast<std::int32_t>(frame.rig_session);
  message_.rig_status = static_cast<std::int32_t>(frame.rig_status);
  message_.held_currents = static_cast<std::int32_t>(frame.held_currents);
  std::copy_n(frame.position_m.begin(), axes_, message_.position_m.begin());
  message_.speed_rad_per_s = frame.speed_rad_per_s;
  message_.angle_rad = frame.angle_rad;
  return EncodeInto(datagram_, message_, sequence_++, channel::kSensor);
}

bool SensorFrameCodec::Decode(std::span<const std::uint8_t> payload, SensorFrame& frame) noexcept {
  if (!DecodeInto(message_, payload, kSensorAxesAt, axes_)) return false;
  frame.cycle = static_cast<std::uint64_t>(message_.cycle);
  frame.sample_time_ns = message_.sample_time_ns;
  frame.rig_session = static_cast<std::uint32_t>(message_.rig_session);
  frame.rig_status = static_cast<std::uint32_t>(message_.rig_status);
  frame.held_currents = static_cast<std::uint32_t>(message_.held_currents);
  frame.axes = static_cast<std::uint32_t>(axes_);
  frame.position_m = {};
  std::copy_n(message_.position_m.begin(), axes_, frame.position_m.begin());
  frame.speed_rad_per_s = message_.speed_rad_per_s;
  frame.angle_rad = message_.angle_rad;
  return true;
}

CurrentFrameCodec::CurrentFrameCodec(std::size_t axes) : axes_(Checked(axes)) {
  message_.axes = static_cast<std::int32_t>(axes);
  message_.control_current_a.resize(axes);
  datagram_.resize(std::max(HeaderSize(channel::kCurrent), HeaderSize(channel::kGoodbye)) +
                   static_cast<std::size_t>(message_.getEncodedSize()));
}

void CurrentFrameCodec::Fill(const CurrentFrame& frame) noexcept {
  message_.cycle = static_cast<std::int64_t>(frame.cycle);
  std::copy_n(frame.control_current_a.begin(), axes_, message_.control_current_a.begin());
  message_.bias_current_a = frame.bias_current_a;
  message_.speed_set_point_rad_per_s = frame.speed_set_point_rad_per_s;
  message_.acceleration_limit_rad_per_s2 = frame.acceleration_limit_rad_per_s2;
  message_.amplifiers_enabled = frame.amplifiers_enabled ? 1 : 0;
  message_.drive_enabled = frame.drive_enabled ? 1 : 0;
}

std::span<const std::uint8_t> CurrentFrameCodec::Encode(const CurrentFrame& frame) noexcept {
  Fill(frame);
  return EncodeInto(datagram_, message_, sequence_++, channel::kCurrent);
}

std::span<const std::uint8_t> CurrentFrameCodec::EncodeGoodbye(const CurrentFrame& frame) noexcept {
  Fill(frame);
  return EncodeInto(datagram_, message_, sequence_++, channel::kGoodbye);
}

bool CurrentFrameCodec::Decode(std::span<const std::uint8_t> payload,
                               CurrentFrame& frame) noexcept {
  if (!DecodeInto(message_, payload, kCurrentAxesAt, axes_)) return false;
  frame.cycle = static_cast<std::uint64_t>(message_.cycle);
  frame.axes = static_cast<std::uint32_t>(axes_);
  frame.control_current_a = {};
  std::copy_n(message_.control_current_a.begin(), axes_, frame.control_current_a.begin());
  frame.bias_current_a = message_.bias_current_a;
  frame.speed_set_point_rad_per_s = message_.speed_set_point_rad_per_s;
  frame.acceleration_limit_rad_per_s2 = message_.acceleration_limit_rad_per_s2;
  frame.amplifiers_enabled = message_.amplifiers_enabled != 0;
  frame.drive_enabled = message_.drive_enabled != 0;
  return true;
}

}  // namespace levitas::transport
