#pragma once
// Where commands of the network wait for the command arbiter. Several threads write, one at a time;
// the loop reads and never waits for them.
//
// Thread   Post: any but the loop's; it locks for the length of a copy. ring: for the arbiter.
// Failure  Post returns false when kRoom commands wait already: a person gives them one by one.

#include <cstddef>
#include <mutex>

#include "common/spsc_ring.hpp"
#include "controller/loop/command_arbiter.hpp"

namespace levitas::controller_program {

class CommandInbox {
 public:
  static constexpr std::size_t kRoom = 16;

  bool Post(const loop::RemoteCommand& command) {
    const std::lock_guard lock(mutex_);
    return ring_.Post(command);
  }
  [[nodiscard]] SpscRing<loop::RemoteCommand>& ring() noexcept { return ring_; }

 private:
  std::mutex mutex_;
  SpscRing<loop::RemoteCommand> ring_{kRoom};
};

}  // namespace levitas::controller_program
