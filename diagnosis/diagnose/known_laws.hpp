#pragma once
// The control laws with which records were made, as far as they are known.
// Units    rad/s. Thread: any; plain data. Failure: none.

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "controller/law/law_config.hpp"

namespace levitas::diagnosis {

/// A law, and the records that were made with it.
struct LawOfRecords {
  std::string name;  ///< and where it is from
  law::LawConfig law;
  std::vector<std::string> records;  ///< paths
  /// Of the rotor in them; at rest until one is added.
  double slowest_rad_per_s{std::numeric_limits<double>::infinity()}, fastest_rad_per_s{};

  void Add(double speed_rad_per_s) noexcept {
    slowest_rad_per_s = std::min(slowest_rad_per_s, speed_rad_per_s);
    fastest_rad_per_s = std::max(fastest_rad_per_s, speed_rad_per_s);
  }
};

struct KnownLaws {
  std::vector<LawOfRecords> laws;
  std::vector<std::string> without;  ///< records of which no law is known
};

}  // namespace levitas::diagnosis
