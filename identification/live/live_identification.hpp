#pragma once
// The recursion beside a loop, from what the controller tells the network: header, states, samples.
//
// Messages  as they come, live or played from a session (play_session.hpp): the same messages give
//           the same parameters bit for bit.
// Rig       of the header: axes, frame and period, and with products the lag of the slowest
//           amplifier and the delay, where none is given.
// End       the header of another run, once rows of this one were learnt: `ended` says so and
//           nothing more is taken.
// Thread    one, not the loop's: what is told is late by what waits for it, the loop never waits.
// Failure   a message that cannot be decoded or does not fit the rig is counted and dropped.
//           What `sensors` throws where they do not fit the announced rig; BadInput of that rig.

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "configuration/rig_file.hpp"
#include "identification/live/sample_feed.hpp"
#include "session/log/session_header.hpp"

namespace levitas::identification {

struct LiveOptions {
  HammersteinWienerOptions model;
  std::optional<double> input_lag_hz{};       ///< none: that of the rig's slowest amplifier
  std::optional<Eigen::Index> input_delay{};  ///< none: that of the rig
  double window_s{1.0};                       ///< of a point
  /// Characteristics for so many axes, once these are known; may throw what Take then throws.
  std::function<std::vector<SensorCharacteristic>(Eigen::Index axes)> sensors{};
};

class LiveIdentification {
 public:
  using OnPoint = std::function<void(const ConvergencePoint&)>;

  explicit LiveIdentification(LiveOptions options, OnPoint on_point = {});
  LiveIdentification(const LiveIdentification&) = delete;
  LiveIdentification& operator=(const LiveIdentification&) = delete;
  LiveIdentification(LiveIdentification&&) = delete;
  LiveIdentification& operator=(LiveIdentification&&) = delete;
  ~LiveIdentification() = default;

  /// A message of LEVITAS_HEADER, _STATE or _SAMPLES; others are none of its business.
  void Take(std::string_view channel, std::span<const std::uint8_t> payload);
  void Take(const session::SessionHeader& header);
  void Take(std::uint64_t cycle, Mode mode);

  /// Empty before the first header.
  [[nodiscard]] const std::optional<configuration::RigFile>& rig() const noexcept { return rig_; }
  [[nodiscard]] const session::SessionHeader& header() const noexcept { return header_; }
  /// Empty before the first header.
  [[nodiscard]] std::optional<OnlineRecursion>& recursion() noexcept { return recursion_; }
  [[nodiscard]] const std::optional<OnlineRecursion>& recursion() const noexcept {
    return recursion_;
  }
  [[nodiscard]] bool levitated() const noexcept { return feed_ && feed_->levitated(); }
  [[nodiscard]] bool ended() const noexcept { return ended_; }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  [[nodiscard]] OnlineOptions OptionsFor(const configuration::RigFile& rig) const;
  bool TakeHeader(std::span<const std::uint8_t> payload);
  bool TakeState(std::span<const std::uint8_t> payload);
  bool TakeSamples(std::span<const std::uint8_t> payload);

  LiveOptions options_;
  OnPoint on_point_;
  session::SessionHeader header_;
  std::optional<configuration::RigFile> rig_;
  std::optional<OnlineRecursion> recursion_;
  std::optional<SampleFeed> feed_;
  bool ended_{};
  std::uint64_t refused_{};
};

}  // namespace levitas::identification
