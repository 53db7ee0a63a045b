#include "cli/commands/session_text.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "cli/utc_text.hpp"
#include "rt/say.hpp"

namespace levitas::cli {

std::string Describe(const std::string& path, const session::SessionHeader& header) {
  std::string channels;
  for (const auto& channel : header.channels) channels += fmt::format(" {}", rt::OneLine(channel));
  return fmt::format("{}: {} {}, every {} us, channels{}", rt::OneLine(path),
                     rt::OneLine(header.pace), UtcText(header.start_utc_ns),
                     static_cast<double>(header.period_ns) * 1e-3, channels);
}

void PrintDamage(const session::Damage& damage) {
  if (damage.any()) fmt::print("Not everything could be read: {}.\n", damage.Text());
}

nlohmann::ordered_json DamageJson(const session::Damage& damage) {
  return {{"corrupt_bytes", damage.corrupt_bytes},   {"corrupt_records", damage.corrupt_records},
          {"corrupt_blocks", damage.corrupt_blocks}, {"missing_cycles", damage.missing_cycles},
          {"truncated", damage.truncated},           {"first_bad_byte", damage.first_bad_offset}};
}

}  // namespace levitas::cli
