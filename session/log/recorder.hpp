#pragma once
// Takes cycle records from the loop thread through a wait-free ring and, in its own thread, writes
// the session, derives events (mode changes, trips, refusals, lost frames), and freezes the 0.5 s
// before and after a trip to a session file of its own.
//
// Loop side   Post: wait-free, never allocates; full means lost and counted. With `waits_for_room`
//             (lockstep: no instant is missed by waiting) a full ring is waited for instead.
// Safety      written data reaches the kernel at least every 50 ms.
// Failure     a file that takes no more, or a pipe whose reader has stopped for `patience`, ends
//             the recording with one message (a loop that waits waits that long); of trip files it
//             ends the one that was being written, and the next trip is frozen again. An exception
//             elsewhere is noted (rt/thread_trouble.hpp). Records are taken on.
// Torsion     batches are written as they come, each before the first record of a later sampling
//             instant, so that a run in lockstep is the same file again. Not in trip files.
// Events      are also handed to `on_event` (recorder's thread), for telemetry and the console.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/torsion_batch.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"
#include "session/log/session_writer.hpp"
#include "session/log/trip_budget.hpp"

namespace levitas::session {

struct RecorderOptions {
  std::string session_path;  ///< empty: nothing is recorded (trips still freeze)
  std::string trip_folder;   ///< where trip files go
  SessionHeader header;
  TripBudget trip_budget;                         ///< of this run's trip files
  double trip_window_s{0.5};                      ///< before and after
  std::chrono::milliseconds patience{kPatience};  ///< with a reader of a pipe that stops
  bool waits_for_room{false};  ///< Post waits instead of losing; never in real time
  std::function<void(const Event&)> on_event;
  std::function<void(const cycle::CycleRecord&)> on_record;  ///< every record, recorder's thread
};

class Recorder {
 public:
  explicit Recorder(RecorderOptions options);
  /// Finish.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Loop thread only.
  void Post(const cycle::CycleRecord& record) noexcept;
  /// Loop thread only; before the record of the frame that it came before. Full as Post.
  void PostTorsion(const TorsionBatch& batch) noexcept;
  /// Drains the ring, completes an unfinished trip file, tells the last events and joins. Nothing
  /// may be posted any more; called again it does nothing.
  void Finish() noexcept;
  [[nodiscard]] std::uint64_t lost() const noexcept;
  /// Path of the newest complete trip file, empty if none. Any thread.
  [[nodiscard]] std::string trip_file() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session
