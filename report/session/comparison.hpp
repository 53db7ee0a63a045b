#pragma once
// Recorded runs side by side: synchronous amplitudes and orbits of each at the same speeds.
//
// Frame    bearing frame; units SI. What is measured: analysis/synchronous.hpp.
// Speeds   those asked for, else every speed that one of the records holds.
// Orbit    the last two turns of the rows that the amplitudes are of, or 0.1 s standing; at most
//          600 points.
// Thread   any; offline.
// Failure  BadInput when a record has other channels than the first, or none holds any speed.

#include <optional>
#include <string>
#include <vector>

#include "analysis/synchronous.hpp"
#include "configuration/rig_file.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::report {

/// A record with what it is of.
struct RecordToCompare {
  std::string label;  ///< short, of its own among the records
  std::string path;
  configuration::RigFile rig;
  std::string controller;  ///< name; empty: the record says none
  double standstill_rad_per_s{1.0};
  session::Recording recording;
};

struct Orbit {
  std::vector<double> x_m, y_m;
};

/// A record at one of the speeds.
struct AtSpeed {
  analysis::SynchronousRows found;
  std::vector<Orbit> orbits;  ///< per bearing
  double from_s{};            ///< of the rows, from the record's first on
  double duration_s{};
};

struct ComparedRecord {
  std::string label, path, rig, controller, damage;
  std::vector<std::optional<AtSpeed>> speeds;         ///< as Comparison::speeds_rad_per_s
  std::vector<analysis::SynchronousRows> over_speed;  ///< empty unless asked for
};

struct Comparison {
  std::vector<std::string> channels, bearings;
  std::vector<double> orders;
  std::vector<double> speeds_rad_per_s;
  std::vector<double> clearance_m;  ///< per bearing, of the first record's rig
  std::vector<ComparedRecord> records;

  [[nodiscard]] std::size_t AxesPerBearing() const { return channels.size() / bearings.size(); }
};

struct ComparisonRequest {
  std::vector<double> orders{1.0};
  std::vector<double> speeds_rad_per_s;  ///< empty: those that the records hold
  bool over_speed{};
};

[[nodiscard]] Comparison Compare(const std::vector<RecordToCompare>& records,
                                 const ComparisonRequest& request);

}  // namespace levitas::report
