#pragma once
// The sentences with which a session tells what a block of synchronous control does, written and
// read in one place: a session holds them as events, not as records.
//
// Thread   any; pure.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controller/synchronous/block_status.hpp"
#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::session {

struct SynchronousLabels {
  std::vector<std::string> blocks;  ///< their names, in the order of the controller file
  synchronous::AngleSource angle_from{synchronous::AngleSource::kRig};
};

/// `where`: "at 1500 rpm (cycle 4711)". An angle that is no measured one is said to be none.
[[nodiscard]] std::string BlockBegins(
    std::string_view name, std::string_view where,
    synchronous::AngleSource angle_from = synchronous::AngleSource::kRig);
[[nodiscard]] std::string BlockEnds(std::string_view name, std::string_view where,
                                    synchronous::Ending why);

struct BlockEvent {
  std::string name;
  bool begins{};    ///< else it ends
  std::string why;  ///< it ends, in words; where it begins, how its angle is estimated, if it is
};

/// Nothing of any other sentence.
[[nodiscard]] std::optional<BlockEvent> ReadBlockEvent(std::string_view text);

}  // namespace levitas::session
