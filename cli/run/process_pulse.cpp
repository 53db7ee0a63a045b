#include "cli/run/process_pulse.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace levitas::cli {
namespace {

namespace fs = std::filesystem;

/// "voluntary_ctxt_switches:	17" and the other one.
std::uint64_t Switches(const fs::path& thread) {
  std::ifstream status(thread / "status");
  std::uint64_t sum = 0;
  for (std::string line; std::getline(status, line);) {
    const std::size_t colon = line.find("voluntary_ctxt_switches:");
    if (colon == std::string::npos) continue;
    std::istringstream number(line.substr(line.find(':') + 1));
    std::uint64_t count = 0;
    if (number >> count) sum += count;
  }
  return sum;
}

/// Fields 14 and 15 of stat: user and system time. The name before them may hold spaces.
std::uint64_t Ticks(const fs::path& thread) {
  std::ifstream file(thread / "stat");
  std::string text;
  std::getline(file, text);
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return 0;
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 14; ++field) fields >> skipped;
  std::uint64_t user = 0;
  std::uint64_t system = 0;
  fields >> user >> system;
  return user + system;
}

}  // namespace

std::optional<std::uint64_t> PulseOf(pid_t process) {
  std::error_code none;
  const fs::directory_iterator threads(fmt::format("/proc/{}/task", process), none);
  if (none) return std::nullopt;
  std::uint64_t pulse = 0;
  for (const fs::directory_entry& thread : threads) {
    pulse += Switches(thread.path()) + Ticks(thread.path());
  }
  return pulse;
}

}  // namespace levitas::cli
