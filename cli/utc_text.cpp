#include "cli/utc_text.hpp"

#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <optional>

#include "common/problem.hpp"

namespace levitas::cli {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

/// Nothing unless the whole text has that form and names an instant of the calendar.
std::optional<std::int64_t> Parse(const std::string& text, const char* form) {
  std::tm parts{};
  parts.tm_mday = 1;
  const char* end = ::strptime(text.c_str(), form, &parts);
  if (end == nullptr || *end != '\0') return std::nullopt;
  std::tm normal = parts;
  const std::time_t seconds = ::timegm(&normal);
  if (normal.tm_mday != parts.tm_mday) return std::nullopt;  // 31 November
  return static_cast<std::int64_t>(seconds) * kSecondNs;
}

}  // namespace

std::string UtcText(std::int64_t utc_ns) {
  const auto seconds = static_cast<std::time_t>(utc_ns / kSecondNs);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

UtcSpan ParseUtc(const std::string& text, const std::string& option) {
  using std::chrono::nanoseconds;
  if (const auto day = Parse(text, "%Y-%m-%d")) {
    return {*day, *day + nanoseconds(std::chrono::hours(24)).count()};
  }
  if (const auto minute = Parse(text, "%Y-%m-%dT%H:%M")) {
    return {*minute, *minute + nanoseconds(std::chrono::minutes(1)).count()};
  }
  throw Problem(ExitStatus::kUsage,
                fmt::format("{}: '{}' is no day and no minute; allowed: 2026-11-21 or "
                            "2026-11-21T05:45, in UTC",
                            option, text));
}

}  // namespace levitas::cli
