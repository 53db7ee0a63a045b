#pragma once
// Times as people type them [s]. The usual checks of an option parser let "nan" and 1e300 pass,
// which as nanoseconds or as periods are no number any more.
//
// Thread   any. Failure: none.

#include <charconv>
#include <string>

namespace levitas {

inline constexpr double kLeastTimeS = 1e-6;
inline constexpr double kMostTimeS = 1e8;  ///< three years; as nanoseconds far below 2^63

/// Empty for a time in the range above; else what is wrong, for a person. The form that CLI11 asks
/// of a check.
[[nodiscard]] inline std::string WhyNoTime(const std::string& text) {
  double seconds = 0.0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, seconds);
  const bool read = error == std::errc{} && stop == end && !text.starts_with("+-");
  if (read && seconds >= kLeastTimeS && seconds <= kMostTimeS) return {};
  return "'" + text + "' is no time; allowed: 1e-6 to 1e8 s";
}

}  // namespace levitas
