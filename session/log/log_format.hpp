#pragma once
// The container of a session: LCM's event log, as its documentation defines it.
//
// Event   sync word, number, time, channel length, data length, channel, data; big-endian:
//         u32 0xEDA1DA01 | i64 number | i64 time [us since 1970 UTC] | i32 | i32 | bytes | bytes
// Written directly and not through lcm_eventlog_write_event: that one buffers in stdio, allocates
// nothing of ours but leaves the moment of writing to the C library, and its reader stops at the
// first damaged length. Every LCM tool reads what is written here (tests/unit/session/log).

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace levitas::session {

inline constexpr std::uint32_t kSyncWord = 0xEDA1DA01U;
inline constexpr std::size_t kEventHeaderBytes = 28;
/// Longer lengths are taken for damage. LCM forbids longer channel names; the longest data of ours
/// is the header with three configuration texts.
inline constexpr std::size_t kMaxChannelBytes = 63;
inline constexpr std::size_t kMaxDataBytes = std::size_t{4} << 20;

inline constexpr std::string_view kHeaderChannel = "LEVITAS_HEADER";
inline constexpr std::string_view kCycleChannel = "LEVITAS_CYCLE";
inline constexpr std::string_view kEventChannel = "LEVITAS_EVENT";
inline constexpr std::string_view kTorsionChannel = "LEVITAS_TORSION";

struct EventHeader {
  std::uint32_t sync{kSyncWord};
  std::int64_t number{};
  std::int64_t time_us{};
  std::int32_t channel_bytes{};
  std::int32_t data_bytes{};
};

template <class Word>
constexpr void PutBigEndian(std::uint8_t* to, Word word) noexcept {
  for (std::size_t i = 0; i < sizeof(Word); ++i) {
    to[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(word) >>
                                      (8U * (sizeof(Word) - 1U - i)));
  }
}

template <class Word>
[[nodiscard]] constexpr Word GetBigEndian(const std::uint8_t* from) noexcept {
  std::uint64_t word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i) word = word << 8U | from[i];
  return static_cast<Word>(word);
}

/// `to` has room for kEventHeaderBytes.
constexpr void PutEventHeader(std::uint8_t* to, const EventHeader& header) noexcept {
  PutBigEndian(to, header.sync);
  PutBigEndian(to + 4, header.number);
  PutBigEndian(to + 12, header.time_us);
  PutBigEndian(to + 20, header.channel_bytes);
  PutBigEndian(to + 24, header.data_bytes);
}

[[nodiscard]] constexpr EventHeader GetEventHeader(const std::uint8_t* from) noexcept {
  return {GetBigEndian<std::uint32_t>(from), GetBigEndian<std::int64_t>(from + 4),
          GetBigEndian<std::int64_t>(from + 12), GetBigEndian<std::int32_t>(from + 20),
          GetBigEndian<std::int32_t>(from + 24)};
}

}  // namespace levitas::session
