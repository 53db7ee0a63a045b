#pragma once
// Replay: the recorded inputs through a control cycle rebuilt from the session's own texts; every
// output bit must come out as recorded.
//
// Scope    from the first cycle of the run to its end, or to the first gap: behind a gap the law's
//          memory would be that of other inputs. A file that starts in the middle of a run (a trip
//          file, or a session whose beginning is damaged) is refused: nobody knows the memory then.
// Failure  BadInput for sessions that cannot be replayed, with the reason and what to do.
// Thread   any; one thread per replay.

#include <cstdint>
#include <optional>
#include <string>

#include "controller/cycle/control_cycle.hpp"
#include "session/log/session_reader.hpp"
#include "session/replay/output_difference.hpp"

namespace levitas::session {

/// Every run counts its cycles from here.
inline constexpr std::uint64_t kFirstCycle = 0;

struct ReplayReport {
  std::uint64_t reproduced{};  ///< cycles whose every output bit was the recorded one
  std::uint64_t different_cycle{};
  std::optional<OutputDifference> difference;  ///< in different_cycle; the replay stopped there
  std::optional<std::uint64_t> gap_cycle;      ///< first cycle missing in the file
  std::uint64_t behind_gap{};                  ///< records that could therefore not be judged
  [[nodiscard]] bool identical() const noexcept { return !difference && !gap_cycle; }
};

/// The control cycle the session was recorded with.
[[nodiscard]] cycle::CycleConfig RecordedConfig(const SessionHeader& header,
                                                const std::string& session_path);
/// The session's rig with the controller file `controller_path`.
[[nodiscard]] cycle::CycleConfig OtherConfig(const SessionHeader& header,
                                             const std::string& session_path,
                                             const std::string& controller_path);

/// Throws when the file starts in the middle of a run.
void RefuseUnlessWhole(const SessionHeader& header, const cycle::CycleRecord& first_record,
                       const std::string& session_path);

/// Reads `reader` to its end.
[[nodiscard]] ReplayReport Replay(SessionReader& reader, const cycle::CycleConfig& config,
                                  const std::string& session_path);

}  // namespace levitas::session
