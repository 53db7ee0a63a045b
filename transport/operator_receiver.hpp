#pragma once
// Receives operator commands from the network in a thread of its own and hands them to the loop
// through a wait-free ring.
//
// Repetition  a command whose sequence number is the last one of the same sender is the same
//             command sent again, and is passed on once, whoever else has spoken in between. The
//             latest kRemembered senders are known: each start of an operator's program is one.
// Excitation  is asked for with a message of its own, whose text is passed on as it came: the
//             command `excite` without one is refused here.
// Failure     construction throws Problem; unknown commands, numbers that are not finite, texts
//             beyond kLongestText and malformed messages are counted and dropped.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "common/enums.hpp"
#include "transport/lcm_packet.hpp"
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
  static constexpr std::size_t kLongestText = 4096;

  /// `take` and `excite` are called in the receiver's thread; while they work, further commands
  /// wait. `excite` gets the text of an excitation_request_t; without it, such requests are left
  /// alone.
  OperatorReceiver(const LcmNetwork& network, std::function<void(const NetworkCommand&)> take,
                   std::function<void(const std::string&)> excite = {});
  ~OperatorReceiver();
  OperatorReceiver(const OperatorReceiver&) = delete;
  OperatorReceiver& operator=(const OperatorReceiver&) = delete;

  [[nodiscard]] std::uint64_t rejected() const noexcept {
    return rejected_.load(std::memory_order_relaxed);
  }

 private:
  void Run();
  void Handle(const Received& received);
  void HandleCommand(const Packet& packet, std::uint64_t sender);
  void HandleExcitation(const Packet& packet, std::uint64_t sender);
  void Reject() noexcept { rejected_.fetch_add(1, std::memory_order_relaxed); }
  [[nodiscard]] bool Repeated(std::uint64_t sender, std::int64_t sequence) noexcept;

  MulticastReceiver receiver_;
  std::function<void(const NetworkCommand&)> take_;
  std::function<void(const std::string&)> excite_;
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
