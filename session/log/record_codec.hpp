#pragma once
// Cycle records, events and headers to and from the bytes of their LCM types.
//
// Integrity  records and headers end in a CRC-32 over their own bytes with the CRC field zero; it
//            tells damage. What a sound CRC covers is still not believed: counts and lengths are
//            checked against the bytes before anything is decoded (lcmtypes/checked_decode.hpp),
//            and modes, faults and commands against their tables: others make a damaged record.
// Bits       every double survives with its bits, NaN included.
// Thread     one codec per thread; after the first record nothing is allocated for records.

#include <cstddef>
#include <cstdint>
#include <levitas_msg/cycle_record_t.hpp>
#include <span>
#include <string>
#include <vector>

#include "controller/cycle/cycle_io.hpp"
#include "session/log/session_header.hpp"

namespace levitas::session {

using Bytes = std::vector<std::uint8_t>;

class RecordCodec {
 public:
  explicit RecordCodec(std::size_t axes);

  /// Replaces `out` by the encoded record.
  void Encode(const cycle::CycleRecord& record, Bytes& out);
  /// False, and `record` untouched, when the bytes are damaged or not a cycle record.
  [[nodiscard]] bool Decode(std::span<const std::uint8_t> bytes, cycle::CycleRecord& record);

 private:
  levitas_msg::cycle_record_t message_;
};

void EncodeEvent(const Event& event, Bytes& out);
[[nodiscard]] bool DecodeEvent(std::span<const std::uint8_t> bytes, Event& event);

void EncodeHeader(const SessionHeader& header, Bytes& out);
enum class HeaderResult : std::uint8_t { kGood, kDamaged, kOtherVersion };
/// With kOtherVersion `version` says which.
[[nodiscard]] HeaderResult DecodeHeader(std::span<const std::uint8_t> bytes, SessionHeader& header,
                                        int& version);

}  // namespace levitas::session
