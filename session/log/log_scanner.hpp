#pragma once
// Walks through the events of an LCM event log, sound or damaged, plain or packed by zstd (told by
// the file's first bytes or its name; session/log/packed_log.hpp).
//
// Offsets  of the log, so of the unpacked one.
// Damage   the scanner only judges the frame of an event (sync word, lengths, end of file). The
//          reader judges its content; when that is bad it calls SkipToSync, which searches from
//          just behind the bad event's sync word: whatever a damaged length swallowed is found.
// Memory   a window of the file, never the whole of it.
// Failure  BadInput when the file cannot be opened or read.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::session {

class PackedReader;

struct RawEvent {
  std::uint64_t offset{};
  std::uint64_t end{};  ///< offset of the first byte behind it
  std::int64_t time_us{};
  std::string_view channel;            ///< valid until the scanner is used again
  std::span<const std::uint8_t> data;  ///< valid until the scanner is used again
};

class LogScanner {
 public:
  explicit LogScanner(const std::string& path);
  ~LogScanner();
  LogScanner(const LogScanner&) = delete;
  LogScanner& operator=(const LogScanner&) = delete;

  enum class Look : std::uint8_t {
    kEvent,     ///< a complete event stands here
    kNotEvent,  ///< no event starts here
    kCutOff,    ///< an event starts here and reaches beyond the end of the file
    kEnd,       ///< the file ends exactly here
  };
  /// Judges the current position; does not move.
  [[nodiscard]] Look At(RawEvent& event);
  void MoveTo(std::uint64_t offset) noexcept { offset_ = offset; }
  /// Moves to the next sync word after the current position, else to the end of the file.
  /// False in the latter case.
  bool SkipToSync();
  [[nodiscard]] std::uint64_t offset() const noexcept { return offset_; }
  /// Of the file, as it was when it was opened.
  [[nodiscard]] std::uint64_t file_bytes() const noexcept { return file_bytes_; }
  /// Null for a plain log: what packing hides of damage.
  [[nodiscard]] const PackedReader* packed() const noexcept { return packed_.get(); }
  /// The log's bytes from `offset` on, at most `count`; empty at its end. Valid until the scanner
  /// is used again.
  [[nodiscard]] std::span<const std::uint8_t> Bytes(std::uint64_t offset, std::size_t count) {
    return Window(offset, count);
  }

 private:
  /// Bytes `from` .. `from + count` of the file, fewer at its end.
  std::span<const std::uint8_t> Window(std::uint64_t from, std::size_t count);
  void LoadPlain(std::uint64_t from, std::size_t room);
  void LoadPacked(std::uint64_t from, std::size_t room);
  /// Bytes that stand at `at` of the plain file; fewer at its end.
  std::size_t ReadAt(std::uint64_t at, std::span<std::uint8_t> to);

  std::string path_;
  int fd_{-1};
  std::unique_ptr<PackedReader> packed_;
  std::uint64_t file_bytes_{0};
  std::uint64_t size_{0};  ///< of the log; of a packed one known at its end
  std::uint64_t offset_{0};
  std::uint64_t window_offset_{0};
  std::size_t window_bytes_{0};
  std::vector<std::uint8_t> window_;
};

}  // namespace levitas::session
