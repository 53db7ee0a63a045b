#pragma once
// What the catalogue knows of one session file.
//
// Outcome   "accepted", "not_accepted", "tripped", "incomplete" of a run; "not_judged" of imported
//           measurements and trip files, which have no scenario to complete.
// Units     SI; times as ns since 1970 UTC.

#include <cstdint>
#include <string>
#include <vector>

namespace levitas::session_index {

inline constexpr const char* kNotJudged = "not_judged";

struct Entry {
  std::string path;  ///< absolute, as the file was when it was entered
  std::uint64_t size_byte{};
  std::int64_t start_utc_ns{};
  double duration_s{};
  std::uint64_t cycles{};
  std::string rig, controller, scenario;  ///< names; empty where the session has none
  std::string pace;                       ///< "lockstep", "realtime", "imported"
  std::string port;                       ///< "lcm", "can:can0", or the imported file's name
  std::string program_version;
  std::string outcome;
  std::string sentence;  ///< of the verdict, or why there is none
  std::string damage;    ///< empty when nothing of the file was lost
  double top_speed_rad_per_s{};
  std::vector<std::string> tags;  ///< sorted
};

}  // namespace levitas::session_index
