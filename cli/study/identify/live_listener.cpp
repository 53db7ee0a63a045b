#include "cli/study/identify/live_listener.hpp"

#include <utility>

#include "rt/clock.hpp"
#include "transport/lcm_packet.hpp"

namespace levitas::cli {
namespace {

constexpr std::int64_t kLookNs = 50'000'000;  // how late an end is noticed

bool IsWanted(std::string_view channel) {
  namespace names = transport::channel;
  return channel == names::kHeader || channel == names::kState || channel == names::kSamples;
}

}  // namespace

LiveListener::LiveListener(const transport::LcmNetwork& network)
    : receiver_(network, transport::Direction::kTelemetry), thread_([this] { Run(); }) {}

LiveListener::~LiveListener() {
  stopping_.store(true);
  thread_.join();
}

void LiveListener::Run() {
  while (!stopping_.load()) {
    const auto received = receiver_.Receive(rt::MonotonicNowNs() + kLookNs);
    if (received.datagram.empty()) continue;
    const transport::Packet packet = transport::ParsePacket(received.datagram);
    if (packet.kind != transport::PacketKind::kShort || !IsWanted(packet.channel)) continue;
    LiveMessage message{std::string(packet.channel),
                        {packet.payload.begin(), packet.payload.end()}};
    const std::lock_guard lock(mutex_);
    if (queue_.size() >= kMostQueued) {
      dropped_.fetch_add(1);
      continue;
    }
    queue_.push_back(std::move(message));
    came_.notify_one();
  }
}

std::optional<LiveMessage> LiveListener::Next(std::chrono::milliseconds limit) {
  std::unique_lock lock(mutex_);
  if (!came_.wait_for(lock, limit, [this] { return !queue_.empty(); })) return std::nullopt;
  std::optional<LiveMessage> message(std::move(queue_.front()));
  queue_.pop_front();
  return message;
}

}  // namespace levitas::cli
