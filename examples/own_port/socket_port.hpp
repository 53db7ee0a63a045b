#pragma once
// A port of one's own: frames and currents over a UNIX socket between two processes of one build.
//
// Controller  SocketPort, the RigPort that a ControlLoop reads and writes.
// Rig         SocketLink, the RigLink that a PlantLoop answers on; a real rig has its bus here.
// Messages    the bytes of SensorFrame and CurrentFrame. That does between two processes of the
//             same build on one machine; a wire between machines needs a layout of its own.
// Thread      loop thread of its end; no heap, no locks, no exceptions.
// Waiting     to the deadline at most, and then only for what has not come.
// Failure     a rig that is gone reads as nothing, and ends the loop through `when_gone`; a
//             controller that is gone is one that said goodbye.

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <functional>

#include "common/rig_link.hpp"
#include "common/rig_port.hpp"
#include "rt/clock.hpp"

struct CurrentMessage {
  levitas::CurrentFrame frame;
  bool goodbye{};
};

/// One end of a socket that keeps messages apart (SOCK_SEQPACKET); closes it.
class Wire {
 public:
  explicit Wire(int descriptor) : descriptor_(descriptor) {}
  ~Wire() { close(descriptor_); }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  template <class Message>
  bool Send(const Message& message) noexcept {
    return send(descriptor_, &message, sizeof message, MSG_DONTWAIT | MSG_NOSIGNAL) ==
           ssize_t{sizeof message};
  }

  /// The newest message, and how many came; waits for the first one.
  template <class Message>
  std::uint64_t TakeNewest(Message& message, std::int64_t deadline_ns) noexcept {
    for (;;) {
      std::uint64_t taken = 0;
      for (Message next; Receive(next); ++taken) message = next;
      if (taken > 0) return taken;
      const std::int64_t left_ns = deadline_ns - levitas::rt::MonotonicNowNs();
      if (left_ns <= 0) return 0;
      // A closed socket is always ready: it is not asked any more, only the time passes.
      pollfd wait{closed_ ? -1 : descriptor_, POLLIN, 0};
      const timespec left{left_ns / 1'000'000'000, left_ns % 1'000'000'000};
      (void)ppoll(&wait, 1, &left, nullptr);
    }
  }

  [[nodiscard]] bool closed() const noexcept { return closed_; }

 private:
  template <class Message>
  bool Receive(Message& message) noexcept {
    const ssize_t size = recv(descriptor_, &message, sizeof message, MSG_DONTWAIT);
    if (size == 0) closed_ = true;
    return size == ssize_t{sizeof message};
  }

  int descriptor_;
  bool closed_{false};
};

class SocketPort final : public levitas::port::RigPort {
 public:
  explicit SocketPort(int descriptor) : wire_(descriptor) {}

  levitas::port::ReadResult Read(levitas::SensorFrame& frame,
                                 std::int64_t deadline_ns) noexcept override {
    const std::uint64_t taken = wire_.TakeNewest(frame, deadline_ns);
    if (wire_.closed() && when_gone) when_gone();
    counters_.frames_read += std::min<std::uint64_t>(taken, 1);
    counters_.frames_skipped += taken - std::min<std::uint64_t>(taken, 1);
    return taken > 0 ? levitas::port::ReadResult::kFrame : levitas::port::ReadResult::kNothing;
  }
  bool Write(const levitas::CurrentFrame& frame) noexcept override {
    const bool sent = wire_.Send(CurrentMessage{frame, false});
    ++(sent ? counters_.currents_written : counters_.write_failures);
    return sent;
  }
  void SayGoodbye(const levitas::CurrentFrame& last) noexcept override {
    (void)wire_.Send(CurrentMessage{last, true});
  }
  [[nodiscard]] levitas::port::PortCounters counters() const noexcept override { return counters_; }
  [[nodiscard]] bool gone() const noexcept { return wire_.closed(); }

  /// Called in the loop's thread, more than once; set before the loop runs.
  std::function<void()> when_gone;

 private:
  Wire wire_;
  levitas::port::PortCounters counters_;
};

class SocketLink final : public levitas::port::RigLink {
 public:
  explicit SocketLink(int descriptor) : wire_(descriptor) {}

  bool Send(const levitas::SensorFrame& frame) noexcept override {
    const bool sent = wire_.Send(frame);
    ++(sent ? counters_.frames_sent : counters_.send_failures);
    return sent;
  }
  ReceiveResult Receive(levitas::CurrentFrame& frame, std::int64_t deadline_ns) noexcept override {
    CurrentMessage message;
    const std::uint64_t taken = wire_.TakeNewest(message, deadline_ns);
    if (taken == 0 && !wire_.closed()) return ReceiveResult::kNothing;
    // A controller that has gone without a word: amplifiers off, as the empty frame says.
    frame = message.frame;
    if (taken == 0 || message.goodbye) return ReceiveResult::kGoodbye;
    ++counters_.currents_read;
    counters_.currents_skipped += taken - 1;
    return ReceiveResult::kCurrent;
  }
  [[nodiscard]] Counters counters() const noexcept override { return counters_; }

 private:
  Wire wire_;
  Counters counters_;
};
