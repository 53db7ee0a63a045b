#pragma once
// A recorded run as columns in memory, and the one loader of every format.
//
// Formats    by the ending of the name: .csv, .csv.xz and .mat (docs/formats.md), .log and .log.xz
//            (candump of the rig's CAN buses, unless it begins as a session does); every other
//            name must be a session. No file is written on the way.
// Frame      bearing frame: the polarity of probes and coils is undone here (record_frame.hpp).
//            Coil currents are measured magnitudes of named coils and have no polarity.
// Units      SI. Commanded currents are the total of a row's sample, excitation included.
// Limits     of the rig file: a position at the sensor's range is clipped, a control current at its
//            limit is saturated. The limit is what bias and largest coil current leave to both
//            sides.
// Rows       one per cycle of the record, in its order. `cycle` is the count of the sensor frame:
//            it repeats while no frame arrives and leaves out the drop-outs of a log.
// Levitated  the amplifiers are on, the mode is levitating, spinning or coast-down, the frame
//            arrived and its positions are numbers. CSV and MAT records are levitated wherever
//            the positions are numbers: such files do not say when the rotor was lifted or landed.
// Memory     42 bytes a row and 16 per axis (106 bytes with four axes: 1.1 MB a second at 10 kHz,
//            so 300 s take 318 MB); 8 more per excited axis and measured coil. While
//            a file is read, up to twice as much, and of a MAT file its own columns too.
// Thread     any; LoadRecording keeps no state between calls.
// Failure    BadInput naming the file: unreadable, other period or channels than the rig.
//            std::invalid_argument for a rig whose polarity is neither +1 nor -1.
// Not done   events of a session are not kept: session_reader.hpp has them.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "common/rig_numbers.hpp"
#include "configuration/rig_file.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"

namespace levitas::session {

using Column = std::vector<double>;

/// Rows `begin` to `end` (not included).
struct RowRange {
  std::size_t begin{};
  std::size_t end{};
  [[nodiscard]] bool operator==(const RowRange&) const = default;
};

struct Recording {
  std::string name;    ///< path, for messages
  std::string damage;  ///< of a session that was not read whole, in words; empty: none
  std::int64_t period_ns{};
  std::vector<std::string> channels;
  Column sensor_range_m;     ///< per axis
  double current_limit_a{};  ///< of the control current, to both sides
  Column time_s;             ///< of the sensor frames, as the record has it
  std::vector<std::uint64_t> cycle;
  std::vector<std::uint8_t> levitated;
  std::vector<std::uint8_t> amplifiers_enabled;
  Column speed_rad_per_s;
  Column angle_rad;
  Column bias_current_a;
  std::vector<Column> position_m;      ///< per axis; NaN where the sensor gave no number
  std::vector<Column> current_a;       ///< per axis: commanded control current
  std::vector<Column> excitation_a;    ///< per axis: part of the command; empty: never excited
  std::vector<Column> excitation_m;    ///< per axis: added to the reading; empty: never excited
  std::vector<Column> coil_current_a;  ///< towards + and away, axis by axis; none: not measured

  [[nodiscard]] std::size_t rows() const noexcept { return cycle.size(); }
  [[nodiscard]] std::size_t axes() const noexcept { return channels.size(); }
  [[nodiscard]] double period_s() const noexcept { return static_cast<double>(period_ns) * 1e-9; }
  [[nodiscard]] double ExcitationOf(std::size_t axis, std::size_t row) const noexcept {
    return excitation_a[axis].empty() ? 0.0 : excitation_a[axis][row];
  }
  [[nodiscard]] double PositionExcitationOf(std::size_t axis, std::size_t row) const noexcept {
    return excitation_m[axis].empty() ? 0.0 : excitation_m[axis][row];
  }
  /// Whether `row` is the sample right after the row before it; the first row follows nothing.
  [[nodiscard]] bool Follows(std::size_t row) const noexcept {
    return row > 0 && cycle[row] == cycle[row - 1] + 1;
  }
  /// Rows that do not follow the row before them (the first row is none of these).
  [[nodiscard]] std::vector<std::size_t> Gaps() const;
  /// Longest ranges of levitated rows that follow each other.
  [[nodiscard]] std::vector<RowRange> LevitatedIntervals() const;
};

/// Whether the name of a record is that of a session, which holds the rig that it is of.
[[nodiscard]] bool IsSession(const std::string& path);

[[nodiscard]] Recording LoadRecording(const std::string& path, const configuration::RigFile& rig);

/// Whether the positions of a record are those of a levitated rotor; see the head of this file.
[[nodiscard]] bool IsLevitated(const cycle::CycleRecord& record, std::size_t axes) noexcept;

/// Throws BadInput when the session was sampled at another period or has other channels than the
/// rig: a model would answer a question that was not asked.
void RefuseOtherRig(const SessionHeader& header, const RigNumbers& rig);

}  // namespace levitas::session
