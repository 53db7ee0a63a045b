#include "cli/session_text.hpp"

#include <fmt/core.h>

#include <ctime>
#include <nlohmann/json.hpp>

namespace levitas::cli {

std::string Describe(const std::string& path, const session::SessionHeader& header) {
  const auto seconds = static_cast<std::time_t>(header.start_utc_ns / 1'000'000'000);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  std::string channels;
  for (const auto& channel : header.channels) channels += " " + channel;
  return fmt::format("{}: {} {:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z, every {} us, channels{}", path,
                     header.pace, utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday, utc.tm_hour,
                     utc.tm_min, utc.tm_sec, static_cast<double>(header.period_ns) * 1e-3,
                     channels);
}

void PrintDamage(const session::Damage& damage) {
  if (damage.any()) fmt::print("Not everything could be read: {}.\n", damage.Text());
}

nlohmann::ordered_json DamageJson(const session::Damage& damage) {
  return {{"corrupt_bytes", damage.corrupt_bytes},
          {"corrupt_records", damage.corrupt_records},
          {"missing_cycles", damage.missing_cycles},
          {"truncated", damage.truncated},
          {"first_bad_byte", damage.first_bad_offset}};
}

}  // namespace levitas::cli
