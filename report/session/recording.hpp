#pragma once
// A recorded session in memory, as its pictures need it.
//
// Frame    bearing frame: as session/log/record_frame.hpp gives it.
// Units    SI; single precision (7 digits: 0.1 nm of 1 mm). About 50 bytes a cycle with four axes,
//          66 with test signals.
//          Left out cycles without a new sensor frame; a gap in `cycle` remains.
// Thread   any; offline. Failure: BadInput when the session or its header cannot be read.

#include <cstdint>
#include <string>
#include <vector>

#include "common/enums.hpp"
#include "common/rig_numbers.hpp"
#include "session/log/session_header.hpp"
#include "session/log/torsion_recording.hpp"

namespace levitas::report {

struct Recording {
  session::SessionHeader header;
  RigNumbers rig;
  double standstill_rad_per_s{};  ///< of the controller; slower counts as standing
  std::vector<std::uint64_t> cycle;
  std::vector<std::vector<float>> position_m;  ///< x, y per bearing; a guided y is 0
  std::vector<std::vector<float>> current_a;   ///< as that: commanded, excitation included
  /// Test signals per channel of the rig, of the kind that the run has first: at the current [A] or
  /// at the reading [m]. Empty without any.
  std::vector<std::vector<float>> excitation;
  bool excitation_at_reading{};
  std::vector<float> speed_rad_per_s;
  std::vector<float> angle_rad;
  std::vector<std::int64_t> sample_time_ns;
  std::vector<bool> levitated;            ///< imported records throughout
  session::TorsionRecording torsion;      ///< no couplings where none is measured
  std::vector<std::int64_t> torsion_row;  ///< in `torsion`, of each cycle; -1: lost. Empty without
  std::vector<session::Event> events;
  std::string damage;  ///< empty when nothing was lost
  std::uint64_t records{};
  std::uint64_t without_frame{};
  std::uint64_t missed_deadlines{};
  double top_speed_rad_per_s{};
  std::vector<double> shaft_ratio;  ///< speed of each bearing's shaft over that of the first, with
                                    ///< its sign; empty: all bearings carry one rotor

  [[nodiscard]] double RatioOf(std::size_t bearing) const {
    return bearing < shaft_ratio.size() ? shaft_ratio[bearing] : 1.0;
  }
  [[nodiscard]] std::size_t size() const noexcept { return cycle.size(); }
  [[nodiscard]] double TimeOf(std::size_t i) const {
    return static_cast<double>(cycle[i] - cycle.front()) * rig.period_s();
  }
  /// Whether no cycle is missing from `first` to `last`, both included.
  [[nodiscard]] bool Uninterrupted(std::size_t first, std::size_t last) const {
    return cycle[last] - cycle[first] == last - first;
  }
  /// Distance from the centre of the clearance at a bearing.
  [[nodiscard]] double Radius(std::size_t bearing, std::size_t i) const;
};

[[nodiscard]] Recording Load(const std::string& path);

}  // namespace levitas::report
