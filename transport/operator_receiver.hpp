#pragma once
// Receives operator commands from the network in a thread of its own and hands them to the loop
// through a wait-free ring.
//
// Repetition  a command whose sequence number is the last one of the same sender is the same
//             command sent again, and is passed on once, whoever else has spoken in between. The
//             latest kRemembered senders are known: each start of an operator's program is one.
// Failure     construction throws Problem; unknown commands, numbers that are not finite and
//             malformed messages are counted and dropped.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <thread>

#include "common/enums.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::transport {

struct NetworkCommand {
  OperatorCommand command{OperatorCommand::kNone};
  double speed_rad_per_s{};
  double acceleration_rad_per_s2{};
};

class OperatorReceiver {
 public:
  static constexpr std::size_t kRemembered = 64;

  /// `take` is called in the receiver's thread; it must not block for long.
  OperatorReceiver(const LcmNetwork& network, std::function<void(const NetworkCommand&)> take);
  ~OperatorReceiver();
  OperatorReceiver(const OperatorReceiver&) = delete;
  OperatorReceiver& operator=(const OperatorReceiver&) = delete;

  [[nodiscard]] std::uint64_t rejected() const noexcept {
    return rejected_.load(std::memory_order_relaxed);
  }

 private:
  void Run();
  void Handle(const Received& received);
  [[nodiscard]] bool Repeated(std::uint64_t sender, std::int64_t sequence) noexcept;

  MulticastReceiver receiver_;
  std::function<void(const NetworkCommand&)> take_;
  struct Seen {
    std::uint64_t sender{0};
    std::int64_t sequence{0};
  };
  std::array<Seen, kRemembered> seen_{};
  std::size_t next_seen_{0};  ///< the longest known sender, replaced by the next new one
  std::atomic<std::uint64_t> rejected_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace levitas::transport
