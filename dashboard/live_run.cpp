#include "dashboard/live_run.hpp"

#include <array>
#include <levitas_msg/sample_batch_t.hpp>
#include <utility>

#include "common/problem.hpp"
#include "config/rig_file.hpp"
#include "session/record_codec.hpp"
#include "transport/lcm_network.hpp"

namespace levitas::dashboard {
namespace {

namespace channel = transport::channel;

// Where a message's counts of elements lie, behind the eight bytes of its type. LCM's generated code
// believes them, and would ask for gigabytes on a stranger's word: they are checked before.
template <class Message>
constexpr std::array<std::size_t, 0> kCountsAt{};
template <>
constexpr std::array<std::size_t, 1> kCountsAt<levitas_msg::controller_state_t>{8 + 19};
template <>
constexpr std::array<std::size_t, 1> kCountsAt<levitas_msg::loop_histogram_t>{8 + 8};
template <>
constexpr std::array<std::size_t, 3> kCountsAt<levitas_msg::sample_batch_t>{8 + 16, 8 + 20, 8 + 24};

bool CountFits(std::span<const std::uint8_t> payload, std::size_t at) {
  if (payload.size() < at + 4) return false;
  std::size_t count = 0;
  for (const std::uint8_t byte : payload.subspan(at, 4)) count = count << 8U | byte;
  return count <= payload.size();
}

template <class Message>
bool Decode(std::span<const std::uint8_t> payload, Message& message) {
  for (const std::size_t at : kCountsAt<Message>) {
    if (!CountFits(payload, at)) return false;
  }
  const auto size = static_cast<int>(payload.size());
  return message.decode(payload.data(), 0, size) == size;
}

template <class Message>
bool Keep(std::span<const std::uint8_t> payload, std::optional<Message>& newest) {
  Message message{};
  if (!Decode(payload, message)) return false;
  newest = std::move(message);
  return true;
}

}  // namespace

void LiveRun::Take(std::string_view channel, std::span<const std::uint8_t> payload,
                   std::int64_t now_ns) {
  bool good = true;
  if (channel == channel::kHeader) {
    good = TakeHeader(payload);
  } else if (channel == channel::kState) {
    good = TakeState(payload, now_ns);
  } else if (channel == channel::kTiming) {
    good = Keep(payload, timing_);
  } else if (channel == channel::kHistogram) {
    good = Keep(payload, histogram_);
  } else if (channel == channel::kEvent) {
    good = TakeEvent(payload);
  } else if (channel == channel::kSamples) {
    good = TakeSamples(payload);
  }
  if (!good) ++refused_;
}

bool LiveRun::TakeHeader(std::span<const std::uint8_t> payload) {
  session::SessionHeader header;
  int version = 0;
  if (session::DecodeHeader(payload, header, version) != session::HeaderResult::kGood) return false;
  const bool known = run_number_ > 0 && header.start_utc_ns == header_.start_utc_ns &&
                     header.rig_yaml == header_.rig_yaml;
  if (known) return true;
  try {
    rig_ = config::ParseRig(header.rig_yaml, "the announced rig").numbers;
  } catch (const BadInput&) {
    return false;  // of a program of another version
  }
  header_ = std::move(header);
  samples_.emplace(*rig_);
  state_.reset();
  timing_.reset();
  histogram_.reset();
  ++run_number_;
  return true;
}

bool LiveRun::TakeState(std::span<const std::uint8_t> payload, std::int64_t now_ns) {
  if (!Keep(payload, state_)) return false;
  state_arrived_ns_ = now_ns;
  return true;
}

bool LiveRun::TakeEvent(std::span<const std::uint8_t> payload) {
  session::Event event;
  if (!session::DecodeEvent(payload, event)) return false;
  const double period_s = rig_ ? rig_->period_s() : 0.0;
  const double time_s = static_cast<double>(event.cycle) * period_s;
  events_.push_back({++event_count_, std::move(event), time_s});
  if (events_.size() > kMaxEvents) events_.pop_front();
  return true;
}

bool LiveRun::TakeSamples(std::span<const std::uint8_t> payload) {
  if (!samples_) return true;  // the header is not here yet: nothing is wrong with the batch
  levitas_msg::sample_batch_t batch{};
  return Decode(payload, batch) && samples_->Add(batch);
}

}  // namespace levitas::dashboard
