#pragma once
// How many trip files a folder holds: the newest ones, within a number of files and of bytes. A
// machine that trips again and again does not fill its disk.
//
// Ours      only a regular file whose whole name is that of a trip file (time, a fault's name, a
//           number perhaps) is ever removed; its age is the time in its name.
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

/// Removes the oldest trip files until `budget` holds, and returns their names. `newest` stays
/// whatever its size.
std::vector<std::string> KeepWithin(const TripBudget& budget, const std::string& folder,
                                    const std::string& newest);

/// trip-20261121T054501.123Z-orbit_exceeded.lcmlog, or with -2 before the dot.
[[nodiscard]] bool IsTripFileName(const std::string& name);

}  // namespace levitas::session
