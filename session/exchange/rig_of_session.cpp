#include "session/exchange/rig_of_session.hpp"

#include <fmt/core.h>

#include "common/problem.hpp"
#include "session/exchange/recording.hpp"
#include "session/log/session_reader.hpp"

namespace levitas::session {
namespace {

/// Empty where there is no session.
std::string RigTextOf(const std::string& path) {
  if (!IsSession(path)) return {};
  try {
    return SessionReader(path).header().rig_yaml;
  } catch (const BadInput&) {
    return {};
  }
}

}  // namespace

std::optional<configuration::RigFile> RigOfSession(const std::string& path) {
  const std::string text = RigTextOf(path);
  if (text.empty()) return std::nullopt;
  return configuration::ParseRig(text, fmt::format("{} (rig of its header)", path));
}

}  // namespace levitas::session
