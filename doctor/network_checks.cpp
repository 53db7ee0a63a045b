// Who could command a rig of this machine over LCM: which interface the group is joined on, and who
// listens on the default ports now.

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "doctor/checks.hpp"

namespace levitas::doctor {
namespace {

/// 239.255.76.67 as the kernel's tables write it on a little-endian machine.
constexpr unsigned long kLcmGroup = 0x434CFFEFUL;
constexpr unsigned kFirstPort = 7667;
constexpr unsigned kLastPort = 7670;

/// Interfaces other than lo on which some program has joined the default group. /proc/net/igmp: a
/// line for each interface (index, name, colon ...), below it one for each group, indented.
std::vector<std::string> JoinedOutside(const std::vector<std::string>& lines) {
  std::vector<std::string> names;
  std::string device;
  for (const std::string& line : lines) {
    char name[64] = {};  // NOLINT(modernize-avoid-c-arrays): for sscanf
    unsigned long group = 0;
    const bool indented = !line.empty() && (line.front() == '\t' || line.front() == ' ');
    if (!indented && std::sscanf(line.c_str(), "%*u %63[^ :]", name) == 1) {
      device = name;
    } else if (indented && std::sscanf(line.c_str(), "%lx", &group) == 1 && group == kLcmGroup &&
               device != "lo") {
      names.push_back(device);
    }
  }
  return names;
}

/// Default ports that some program has bound. /proc/net/udp: slot, address:port in hexadecimal.
std::vector<unsigned> PortsInUse(const std::vector<std::string>& lines) {
  std::vector<unsigned> ports;
  for (const std::string& line : lines) {
    unsigned port = 0;
    if (std::sscanf(line.c_str(), "%*[^:]: %*x:%x", &port) != 1) continue;
    if (port < kFirstPort || port > kLastPort) continue;
    if (std::find(ports.begin(), ports.end(), port) == ports.end()) ports.push_back(port);
  }
  std::sort(ports.begin(), ports.end());
  return ports;
}

}  // namespace

Finding WhoMayCommand(const Probe& probe) {
  const auto ports = PortsInUse(probe.ReadLines("/proc/net/udp"));
  const std::string in_use = ports.empty()
                                 ? "nobody listens on UDP 7667 to 7670 now"
                                 : fmt::format("bound now: UDP {}", fmt::join(ports, ", "));
  const auto outside = JoinedOutside(probe.ReadLines("/proc/net/igmp"));
  if (outside.empty()) {
    return {
        Area::kLcm, "who may command", State::kOk,
        fmt::format("by default every program of this machine and no other machine (loopback "
                    "only); a rig on a real bus: nobody; the live page: this machine, elsewhere "
                    "with its token; {}",
                    in_use),
        ""};
  }
  return {
      Area::kLcm, "who may command", State::kDegraded,
      fmt::format("a program has joined 239.255.76.67 on {}: it hears every machine there; {}",
                  fmt::join(outside, ", "), in_use),
      "ss -ulnp | grep 239.255.76.67 names it; a rig there needs --key FILE (docs/dashboard.md)"};
}

}  // namespace levitas::doctor
