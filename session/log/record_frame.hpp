#pragma once
// Recorded readings and commands in the bearing frame, and back onto the wires: the place at which
// readers and writers of records meet the polarity of a rig.
//
// Units    SI. Entries beyond the rig's axes are 0.
// Thread   any; pure.
// Failure  the constructor throws std::invalid_argument unless every polarity is +1 or -1.
// Not done coil currents: measured magnitudes of named coils have no polarity.

#include "common/probe_map.hpp"
#include "controller/cycle/cycle_io.hpp"

namespace levitas::session {

/// Positions and commanded control currents of one sample.
struct AxisSample {
  AxisArray position_m{};
  AxisArray current_a{};
};

class RecordFrame {
 public:
  explicit RecordFrame(const RigNumbers& rig) : map_(rig) {}

  /// A sample as it is on the wire or in a file, in the bearing frame.
  [[nodiscard]] AxisSample Bearing(const AxisSample& wired) const noexcept {
    return {map_.Positions({wired.position_m}).at, map_.CommandedCurrents({wired.current_a}).at};
  }
  [[nodiscard]] AxisSample Bearing(const cycle::CycleRecord& record) const noexcept {
    return Bearing({record.in.frame.position_m, record.out.current.control_current_a});
  }
  /// A sample of the bearing frame as it is on the wire or in a file.
  [[nodiscard]] AxisSample Wired(const AxisSample& bearing) const noexcept {
    return {map_.Readings({bearing.position_m}).at, map_.Currents({bearing.current_a}).at};
  }

 private:
  ProbeMap map_;
};

}  // namespace levitas::session
