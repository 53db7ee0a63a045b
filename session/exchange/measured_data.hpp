#pragma once
// Measured data of others as cycle records: rows of a CSV or MAT file (docs/formats.md), one record
// per sample, handed to a callback. The session writer and the loader of recordings take them.
//
// Duty      of two opposed coils on a voltage becomes what was commanded: control current half the
//           difference, bias half the sum, in amperes that full duty would drive at last. The gap
//           of the coil towards + becomes the position, gap at the centre minus gap.
// Time      each row is one sample; steps in time_s are whole periods of the rig (within a
//           quarter); a longer step is a recorded drop-out, whose cycles have no record. A step
//           beyond kLongestGapS is refused, and so is a file most of whose steps are longer than
//           a period: it was sampled at another rate.
// Speed     from speed_rpm, else from the slope of rotor_angle_rad over 20 rows, else 0.
// Angle     from rotor_angle_rad (any number of turns), else integrated from speed_rpm.
// Mode      the file does not know it: levitating, or spinning when the rotor turns.
// Frames    as in the file: the polarity of probes and coils is not undone here.
// Memory    one row at a time.
// Thread    any; the callback runs in the caller's thread.
// Failure   BadInput with line and column; records handed over until then are void.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/exchange/csv_rows.hpp"
#include "session/exchange/plausible_values.hpp"

namespace levitas::session {

inline constexpr double kLongestGapS = 60.0;

/// Receives the records of a file in the order of their cycles.
using RecordTaker = std::function<void(const cycle::CycleRecord&)>;

/// Turns a gap and a duty into a position and a command.
struct CoilScale {
  double gap_m{};           ///< of the coil towards +, the rotor centred
  double full_current_a{};  ///< that full duty drives at last
};

/// The rig that the data are of.
struct MeasuredData {
  const RigNumbers& rig;
  const std::vector<CoilScale>& coils;  ///< per axis; needed for columns of gap and duty
};

struct ImportReport {
  std::uint64_t rows{};
  std::uint64_t drop_outs{};       ///< gaps in time
  std::uint64_t missing_cycles{};  ///< periods in them
  double duration_s{};
  bool has_rotation{};
  bool has_excitation{};
  bool has_coil_currents{};
  std::vector<std::string> ignored_columns;
  std::vector<ImplausibleColumn> implausible;  ///< numbers that this rig cannot have
};

/// Reads `rows` to their end.
ImportReport ReadRecords(RowSource& rows, const MeasuredData& data, const RecordTaker& take);

}  // namespace levitas::session
