#pragma once
// The same LCM log under another name: packed by zstd or unpacked, every byte of it, damage too.
//
// Written  as OutputFile does: it appears when it is whole and on the disk. What PackSession wrote
//          is read back and compared with the log before it appears.
// Thread   any; offline.
// Failure  BadInput: the file cannot be read, or changes while it is read; Problem of status 1: the
//          disk is full, or what was written reads back otherwise. Nothing is left behind then.
// Not done the log that is read stays; whether to remove it is the caller's.

#include <cstdint>
#include <string>

namespace levitas::session {

struct RepackReport {
  std::uint64_t file_bytes{};  ///< of the file that was read
  std::uint64_t log_bytes{};   ///< of the log
  std::uint64_t out_bytes{};   ///< of the file that was written
};

/// Packed where the name of `out_path` ends in .zst, plain elsewhere.
RepackReport Repack(const std::string& path, const std::string& out_path);

/// What Repack would make packed of, and is not yet.
[[nodiscard]] bool IsPacked(const std::string& path);

}  // namespace levitas::session
