#pragma once
// Reads a session, plain or packed, whole or damaged: resynchronises after damage, says what was
// lost, loses nothing before it.
//
// Failure  BadInput when the file cannot be opened or holds no readable header.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/torsion_batch.hpp"

#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"

namespace levitas::session {

struct Damage {
  std::uint64_t corrupt_bytes{};     ///< skipped while searching for the next event
  std::uint64_t corrupt_records{};   ///< wrong CRC or undecodable
  std::uint64_t missing_cycles{};    ///< gaps in the cycle count
  bool truncated{};                  ///< the file ends inside an event, or inside a packed block
  bool packed{};                     ///< by zstd; offsets are of the unpacked log
  std::uint64_t corrupt_blocks{};    ///< of a packed file: frames that were left behind
  std::uint64_t first_bad_offset{};  ///< byte offset of the first damage
  [[nodiscard]] bool any() const noexcept {
    return corrupt_bytes > 0 || corrupt_records > 0 || corrupt_blocks > 0 || missing_cycles > 0 ||
           truncated;
  }
  /// One sentence for people; empty when undamaged.
  [[nodiscard]] std::string Text() const;
};

class SessionReader {
 public:
  explicit SessionReader(const std::string& path);
  ~SessionReader();
  SessionReader(SessionReader&&) noexcept;

  [[nodiscard]] const SessionHeader& header() const noexcept;
  [[nodiscard]] const std::string& path() const noexcept;
  /// False at the end. `record` is untouched then.
  [[nodiscard]] bool Next(cycle::CycleRecord& record);
  /// From now on measured torsion is kept (4 kB a batch), not only checked.
  void KeepTorsion() noexcept;
  /// Kept so far, in the order of the file.
  [[nodiscard]] const std::vector<TorsionBatch>& torsion() const noexcept;
  /// Events met so far (all of them after Next returned false).
  [[nodiscard]] const std::vector<Event>& events() const noexcept;
  [[nodiscard]] const Damage& damage() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session
