#pragma once
// How many trip files a run leaves in a folder: the newest ones, within a number of files and of
// bytes. A machine that trips again and again does not fill its disk.
//
// Ours      only what this run has written itself is counted and removed, and only while it is
//           still a regular file. Trip files of earlier runs are the user's: they stay, and
//           OlderTripFiles says how many there are.
// Thread    any, one at a time on a folder. Failure: none; what cannot be removed stays.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace levitas::session {

struct TripBudget {
  std::size_t files{20};
  std::uintmax_t bytes{std::uintmax_t{100} << 20};
};

/// Removes the oldest of `written` (names in `folder` of this run's trip files, oldest first) until
/// `budget` holds, and returns their names, newest first; they leave `written`, as do those that
/// others have removed. The newest stays whatever its size.
std::vector<std::string> KeepWithin(const TripBudget& budget, const std::string& folder,
                                    std::vector<std::string>& written);

/// Trip files in `folder` but for `written`.
struct OlderTrips {
  std::size_t files{};
  std::uintmax_t bytes{};
};
[[nodiscard]] OlderTrips OlderTripFiles(const std::string& folder,
                                        const std::vector<std::string>& written);

/// trip-20261121T054501.123Z-orbit_exceeded.lcmlog, or with -2 before the dot.
[[nodiscard]] bool IsTripFileName(const std::string& name);

}  // namespace levitas::session
