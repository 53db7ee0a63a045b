#pragma once
// One direction of a multicast network: a socket that sends to the group, or one that listens.
//
// Why own sockets  liblcm hands a message through a thread, a pipe and a queue; these do not
//                  (measured: docs/timing.md). What is on the wire is the same.
// Who is heard     with ttl 0 the group is joined and sent to on the loopback interface only, so
//                  that nothing of another machine arrives and no route is needed; what came in
//                  through another interface all the same is counted and dropped. With ttl above
//                  0 the interface is that of the route to the group.
// Key              of a network with one: what is sent is sealed, what is received without a good
//                  seal is dropped, counted and named (seal.hpp). Of commands only what says the
//                  receiver's challenge is taken, except for what SealSuffices names.
// Thread           one thread per object; TakeNews, Trouble and refused: any one other. After
//                  construction no allocation, no exception.
// Blocking         Send never waits. Receive waits at most until its deadline: a short wait spins,
//                  a long one spins for a bounded time (while that has been paying off), then
//                  sleeps in ppoll.
// Failure          construction throws Problem (exit status 1) with the remedy, in particular when
//                  the interface is down or multicast has no route; later failures are return
//                  values.

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "transport/lcm_network.hpp"
#include "transport/speaker.hpp"

struct sock_filter;  // linux/filter.h

namespace levitas::transport {

class MulticastSender {
 public:
  MulticastSender(const LcmNetwork& network, Direction direction);
  ~MulticastSender();
  MulticastSender(const MulticastSender&) = delete;
  MulticastSender& operator=(const MulticastSender&) = delete;

  /// False when the kernel did not take the datagram.
  bool Send(std::span<const std::uint8_t> datagram) noexcept;
  /// The UDP port it sends from.
  [[nodiscard]] std::uint16_t port() const noexcept;
  /// Who it is in its seals; 0 without a key.
  [[nodiscard]] std::uint64_t identity() const noexcept;
  /// From now on what is sent carries this challenge of the receiver (seal.hpp).
  void AnswerChallenge(std::uint64_t challenge) noexcept;

 private:
  int socket_{-1};
  struct Sealing;
  std::unique_ptr<Sealing> sealing_;  ///< null: no key
};

struct Received {
  std::span<const std::uint8_t> datagram{};  ///< empty: nothing; valid until the next receive
  std::uint64_t sender{};                    ///< address and port of the sender, as one number
  /// Who the sender is: of its seal where there is a key, else the same as `sender`. Whoever can
  /// forge an address is somebody else all the same.
  std::uint64_t identity{};
  /// False: the seal is good, but a record may have it; see HearUnproven.
  bool proven{true};

  [[nodiscard]] Speaker speaker() const noexcept { return {identity, sender}; }
};

/// "127.0.0.1:4711", of Received::sender.
[[nodiscard]] std::string AddressText(std::uint64_t sender);

class MulticastReceiver {
 public:
  /// `spin_ns` bounds the spin before each sleep; 0 never spins.
  MulticastReceiver(const LcmNetwork& network, Direction direction, std::int64_t spin_ns = 0);
  ~MulticastReceiver();
  MulticastReceiver(const MulticastReceiver&) = delete;
  MulticastReceiver& operator=(const MulticastReceiver&) = delete;

  /// Next datagram that is already there, as far as the latest system call knows: after a Receive
  /// that emptied the socket this costs nothing.
  [[nodiscard]] Received Next() noexcept;
  /// Next datagram, waiting until CLOCK_MONOTONIC reaches `deadline_ns` at the latest.
  [[nodiscard]] Received Receive(std::int64_t deadline_ns) noexcept;
  /// Datagrams dropped: through an interface that is not joined, or without a good seal.
  [[nodiscard]] std::uint64_t refused() const noexcept;
  /// What was refused for the first time, and of whom; empty when there is nothing new.
  [[nodiscard]] std::string TakeNews();
  /// How much was refused and why; empty when nothing was.
  [[nodiscard]] std::string Trouble() const;
  /// From now on also what a new sender seals by another clock than ours, marked as not proven.
  void HearUnproven() noexcept { unproven_ = true; }
  /// The sender of the datagram received last, not proven, has shown that it speaks now.
  void Trust() noexcept;
  /// What those who want to be heard here have to carry in their seals now; 0 without a key.
  [[nodiscard]] std::uint64_t Challenge() noexcept;
  /// The kernel queues only what `program` passes from now on; false when it refuses.
  [[nodiscard]] bool Filter(std::span<const sock_filter> program) noexcept;

 private:
  [[nodiscard]] Received Poll() noexcept;
  [[nodiscard]] Received Spin(std::int64_t until_ns) noexcept;

  int socket_{-1};
  bool unproven_{false};
  std::int64_t spin_ns_;
  std::string url_;  ///< for people
  std::uint32_t waits_{0};
  std::uint32_t fruitless_spins_{0};
  struct Batch;
  std::unique_ptr<Batch> batch_;  ///< datagrams of one system call
};

}  // namespace levitas::transport
