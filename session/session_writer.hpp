#pragma once
// Writes a session: one LCM event log, header first, then one LEVITAS_CYCLE event per cycle and
// LEVITAS_EVENT events as they happen. Readable by ordinary LCM tools.
//
// Integrity  every record carries its cycle number and a CRC-32.
// Thread     one thread, not the loop's (see Recorder). Write reuses its buffers.
// Failure    BadInput when the file cannot be created; a full disk throws Problem.

#include <memory>
#include <string>

#include "controller/cycle/cycle_io.hpp"
#include "session/session_header.hpp"

namespace levitas::session {

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

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session
