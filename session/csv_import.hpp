#pragma once
// Measured data of others: a CSV or MAT file of the contract in docs/formats.md becomes a session.
//
// Duty      of two opposed coils on a voltage becomes what was commanded: control current half the
//           difference, bias half the sum, in amperes that full duty would drive at last. The gap
//           of the coil towards + becomes the position, gap at the centre minus gap.
// Time      each row is one sample; steps in time_s are whole periods of the rig (within a
//           quarter); a longer step is a recorded drop-out and leaves its cycles out of the
//           session.
// Speed     from speed_rpm, else from the slope of rotor_angle_rad over 20 rows, else 0.
// Angle     from rotor_angle_rad (any number of turns), else integrated from speed_rpm.
// Mode      the file does not know it: levitating, or spinning when the rotor turns.
// Failure   BadInput with line and column; then no output file is left behind.

#include <cstdint>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"

namespace levitas::session {

/// What turns a gap and a duty into a position and a command.
struct CoilScale {
  double gap_m{};           ///< of the coil towards +, the rotor centred
  double full_current_a{};  ///< that full duty drives at last
};

struct ImportOptions {
  std::string data_path;  ///< .csv, compressed .csv.xz, or .mat
  std::string out_path;
  RigNumbers rig;
  std::string rig_yaml;  ///< complete text, goes into the header
  std::string program_version;
  std::int64_t start_utc_ns{};
  std::vector<CoilScale> coils{};          ///< per axis; needed for columns of gap and duty
  std::string matrix{};                    ///< of a MAT file without vectors of our names
  std::vector<std::string> matrix_rows{};  ///< names of its rows
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
};

ImportReport ImportCsv(const ImportOptions& options);
/// The same from a MAT file; see mat_rows.hpp.
ImportReport ImportMat(const ImportOptions& options);

}  // namespace levitas::session
