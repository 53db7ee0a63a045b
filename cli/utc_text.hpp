#pragma once
// Instants as people write them, in UTC.

#include <cstdint>
#include <string>

namespace levitas::cli {

/// "2026-11-21T05:45:01Z".
[[nodiscard]] std::string UtcText(std::int64_t utc_ns);

/// The instant a day ("2026-11-21") or a minute ("2026-11-21T05:45") begins, and when it is over.
struct UtcSpan {
  std::int64_t begin_ns{};
  std::int64_t end_ns{};
};
/// Throws a usage Problem that names `option` for what is neither, or is no day of the calendar.
[[nodiscard]] UtcSpan ParseUtc(const std::string& text, const std::string& option);

}  // namespace levitas::cli
