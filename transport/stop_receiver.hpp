#pragma once
// Hears the emergency stop, and nothing else, in a thread and on a socket of its own.
//
// Why       what other requests cost, how many there are and where their answers go cannot delay
//           it: the kernel gives this socket a copy of every datagram, a filter there drops what is
//           no emergency stop before it is queued, and the thread does nothing but set the latch.
// Repeated  every sound stop is taken, whatever its number: to stop twice does no harm, to take a
//           stop for an old one may. The price: one that arrives late, after a reset, trips again.
// Filter    a saving, not a judgement: where the kernel refuses it, the thread looks at everything.
// Thread    its own; `enter` is called in it first (real-time priority).
// Failure   construction throws Problem.

#include <atomic>
#include <functional>
#include <thread>

#include "common/stop_latch.hpp"
#include "transport/multicast_socket.hpp"

namespace levitas::transport {

class StopReceiver {
 public:
  /// Keeps a reference to `latch`, whose one asking thread this is.
  StopReceiver(const LcmNetwork& network, StopLatch& latch, std::function<void()> enter = {});
  ~StopReceiver();
  StopReceiver(const StopReceiver&) = delete;
  StopReceiver& operator=(const StopReceiver&) = delete;

 private:
  void Run() noexcept;

  MulticastReceiver receiver_;
  StopLatch& latch_;
  std::function<void()> enter_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace levitas::transport
