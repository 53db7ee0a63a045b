#include "transport/stop_receiver.hpp"

#include <linux/filter.h>

#include <array>
#include <utility>

#include "common/enums.hpp"
#include "rt/clock.hpp"
#include "rt/thread_trouble.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/operator_message.hpp"

namespace levitas::transport {

namespace {
constexpr std::int64_t kStopSliceNs = 50'000'000;  // how long the destructor may have to wait

// Where the command stands, counted as the kernel's filter does, from the UDP header on: behind
// that header, LCM's, the type's hash and the sequence number.
constexpr std::uint32_t kUdpHeader = 8;
constexpr std::uint32_t kCommandAt =
    kUdpHeader + static_cast<std::uint32_t>(HeaderSize(channel::kCommand)) + 8 + 8;
constexpr auto kStop = static_cast<std::uint32_t>(OperatorCommand::kEmergencyStop);
// Load that byte (a shorter datagram is dropped); pass the whole datagram when it says stop.
constexpr std::array<sock_filter, 4> kOnlyStops{{{BPF_LD | BPF_B | BPF_ABS, 0, 0, kCommandAt},
                                                 {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, kStop},
                                                 {BPF_RET | BPF_K, 0, 0, 0xffffffffU},
                                                 {BPF_RET | BPF_K, 0, 0, 0}}};
}  // namespace

StopReceiver::StopReceiver(const LcmNetwork& network, StopLatch& latch, std::function<void()> enter)
    : receiver_(network, Direction::kCommand), latch_(latch), enter_(std::move(enter)) {
  (void)receiver_.Filter(kOnlyStops);
  thread_ = std::thread([this] { Run(); });
}

StopReceiver::~StopReceiver() {
  stopping_.store(true);
  thread_.join();
}

void StopReceiver::Run() noexcept {
  if (enter_) rt::Guarded("emergency stop", enter_);
  while (!stopping_.load(std::memory_order_relaxed)) {
    rt::Guarded("emergency stop", [this] {
      const Received received = receiver_.Receive(rt::MonotonicNowNs() + kStopSliceNs);
      CommandOrigin origin;
      if (received.datagram.empty() || !IsEmergencyStop(received, origin)) return;
      latch_.Ask(rt::MonotonicNowNs(), origin);
    });
  }
}

}  // namespace levitas::transport
