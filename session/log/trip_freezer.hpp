#pragma once
// Keeps the newest records and, when a trip comes, writes those before and after it to a session
// file of its own: trip-<utc>-<cause>.lcmlog.
//
// Window   `window_s` before the trip, and after it; a trip within the window of another one ends
//          the first file early.
// Safety   the file is readable from its first moment on; Finish (or kill -9) leaves what was
//          there.
// Thread   one thread (the recorder's). Memory for the window is made at construction.
// Budget   older trip files of this run make room for a new one, see trip_budget.hpp; those of
//          earlier runs stay.
// Failure  BadInput or Problem when the file cannot be written; Abandon then makes it ready for the
//          next trip, of which no record is missing.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"
#include "session/log/session_writer.hpp"
#include "session/log/trip_budget.hpp"

namespace levitas::session {

class TripFreezer {
 public:
  TripFreezer(std::string folder, SessionHeader header, double window_s, TripBudget budget = {});

  /// The record, and the events that were derived from it.
  void Take(const cycle::CycleRecord& record, const std::vector<Event>& events);
  /// Closes an unfinished file.
  void Finish();
  void Flush();
  /// Gives an unfinished file up as it is.
  void Abandon();
  /// Names of the files that had to make room since the last call.
  [[nodiscard]] std::vector<std::string> TakeRemoved() { return std::exchange(removed_, {}); }
  /// Trip files of earlier runs in the folder, found when the first file was opened and reported
  /// once; 0 files afterwards.
  [[nodiscard]] OlderTrips TakeOlder() { return std::exchange(older_, {}); }
  /// Path of the newest closed file, empty if none.
  [[nodiscard]] const std::string& newest() const noexcept { return newest_; }

 private:
  void MakeRoom();
  void Open(const cycle::CycleRecord& record);
  void Write(const cycle::CycleRecord& record, const std::vector<Event>& events);

  std::string folder_;
  SessionHeader header_;
  std::uint64_t window_cycles_;
  std::vector<cycle::CycleRecord> before_;  ///< ring
  std::size_t next_{0};
  std::size_t filled_{0};
  bool first_known_{false};
  std::uint64_t first_cycle_{0};
  std::unique_ptr<SessionWriter> file_;
  std::string path_;
  std::string newest_;
  TripBudget budget_;
  std::vector<std::string> written_;  ///< names of this run's files, oldest first
  std::vector<std::string> removed_;
  OlderTrips older_;
  bool looked_{false};           ///< for those of earlier runs
  std::uint64_t last_cycle_{0};  ///< of the open file
};

/// trip-20261121T054501.123Z-orbit_exceeded.lcmlog
[[nodiscard]] std::string TripFileName(std::int64_t utc_ns, Fault fault);

}  // namespace levitas::session
