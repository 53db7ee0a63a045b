#pragma once
// Receives what operators ask for over the network, in two threads: the emergency stop on a path of
// its own (stop_receiver.hpp), everything else here, handed on to those who do the work.
//
// Numbers    each sender's grow. One that is not above the largest taken of that sender is a
//            repetition or old, and is not taken: a datagram that comes twice or late does nothing.
//            A number counts as taken only when the command was: what found no room is taken when
//            it is said again. The latest kRemembered senders are known: each start of an
//            operator's program is one.
// Share      a sender's commands beyond kMostPerSecond are dropped as if there were no room: a
//            flood leaves the others theirs, and the loop and the log what they can carry.
// Stops      are taken whatever their number. A command that was sent before a stop is dropped
//            when it is read after it: the same datagram arrives here too, in the order of sending,
//            and until then whatever comes is older. It may be said again.
// Key        on a network with one the receiver's challenges say what is given now (seal.hpp): who
//            says hello is given one, at most kMostHellos a second.
// Excitation is asked for with a message of its own, whose text is passed on as it came: the
//            command `excite` without one is refused here.
// Failure    construction throws Problem; unsound messages are counted and dropped.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "common/stop_latch.hpp"
#include "transport/lcm_packet.hpp"
#include "transport/multicast_socket.hpp"
#include "transport/operator_message.hpp"
#include "transport/stop_receiver.hpp"

namespace levitas::transport {

/// Called in the receiver's thread, which must not be held up: they queue. False: no room.
struct OperatorHandlers {
  std::function<bool(const NetworkCommand&)> take{};  ///< never an emergency stop
  std::function<bool(const NetworkExcitation&)>
      excite{};                     ///< without it such requests are left alone
  std::function<void()> dropped{};  ///< after each that found no room
  std::function<void()> enter_stop_thread{};
  std::function<void(const Challenge&)> challenge{};  ///< to be published, for who asked
};

/// What was not taken, and why.
struct OperatorCounts {
  std::uint64_t rejected{};   ///< no sound message
  std::uint64_t old{};        ///< a number below the largest of the sender
  std::uint64_t overtaken{};  ///< sent before an emergency stop, read after it
  std::uint64_t dropped{};    ///< no room, or more than the sender's share
};

class OperatorReceiver {
 public:
  static constexpr std::size_t kRemembered = 64;
  /// More than the kernel's queue can hold, whose smallest datagrams take 768 bytes of 8 MiB.
  static constexpr std::size_t kMostQueued = 16'384;
  static constexpr int kMostPerSecond = 50;  ///< far more than a person gives
  static constexpr int kMostHellos = 200;    ///< of all senders, who ask four times a second

  /// Keeps a reference to `stops`.
  OperatorReceiver(const LcmNetwork& network, StopLatch& stops, OperatorHandlers handlers);
  ~OperatorReceiver();
  OperatorReceiver(const OperatorReceiver&) = delete;
  OperatorReceiver& operator=(const OperatorReceiver&) = delete;

  [[nodiscard]] OperatorCounts counts() const noexcept;
  /// As MulticastReceiver::TakeNews.
  [[nodiscard]] std::string TakeNews() { return receiver_.TakeNews(); }

 private:
  using Count = std::atomic<std::uint64_t>;
  struct Share {
    [[nodiscard]] bool Left(std::int64_t now_ns, int most) noexcept;
    std::int64_t second_ns{0};  ///< when the present second began ...
    int in_second{0};           ///< ... and how many were taken in it
  };
  struct Seen {
    std::uint64_t sender{0};  ///< Received::identity
    std::int64_t largest{0};
    Share share{};
  };

  void Run();
  void Handle(const Received& received);
  void HandleCommand(std::uint64_t sender, NetworkCommand command);
  void HandleExcitation(std::uint64_t sender, NetworkExcitation request);
  /// Who asks for a challenge is given it.
  void Welcome(std::uint64_t sender);
  /// Whether this may be taken now; counts why not.
  [[nodiscard]] bool Fits(std::uint64_t sender, std::int64_t sequence);
  void Note(std::uint64_t sender, std::int64_t sequence) noexcept;
  /// After what came of handing it on.
  void Settle(std::uint64_t sender, std::int64_t sequence, bool taken);
  void Drop();
  /// Of each datagram: what was queued before a stop is behind us after kMostQueued at the latest.
  void CountRead() noexcept;
  [[nodiscard]] Seen* Find(std::uint64_t sender) noexcept;
  static void Add(Count& count) noexcept { count.fetch_add(1, std::memory_order_relaxed); }

  MulticastReceiver receiver_;
  StopLatch& stops_;
  OperatorHandlers handlers_;
  std::array<Seen, kRemembered> seen_{};
  std::size_t next_seen_{0};       ///< the longest known sender, replaced by the next new one
  std::uint64_t stops_passed_{0};  ///< how many of the stops this thread has come past
  std::uint64_t next_passed_{0};   ///< of the stops: once enough was read ...
  std::size_t read_behind_{0};     ///< ... since it was set
  Share hellos_{};
  Count rejected_{0}, old_{0}, overtaken_{0}, dropped_{0};
  std::atomic<bool> stopping_{false};
  StopReceiver stop_receiver_;
  std::thread thread_;
};

}  // namespace levitas::transport
