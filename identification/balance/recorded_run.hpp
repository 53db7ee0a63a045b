#pragma once
// A recorded run-up as balancing uses it: order-tracked windows, and what was on the rotor.
//
// Angle      that of a session or of a bus is measured; a CSV or MAT file must have the column. One
//            that was imported into a session without it cannot be told any more.
// Thread     any; allocates.
// Failure    BadInput, one sentence that names the file: no rotation, no measured angle, fewer than
//            eight windows, speeds that stay below a fifth of the rig's rated speed.

#include <complex>
#include <string>
#include <vector>

#include "analysis/records/order_track.hpp"
#include "configuration/rig_file.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::balancing {

/// What had been put on the rotor before a run, by the name of its plane.
struct AppliedWeight {
  std::string plane;
  std::complex<double> added_kg_m;
};

struct RecordedRun {
  std::string name;
  std::vector<analysis::TrackedWindow> windows;
  double bias_current_a{};
  std::vector<AppliedWeight> applied;  ///< since the first run
};

/// Throws BadInput when the record cannot be balanced by.
[[nodiscard]] RecordedRun ReadRun(const session::Recording& recording,
                                  const configuration::RigFile& rig);
/// Of a session, CSV, MAT or candump file.
[[nodiscard]] RecordedRun LoadRun(const std::string& path, const configuration::RigFile& rig);

}  // namespace levitas::balancing
