#pragma once
// Receives operator commands from the network in a thread of its own and hands them to the loop
// through a wait-free ring.
//
// Repetition  a command whose sequence number is the last one of the same sender is the same
//             command sent again, and is passed on once.
// Failure     construction throws Problem; unknown commands, numbers that are not finite and
//             malformed messages are counted and dropped.

#include <atomic>
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

  MulticastReceiver receiver_;
  std::function<void(const NetworkCommand&)> take_;
  std::uint64_t last_sender_{0};
  std::int64_t last_sequence_{0};
  std::atomic<std::uint64_t> rejected_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace levitas::transport
