#pragma once
// The sentences with which a session tells what a block of synchronous control does, written and
// read in one place: a session holds them as events, not as records.
//
// Thread   any; pure.

#include <optional>
#include <string>
#include <string_view>

#include "controller/synchronous/block_status.hpp"

namespace levitas::session {

/// `where`: "at 1500 rpm (cycle 4711)".
[[nodiscard]] std::string BlockBegins(std::string_view name, std::string_view where);
[[nodiscard]] std::string BlockEnds(std::string_view name, std::string_view where,
                                    synchronous::Ending why);

struct BlockEvent {
  std::string name;
  bool begins{};    ///< else it ends
  std::string why;  ///< it ends, in words; empty where it begins
};

/// Nothing of any other sentence.
[[nodiscard]] std::optional<BlockEvent> ReadBlockEvent(std::string_view text);

}  // namespace levitas::session
