#pragma once
// Who sent a datagram, for the program and for people.
//
// Thread   any. Failure: none.

#include <cstdint>

namespace levitas::transport {

struct Speaker {
  std::uint64_t identity{};  ///< Received::identity: who it is
  std::uint64_t address{};   ///< Received::sender: where it was heard, for people

  friend bool operator==(const Speaker& one, const Speaker& other) noexcept {
    return one.identity == other.identity;
  }
};

}  // namespace levitas::transport
