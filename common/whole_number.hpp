#pragma once
// Whole numbers as people type them. An option parser takes one that does not fit for the largest
// that does, in silence; this check is made before.
//
// Thread   any. Failure: none.

#include <charconv>
#include <cstdint>
#include <string>

namespace levitas {

/// Empty for a whole number of 64 bits; else what is wrong, for a person. The form that CLI11 asks
/// of a check.
[[nodiscard]] inline std::string WhyNoWholeNumber(const std::string& text) {
  std::int64_t value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error == std::errc{} && stop == end && !text.starts_with("+-")) return {};
  return "'" + text + "' is not a whole number from -2^63 to 2^63 - 1";
}

}  // namespace levitas
