#include "transport/telemetry.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <levitas_msg/controller_state_t.hpp>
#include <levitas_msg/loop_timing_t.hpp>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "common/spsc_ring.hpp"
#include "rt/thread_trouble.hpp"
#include "transport/histogram_message.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::transport {

namespace {

constexpr std::size_t kStateRing = 64;     // 0.6 s of samples
constexpr std::size_t kTimingRing = 4;     // seconds
constexpr std::size_t kEventQueue = 64;    // more at once than a person can read
constexpr std::size_t kAnswerQueue = 256;  // five times what a 10 kHz loop takes between two sends
constexpr std::size_t kChallengeQueue = 64;  // a third of a second of those given
constexpr std::size_t kBatchQueue = 64;      // one second at the rate the batches are made
constexpr auto kSendEvery = std::chrono::milliseconds(5);
constexpr int kRoundsPerAnnouncement = 200;  // a second

using Encoded = std::vector<std::uint8_t>;

std::int32_t Clamp32(double value_ns) {
  return static_cast<std::int32_t>(
      std::min(value_ns, static_cast<double>(std::numeric_limits<std::int32_t>::max())));
}

levitas_msg::controller_state_t Message(const StateSample& sample) {
  levitas_msg::controller_state_t message;
  message.cycle = static_cast<std::int64_t>(sample.cycle);
  message.time_ns = sample.time_ns;
  message.mode = static_cast<std::int8_t>(sample.mode);
  message.fault = static_cast<std::int8_t>(sample.fault);
  message.fault_axis = sample.fault_axis;
  message.axes = static_cast<std::int32_t>(sample.axes);
  const auto take = [&sample](const AxisArray& all) {
    return std::vector<double>(all.begin(), all.begin() + sample.axes);
  };
  message.position_m = take(sample.position_m);
  message.reference_m = take(sample.reference_m);
  message.control_current_a = take(sample.control_current_a);
  message.bias_current_a = sample.bias_current_a;
  message.speed_rad_per_s = sample.speed_rad_per_s;
  message.records_lost = static_cast<std::int64_t>(sample.records_lost);
  return message;
}

levitas_msg::loop_timing_t Message(const TimingSample& sample) {
  levitas_msg::loop_timing_t message{};
  message.cycle = static_cast<std::int64_t>(sample.cycle);
  message.skipped_periods = static_cast<std::int64_t>(sample.skipped_periods);
  message.missing_frames = static_cast<std::int64_t>(sample.missing_frames);
  message.wakeup_p50_ns = Clamp32(sample.wakeup_p50_ns);
  message.wakeup_p99_ns = Clamp32(sample.wakeup_p99_ns);
  message.wakeup_p999_ns = Clamp32(sample.wakeup_p999_ns);
  message.wakeup_max_ns = Clamp32(sample.wakeup_max_ns);
  message.compute_p50_ns = Clamp32(sample.compute_p50_ns);
  message.compute_p99_ns = Clamp32(sample.compute_p99_ns);
  message.compute_max_ns = Clamp32(sample.compute_max_ns);
  message.latency_p50_ns = Clamp32(sample.latency_p50_ns);
  message.latency_p99_ns = Clamp32(sample.latency_p99_ns);
  message.slowest_stage = sample.slowest_stage;
  return message;
}

}  // namespace

struct Telemetry::Impl {
  explicit Impl(const LcmNetwork& network) : sender(network, Direction::kTelemetry) {}

  template <class LcmMessage>
  void Send(const char* channel, const LcmMessage& message) {
    const std::size_t header = HeaderSize(channel);
    const int size = message.getEncodedSize();
    datagram.resize(header + static_cast<std::size_t>(size));
    WriteHeader(datagram, sequence++, channel);
    message.encode(datagram.data() + header, 0, size);
    if (!sender.Send(datagram)) dropped.fetch_add(1, std::memory_order_relaxed);
  }

