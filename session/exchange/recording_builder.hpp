#pragma once
// Takes cycle records one by one into the columns of a recording (recording.hpp), so that whoever
// reads a session for something else has its columns from the same pass.
//
// Frame    bearing frame: the polarity of probes and coils is undone here.
// Memory   that of a Recording; columns grow by doubling until Finish() gives the spare room back.
// Thread   one; offline, allocates.
// Failure  std::invalid_argument for a rig whose polarity is neither +1 nor -1.

#include <string>
#include <utility>

#include "common/rig_numbers.hpp"
#include "controller/cycle/cycle_io.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/record_frame.hpp"

namespace levitas::session {

class RecordingBuilder {
 public:
  /// `name` is the recording's, for messages.
  RecordingBuilder(const std::string& name, const RigNumbers& rig);

  /// The next row, in the order of the run.
  void Take(const cycle::CycleRecord& record);
  void SetDamage(std::string text) { recording_.damage = std::move(text); }

  /// Gives the recording away, without spare room; nothing may be taken afterwards.
  [[nodiscard]] Recording Finish();

 private:
  void TakeCoils(const cycle::CycleInputs& in);

  RecordFrame frame_;
  std::size_t axes_;
  Recording recording_;
};

}  // namespace levitas::session
