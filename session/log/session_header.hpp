#pragma once
// What the first event of a session holds: everything needed to repeat the run.

#include <cstdint>
#include <string>
#include <vector>

#include "common/enums.hpp"
#include "session/log/block_events.hpp"

namespace levitas::session {

inline constexpr int kFormatVersion = 1;

struct SessionHeader {
  std::string program_version;
  std::string rig_yaml;         ///< complete text, defaults written out
  std::string controller_yaml;  ///< empty for imported data
  std::string scenario_yaml;    ///< may be empty
  std::string pace;             ///< "lockstep", "realtime" or "imported"
  std::int64_t seed{};
  std::int64_t period_ns{};
  std::int64_t start_utc_ns{};
  std::string machine;
  std::string source;  ///< "lcm", "can:can0", or the imported file's name
  std::vector<std::string> channels;
  SynchronousLabels synchronous{};  ///< words of the events; never written
  /// Empty for a whole session; in a trip file the path of the session it was cut out of, or
  /// "unrecorded run". Such a file starts in the middle of a run and cannot be replayed.
  std::string excerpt_of;
};

/// Something a person should know, as recorded and published.
struct Event {
  std::uint64_t cycle{};
  std::int64_t time_ns{};
  enum class Severity : std::uint8_t { kInformation = 0, kWarning = 1, kTrip = 2 } severity{};
  Mode mode{};
  Fault fault{};
  std::int8_t axis{-1};
  double value{};
  double limit{};
  std::string text;
};

}  // namespace levitas::session
