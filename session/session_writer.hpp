#pragma once
// Writes a session: one LCM event log, header first, then one LEVITAS_CYCLE event per cycle and
// LEVITAS_EVENT events as they happen. Readable by ordinary LCM tools.
//
// Integrity  every record carries its cycle number and a CRC-32.
// Thread     one thread, not the loop's (see Recorder). Write reuses its buffers.
// Failure    BadInput when the file cannot be created; a full disk throws WriteFailed.

#include <memory>
#include <string>

#include "common/problem.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/session_header.hpp"

namespace levitas::session {

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
  SessionWriter(const std::string& path, const SessionHeader& header);
  ~SessionWriter();
  SessionWriter(const SessionWriter&) = delete;
  SessionWriter& operator=(const SessionWriter&) = delete;

  void Write(const cycle::CycleRecord& record);
  void Write(const Event& event);
  /// Hands everything written so far to the kernel: it then survives a kill -9 of this process.
  void Flush();
  /// Writes the last copy of the header; nothing follows. The destructor does it too, but silently.
  void Close();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session
