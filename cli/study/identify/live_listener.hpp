#pragma once
// What a controller tells the network, gathered while the recursion works.
//
// Why      the kernel keeps a fraction of a second of samples; a recursion that pauses for a disk
//          or another program must not lose what comes meanwhile.
// Kept     LEVITAS_HEADER, _STATE and _SAMPLES, at most kMostQueued of them; what comes to a full
//          queue is dropped and counted, and shows as a gap in the cycles.
// Loop     is neither asked nor waited for: it sends to the group whoever listens.
// Thread   one of its own receives; everything else from one other thread.
// Failure  construction throws Problem when the network cannot be joined.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "transport/multicast_socket.hpp"

namespace levitas::cli {

struct LiveMessage {
  std::string channel;
  std::vector<std::uint8_t> payload;
};

class LiveListener {
 public:
  static constexpr std::size_t kMostQueued = 8192;

  explicit LiveListener(const transport::LcmNetwork& network);
  ~LiveListener();
  LiveListener(const LiveListener&) = delete;
  LiveListener& operator=(const LiveListener&) = delete;
  LiveListener(LiveListener&&) = delete;
  LiveListener& operator=(LiveListener&&) = delete;

  /// The oldest that was not taken yet; nothing when none came within `limit`.
  [[nodiscard]] std::optional<LiveMessage> Next(std::chrono::milliseconds limit);
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }
  /// Messages refused for the first time, and why; empty when there is nothing new.
  [[nodiscard]] std::string TakeNews() { return receiver_.TakeNews(); }

 private:
  void Run();

  transport::MulticastReceiver receiver_;
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<LiveMessage> queue_;
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace levitas::cli
