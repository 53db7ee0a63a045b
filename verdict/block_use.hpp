#pragma once
// What the blocks of synchronous control did in a run, from the events of its session.
//
// Units    SI. Thread: any; pure. A block that acts when the record ends has acted until then.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "session/log/session_header.hpp"

namespace levitas::verdict {

struct BlockUse {
  std::string name;
  double acted_s{};
  int times{};           ///< it began
  std::string last_end;  ///< why, in words; empty: it still acted at the end
  double last_end_s{};   ///< since the start of the record
  std::string angle;     ///< how its angle was estimated; empty: it was measured
  int failures{};        ///< ends that were a warning: not of its speed
  std::string last_failure;
};

/// In the order of their first beginning, then those of `names` that never began. `last_cycle`: of
/// the record.
[[nodiscard]] std::vector<BlockUse> BlocksOf(std::span<const session::Event> events,
                                             std::uint64_t first_cycle, std::uint64_t last_cycle,
                                             double period_s,
                                             std::span<const std::string> names = {});

}  // namespace levitas::verdict