  void SendEncoded(const char* channel, const Encoded& message) {
    const std::size_t header = HeaderSize(channel);
    datagram.resize(header + message.size());
    WriteHeader(datagram, sequence++, channel);
    std::copy(message.begin(), message.end(),
              datagram.begin() + static_cast<std::ptrdiff_t>(header));
    if (!sender.Send(datagram)) dropped.fetch_add(1, std::memory_order_relaxed);
  }

  void SendAll() {
    StateSample state;
    while (states.Take(state)) Send(channel::kState, Message(state));
    TimingSample timing;
    while (timings.Take(timing)) {
      Send(channel::kTiming, Message(timing));
      Send(channel::kHistogram,
           HistogramMessage(timing.cycle, timing.wakeup, timing.compute, timing.latency));
    }
    std::deque<Encoded> answered;
    std::deque<Encoded> challenged;
    std::deque<Encoded> told;
    std::deque<Encoded> sampled;
    Encoded announced;
    {
      const std::lock_guard lock(mutex);
      answered.swap(answers);
      challenged.swap(challenges);
      told.swap(events);
      sampled.swap(batches);
      if (round++ % kRoundsPerAnnouncement == 0) announced = announcement;
    }
    for (const Encoded& answer : answered) SendEncoded(channel::kAnswer, answer);
    for (const Encoded& one : challenged) SendEncoded(channel::kChallenge, one);
    for (const Encoded& event : told) SendEncoded(channel::kEvent, event);
    for (const Encoded& batch : sampled) SendEncoded(channel::kSamples, batch);
    if (!announced.empty()) SendEncoded(channel::kHeader, announced);
  }

  void Queue(std::deque<Encoded>& queue, std::size_t capacity, Encoded encoded) {
    const std::lock_guard lock(mutex);
    if (queue.size() == capacity) {
      dropped.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    queue.push_back(std::move(encoded));
  }

  void Run() {
    while (!stopping.load()) {
      rt::Guarded("telemetry", [this] { SendAll(); });
      std::this_thread::sleep_for(kSendEvery);
    }
    rt::Guarded("telemetry", [this] { SendAll(); });
  }

  MulticastSender sender;
  Encoded datagram;
  std::uint32_t sequence{0};
  SpscRing<StateSample> states{kStateRing};
  SpscRing<TimingSample> timings{kTimingRing};
  std::mutex mutex;
  std::deque<Encoded> answers;
  std::deque<Encoded> challenges;
  std::deque<Encoded> events;
  std::deque<Encoded> batches;
  Encoded announcement;
  int round{0};
  std::atomic<std::uint64_t> dropped{0};
  std::atomic<bool> stopping{false};
  std::thread thread;
};

Telemetry::Telemetry(const LcmNetwork& network) : impl_(std::make_unique<Impl>(network)) {
  impl_->thread = std::thread([this] { impl_->Run(); });
}

Telemetry::~Telemetry() {
  impl_->stopping.store(true);
  impl_->thread.join();
}

void Telemetry::PostState(const StateSample& sample) noexcept { impl_->states.Post(sample); }

void Telemetry::PostTiming(const TimingSample& sample) noexcept { impl_->timings.Post(sample); }

void Telemetry::PostEvent(std::vector<std::uint8_t> encoded) {
  impl_->Queue(impl_->events, kEventQueue, std::move(encoded));
}

void Telemetry::PostAnswer(std::vector<std::uint8_t> encoded) {
  impl_->Queue(impl_->answers, kAnswerQueue, std::move(encoded));
}

void Telemetry::PostChallenge(std::vector<std::uint8_t> encoded) {
  impl_->Queue(impl_->challenges, kChallengeQueue, std::move(encoded));
}

void Telemetry::PostSamples(std::vector<std::uint8_t> encoded) {
  impl_->Queue(impl_->batches, kBatchQueue, std::move(encoded));
}

void Telemetry::Announce(std::vector<std::uint8_t> encoded) {
  const std::lock_guard lock(impl_->mutex);
  impl_->announcement = std::move(encoded);
  impl_->round = 0;
}

std::uint64_t Telemetry::dropped() const noexcept {
  return impl_->dropped.load(std::memory_order_relaxed) + impl_->states.lost() +
         impl_->timings.lost();
}

}  // namespace levitas::transport
