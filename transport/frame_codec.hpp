#pragma once
// Frames of the per-cycle path as LCM messages in storage made once.
//
// Encoding  by the generated types, so that every LCM tool reads them; header and payload lie in
//           one buffer, ready to be sent.
// Thread    one thread per object; after construction no allocation, no exception.
// Failure   Decode refuses, and leaves its argument untouched, unless fingerprint, axis count and
//           length are exactly those of the rig this codec was made for. It never reads past the
//           payload, whatever that holds.

#include <cstdint>
#include <levitas_msg/current_frame_t.hpp>
#include <levitas_msg/sensor_frame_t.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/frames.hpp"

namespace levitas::transport {

class SensorFrameCodec {
 public:
  /// `axes` 1 .. kMaxAxes.
  explicit SensorFrameCodec(std::size_t axes);
  /// A whole datagram; valid until the next call.
  [[nodiscard]] std::span<const std::uint8_t> Encode(const SensorFrame& frame) noexcept;
  [[nodiscard]] bool Decode(std::span<const std::uint8_t> payload, SensorFrame& frame) noexcept;

 private:
  std::size_t axes_;
  std::uint32_t sequence_{0};
  levitas_msg::sensor_frame_t message_;
  std::vector<std::uint8_t> datagram_;
};

class CurrentFrameCodec {
 public:
  explicit CurrentFrameCodec(std::size_t axes);
  [[nodiscard]] std::span<const std::uint8_t> Encode(const CurrentFrame& frame) noexcept;
  /// The same message on channel::kGoodbye.
  [[nodiscard]] std::span<const std::uint8_t> EncodeGoodbye(const CurrentFrame& frame) noexcept;
  [[nodiscard]] bool Decode(std::span<const std::uint8_t> payload, CurrentFrame& frame) noexcept;

 private:
  void Fill(const CurrentFrame& frame) noexcept;

  std::size_t axes_;
  std::uint32_t sequence_{0};
  levitas_msg::current_frame_t message_;
  std::vector<std::uint8_t> datagram_;
};

}  // namespace levitas::transport
