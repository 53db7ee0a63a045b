#pragma once
// A session packed by zstd: the bytes of the same LCM event log in frames of zstd, one behind the
// other, so that `zstd -d` gives the plain log and each frame can be read without the others.
//
// Frames   a new one after kFrameBytes of the log, always at the start of an event; each ends in
//          zstd's own checksum. What is packed so far is handed on at every Pack: a file that was
//          cut off is readable up to its last complete block.
// Damage   a damaged frame is left behind, the next one is searched by its first four bytes; what
//          was unpacked before the damage has been given. Blocks that are lost are counted.
// Limits   a record's checksum does not shrink, so that no session packs to less than a fiftieth:
//          what unpacks to more than kMostRatio times the file and 64 MiB is refused.
// Thread   one per object; never the loop's.
// Failure  PackedReader: BadInput when reading fails or a limit is passed. Packer: bad_alloc.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace levitas::session {

/// About a second of a rig of four axes at 10 kHz.
inline constexpr std::size_t kFrameBytes = std::size_t{4} << 20;
inline constexpr std::uint64_t kMostRatio = 1000;
/// While recording: some 4 % of a core at 10 kHz (docs/formats.md). Afterwards there is time.
inline constexpr int kRecordingLevel = 3;
inline constexpr int kArchiveLevel = 9;

/// A name that ends in .zst: what is written under it is packed.
[[nodiscard]] bool PackedName(std::string_view path) noexcept;
/// A file that begins as zstd does (of a frame, or of one that unpackers skip).
[[nodiscard]] bool BeginsPacked(std::span<const std::uint8_t> start) noexcept;

class Packer {
 public:
  explicit Packer(int level);
  ~Packer();
  Packer(const Packer&) = delete;
  Packer& operator=(const Packer&) = delete;

  /// Replaces `out` by the packed bytes of whole events, which a reader can unpack at once.
  void Pack(std::span<const std::uint8_t> events, std::vector<std::uint8_t>& out);
  /// Replaces `out` by the end of the frame that is open; empty when none is.
  void End(std::vector<std::uint8_t>& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class PackedReader {
 public:
  /// Of the first `bytes` of the open file; the descriptor stays the caller's.
  PackedReader(int fd, std::uint64_t bytes, std::string path);
  ~PackedReader();
  PackedReader(const PackedReader&) = delete;
  PackedReader& operator=(const PackedReader&) = delete;

  /// The next bytes of the log; fewer than asked for at its end only.
  std::size_t Read(std::span<std::uint8_t> to);
  /// To its first byte; what was lost is counted anew.
  void Rewind();

  /// Frames left because of damage; so far.
  [[nodiscard]] std::uint64_t bad_frames() const noexcept;
  /// How much of the log was given before the first of them.
  [[nodiscard]] std::uint64_t first_bad_offset() const noexcept;
  /// The file ends inside a frame.
  [[nodiscard]] bool cut_off() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::session
