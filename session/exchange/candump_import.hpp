#pragma once
// A log of candump (-l, -L) of the buses of a rig as cycle records, or as a session.
//
// Lines     (seconds) interface identifier#data, with CAN FD identifier##flags data. Messages of
//           the rig's layout are taken from whatever interface; other lines are counted and left
//           out.
// Records   one for each position frame, with the current frame that answers it; without an answer
//           the last current is held, as the amplifiers did.
// Time      the rig's count of periods, as a bus shows it; the log's own times only order the
//           lines.
// Mode      the bus does not carry it: off while the amplifiers are off, else levitating, or
//           spinning when the rotor turns.
// Failure   BadInput with the line; then no output file is left behind.

#include <cstdint>
#include <string>

#include "hil/can/layout.hpp"
#include "hil/can/wire_frame.hpp"
#include "session/exchange/csv_import.hpp"

namespace levitas::session {

struct CandumpReport {
  std::uint64_t records{};
  std::uint64_t lines{};
  std::uint64_t other_lines{};     ///< not of the layout: other identifiers, error frames
  std::uint64_t damaged{};         ///< checksum or length wrong
  std::uint64_t out_of_order{};    ///< copies and older frames
  std::uint64_t missing_cycles{};  ///< of the rig, of which there is no position frame
  std::uint64_t without_answer{};  ///< position frames without their currents
  std::uint64_t rig_restarts{};
  double duration_s{};
};

/// Hands the records of a log to `take`, one at a time.
CandumpReport ReadCandump(const std::string& path, const can::Layout& layout,
                          const RecordTaker& take);

/// The same into a session.
CandumpReport ImportCandump(const ImportOptions& options, const can::Layout& layout);

/// One line of a log as a frame; false for a line that is none (error frame, remote frame,
/// comment). Throws std::invalid_argument for a line that is no line of candump.
[[nodiscard]] bool ParseCandumpLine(const std::string& line, can::WireFrame& frame);

}  // namespace levitas::session
