#pragma once
// Packs recorded sessions by zstd, each beside itself: x.lcm becomes x.lcm.zst.
//
// Lost      nothing: what was packed is read back and compared byte for byte before the session
//           that was packed is removed. A session that changes meanwhile stays.
// Kept      time and rights of the file; its entry and tags in the catalogue, under the new name.
// Thread    any; offline.
// Failure   BadInput in the end, with a line for each file that was refused; the others are packed.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace levitas::cli {

struct CompressOptions {
  std::vector<std::string> files;
  bool keep{};                           ///< the plain session stays
  std::optional<std::string> catalogue;  ///< path; none: no catalogue is kept
};

struct Compressed {
  std::string session;  ///< its new path
  std::string from;
  std::uint64_t before_byte{};
  std::uint64_t after_byte{};
};

/// `refused` gains a line for each file that could not be packed; packed ones are passed over.
[[nodiscard]] std::vector<Compressed> CompressSessions(const CompressOptions& options,
                                                       std::string& refused);

}  // namespace levitas::cli
