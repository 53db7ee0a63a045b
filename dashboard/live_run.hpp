#pragma once
// All that is known of the run that is being looked at, from its telemetry: what runs, the newest
// state, timing, events and samples.
//
// Thread   one at a time: the owner holds a lock around every call.
// Failure  a message that cannot be decoded, or does not fit the rig, is counted and dropped.
// Restart  a header of another run starts everything anew; events are kept, with a line between.

#include <cstdint>
#include <deque>
#include <functional>
#include <levitas_msg/controller_state_t.hpp>
#include <levitas_msg/loop_histogram_t.hpp>
#include <levitas_msg/loop_timing_t.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "common/rig_numbers.hpp"
#include "dashboard/sample_store.hpp"
#include "session/log/session_header.hpp"

namespace levitas::dashboard {

struct NumberedEvent {
  std::uint64_t number{};  ///< counts from 1
  session::Event event;
  double time_s{};  ///< of the run
};

/// A block of synchronous control, by what the events of this run told of it.
struct LiveBlock {
  std::string name;
  bool acts{};
  std::string why;  ///< it ended, in words; empty: it never did, or acts
};

class LiveRun {
 public:
  static constexpr std::size_t kMaxEvents = 200;

  /// `on_bucket` is called with each envelope as it closes, from Take.
  explicit LiveRun(std::function<void(const Envelope&)> on_bucket = {})
      : on_bucket_(std::move(on_bucket)) {}

  /// A message of LEVITAS_HEADER, _STATE, _TIMING, _HISTOGRAM, _EVENT or _SAMPLES; others are
  /// none of its business.
  void Take(std::string_view channel, std::span<const std::uint8_t> payload, std::int64_t now_ns);

  /// Of the run whose header came last; empty before the first.
  [[nodiscard]] const std::optional<RigNumbers>& rig() const noexcept { return rig_; }
  /// [Hz] of the slowest amplifier: beyond it the loop does little. 0 before the first header.
  [[nodiscard]] double amplifier_hz() const noexcept { return amplifier_hz_; }
  /// Speed of each bearing's shaft over that of the first; negative where it turns the other way.
  [[nodiscard]] const std::vector<double>& speed_ratios() const noexcept { return speed_ratios_; }
  [[nodiscard]] const session::SessionHeader& header() const noexcept { return header_; }
  /// Of the announced controller, in its order; one that was there before an event was heard is
  /// taken not to act.
  [[nodiscard]] const std::vector<LiveBlock>& blocks() const noexcept { return blocks_; }
  /// Whether the announced controller lowers the bias current.
  [[nodiscard]] bool saves_bias() const noexcept { return saves_bias_; }
  /// Counts the runs seen, 0 before the first.
  [[nodiscard]] std::uint64_t run_number() const noexcept { return run_number_; }
  [[nodiscard]] const std::optional<levitas_msg::controller_state_t>& state() const noexcept {
    return state_;
  }
  [[nodiscard]] std::int64_t state_arrived_ns() const noexcept { return state_arrived_ns_; }
  [[nodiscard]] const std::optional<levitas_msg::loop_timing_t>& timing() const noexcept {
    return timing_;
  }
  [[nodiscard]] const std::optional<levitas_msg::loop_histogram_t>& histogram() const noexcept {
    return histogram_;
  }
  [[nodiscard]] const std::deque<NumberedEvent>& events() const noexcept { return events_; }
  [[nodiscard]] std::uint64_t newest_event() const noexcept { return event_count_; }
  [[nodiscard]] std::optional<SampleStore>& samples() noexcept { return samples_; }
  /// Counts a message that could not be used.
  void Refuse() noexcept { ++refused_; }
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  bool TakeHeader(std::span<const std::uint8_t> payload);
  bool TakeState(std::span<const std::uint8_t> payload, std::int64_t now_ns);
  bool TakeEvent(std::span<const std::uint8_t> payload);
  void TakeController(const session::SessionHeader& header);
  void TellBlock(const session::Event& event);
  bool TakeSamples(std::span<const std::uint8_t> payload);

  std::function<void(const Envelope&)> on_bucket_;
  session::SessionHeader header_;
  double amplifier_hz_{0.0};
  std::vector<double> speed_ratios_;
  std::vector<LiveBlock> blocks_;
  bool saves_bias_{};
  std::optional<RigNumbers> rig_;
  std::uint64_t run_number_{0};
  std::optional<levitas_msg::controller_state_t> state_;
  std::int64_t state_arrived_ns_{0};
  std::optional<levitas_msg::loop_timing_t> timing_;
  std::optional<levitas_msg::loop_histogram_t> histogram_;
  std::deque<NumberedEvent> events_;
  std::uint64_t event_count_{0};
  std::optional<SampleStore> samples_;
  std::uint64_t refused_{0};
};

}  // namespace levitas::dashboard
