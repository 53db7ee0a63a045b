#pragma once
// Writes a session: one LCM event log, header first, then one LEVITAS_CYCLE event per cycle and
// LEVITAS_EVENT events as they happen; LEVITAS_TORSION where the rig measures it. Readable by
// ordinary LCM tools.
//
// Packed     under a name that ends in .zst, by zstd; `zstd -d` gives the log (packed_log.hpp).
// Integrity  every record carries its cycle number and a CRC-32.
// Thread     one thread, not the loop's (see Recorder). Write reuses its buffers.
// File       made new under its name from the first byte on, never through a symbolic link
//            (common/output_file.hpp): a session that grows can be read.
// Pipe       of a reader that stops reading: waited for, no longer than the patience at once.
// Failure    BadInput when the file cannot be created or is a pipe that nobody reads; a full disk,
//            and a reader beyond the patience, throw WriteFailed.

#include <chrono>
#include <memory>
#include <string>

#include "common/output_file.hpp"
#include "common/problem.hpp"
#include "common/torsion_batch.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"

namespace levitas::session {

/// With a reader that takes nothing: below the 30 s after which a rig gives its controller up.
inline constexpr std::chrono::milliseconds kPatience{5000};

class WriteFailed : public Problem {
 public:
  WriteFailed(const std::string& path, int error);
  /// As errno has it.
  [[nodiscard]] int error() const noexcept { return error_; }

 private:
  int error_;
};

class SessionWriter {
 public:
  /// What stands under the name is replaced, unless it is to be kept: then it is refused.
  SessionWriter(const std::string& path, const SessionHeader& header,
                Standing standing = Standing::kReplaced,
                std::chrono::milliseconds patience = kPatience);
  /// Into a file that appears when it is whole; `file` commits it.
  SessionWriter(const PartFile& file, const SessionHeader& header);
  ~SessionWriter();
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;

  void Write(const cycle::CycleRecord& record);
  void Write(const Event& event);
  void Write(const TorsionBatch& batch);
  /// Hands everything written so far to the kernel: it then survives a kill -9 of this process.
  void Flush();
  /// Writes the last copy of the header; nothing follows. The destructor does it too, but silently.
  void Close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session
