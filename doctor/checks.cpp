#include "doctor/checks.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <bit>
#include <cstdlib>

namespace levitas::doctor {
namespace {

/// With 4 MB nothing was lost at four channels of 10 kHz; the usual 208 kB lost 0.1 to 3.6 per
/// mille.
constexpr long kSocketBufferBytes = 4L << 20U;
constexpr int kRoundTrips = 100;
/// ARPHRD_CAN of linux/if_arp.h: the type of a CAN interface in /sys/class/net.
constexpr const char* kCanInterfaceType = "280";
/// Largest frame of CAN FD as the network layer counts it (CANFD_MTU).
constexpr const char* kCanFdMtu = "72";
/// A session takes about 3 MB per second at 10 kHz and four axes.
constexpr std::uint64_t kSessionBytesPerSecond = 3'000'000;
constexpr std::uint64_t kComfortableBytes = 600 * kSessionBytesPerSecond;
constexpr std::uint64_t kLeastBytes = 30 * kSessionBytesPerSecond;

/// True when some line of the route table covers 239.255.76.67; the narrowest one counts. Columns:
/// interface, destination, gateway, flags, three counters, mask; addresses are hexadecimal in
/// network byte order.
bool CoversGroup(const std::vector<std::string>& routes, std::string& interface_name) {
  // 239.255.76.67 as the table writes it on a little-endian machine.
  constexpr unsigned long kGroup = 0x434CFFEFUL;
  constexpr unsigned long kRouteUp = 1UL;
  int narrowest = -1;
  for (std::size_t i = 1; i < routes.size(); ++i) {
    char name[64] = {};  // NOLINT(modernize-avoid-c-arrays): for sscanf
    unsigned long destination = 0;
    unsigned long flags = 0;
    unsigned long mask = 0;
    if (std::sscanf(routes[i].c_str(), "%63s %lx %*x %lx %*d %*d %*d %lx", name, &destination,
                    &flags, &mask) != 4) {
      continue;
    }
    const int bits = std::popcount(mask);
    if ((flags & kRouteUp) == 0 || (kGroup & mask) != destination || bits <= narrowest) continue;
    narrowest = bits;
    interface_name = name;
  }
  return narrowest >= 0;
}

/// Whether the running kernel has this module, loaded, built in, or to be loaded.
bool HasModule(const Probe& probe, const std::string& name) {
  if (probe.Exists("/sys/module/" + name)) return true;
  const std::string folder = "/lib/modules/" + probe.KernelRelease();
  for (const char* list : {"/modules.dep", "/modules.builtin"}) {
    for (const std::string& line : probe.ReadLines(folder + list)) {
      if (line.find("/" + name + ".ko") != std::string::npos) return true;
    }
  }
  return false;
}

/// Our own programs need no route as long as ttl is 0; LCM's tools send and listen where the route
/// points.
Finding MulticastRoute(const Probe& probe) {
  constexpr const char* kLoopbackRoute = "sudo ip route replace 224.0.0.0/4 dev lo src 127.0.0.1";
  std::string name;
  const bool some = CoversGroup(probe.ReadLines("/proc/net/route"), name);
  if (some && name == "lo") {
    return {Area::kLcm, "route", State::kOk,
            "lcm-spy and lcm-logger listen where the programs speak", ""};
  }
  return {Area::kLcm, "route", State::kDegraded,
          some ? "multicast leaves through " + name +
                     ": lcm-spy and lcm-logger listen there and hear nothing of a rig with ttl 0"
               : "no route for 239.255.76.67: lcm-spy and lcm-logger cannot listen",
          kLoopbackRoute};
}

Finding MulticastLoopback(const Probe& probe) {
  const MulticastTrial trial = probe.RoundTrips(kRoundTrips);
  if (trial.sent > 0 && trial.received == trial.sent) {
    return {Area::kLcm, "loopback", State::kOk,
            fmt::format("{} of {} messages came back, median {:.0f} us", trial.received, trial.sent,
                        trial.median_us),
            ""};
  }
  const bool some = trial.received > 0;
  return {
      Area::kLcm, "loopback", some ? State::kDegraded : State::kMissing,
      fmt::format("{} of {} messages came back{}{}", trial.received, trial.sent,
                  trial.reason.empty() ? "" : ": ", trial.reason),
      some ? "stop other load and try again"
           : "sudo ip link set lo up  # and a firewall must let UDP to 239.255.76.67 pass on lo"};
}

Finding SocketBuffer(const Probe& probe) {
  const auto text = probe.ReadLine("/proc/sys/net/core/rmem_max");
  if (!text) {
    return {Area::kLcm, "socket buffer", State::kDegraded,
            "net.core.rmem_max is not visible here (a container?)",
            "on the host: sudo sysctl -w net.core.rmem_max=4194304"};
  }
  const long bytes = std::atol(text->c_str());
  if (bytes >= kSocketBufferBytes) {
    return {Area::kLcm, "socket buffer", State::kOk, fmt::format("up to {} kB", bytes >> 10U), ""};
  }
  return {Area::kLcm, "socket buffer", State::kDegraded,
          fmt::format("at most {} kB: telemetry may be lost when a reader pauses", bytes >> 10U),
          "sudo sysctl -w net.core.rmem_max=4194304"};
}

Finding CanSockets(const Probe& probe, const Trial& socket) {
  if (socket.worked) {
    return {Area::kCan, "sockets", State::kOk, "the kernel has CAN sockets", ""};
  }
  if (HasModule(probe, "can")) {
    return {Area::kCan, "sockets", State::kMissing,
            "the kernel's CAN modules are not loaded (" + socket.reason + ")",
            "sudo modprobe -a can can_raw vcan"};
  }
  return {Area::kCan, "sockets", State::kMissing,
          fmt::format("kernel {} has no CAN ({})", probe.KernelRelease(), socket.reason),
          "use a Debian kernel: sudo apt-get install linux-image-amd64, then restart"};
}

Finding CanInterfaces(const Probe& probe, const Trial& socket) {
  std::vector<std::string> fd;
  std::vector<std::string> classical;
  for (const std::string& name : probe.List("/sys/class/net", "")) {
    const std::string folder = "/sys/class/net/" + name;
    if (probe.ReadLine(folder + "/type") != kCanInterfaceType) continue;
    (probe.ReadLine(folder + "/mtu") == kCanFdMtu ? fd : classical).push_back(name);
  }
  if (!socket.worked && !HasModule(probe, "can")) {
    return {Area::kCan, "interfaces", State::kMissing, "no CAN interface",
            "first a kernel with CAN (see sockets)"};
  }
  if (fd.empty() && classical.empty()) {
    return {Area::kCan, "interfaces", State::kMissing, "no CAN interface",
            "sudo modprobe vcan && sudo ip link add vcan0 type vcan && sudo ip link set "
            "vcan0 mtu 72 up"};
  }
  if (fd.empty()) {
    const std::string& name = classical.front();
    return {
        Area::kCan, "interfaces", State::kDegraded,
        fmt::format("{}: classical CAN only, 1.5 kHz for four axes", fmt::join(classical, ", ")),
        fmt::format("sudo ip link set {0} down && sudo ip link set {0} type can bitrate 1000000 "
                    "dbitrate 5000000 fd on && sudo ip link set {0} up (vcan: sudo ip link set {0} "
                    "mtu 72)",
                    name)};
  }
  return {Area::kCan, "interfaces", State::kOk, fmt::format("{} (CAN FD)", fmt::join(fd, ", ")),
          ""};
}

}  // namespace

std::vector<Finding> CheckLcm(const Probe& probe) {
  return {MulticastRoute(probe), MulticastLoopback(probe), SocketBuffer(probe),
          WhoMayCommand(probe)};
}

std::vector<Finding> CheckCan(const Probe& probe) {
  const Trial socket = probe.OpenCanSocket();
  return {CanSockets(probe, socket), CanInterfaces(probe, socket)};
}

std::vector<Finding> CheckGpio(const Probe& probe) {
  std::vector<Finding> findings;
  const std::vector<std::string> chips = probe.List("/dev", "gpiochip");
  if (chips.empty()) {
    findings.push_back(
        {Area::kGpio, "chips", State::kMissing, "no /dev/gpiochip*",
         HasModule(probe, "gpio-sim") || HasModule(probe, "gpio_sim")
             ? "sudo modprobe gpio-sim, and configure one in /sys/kernel/config/gpio-sim"
             : "a machine with GPIO lines, or a kernel with CONFIG_GPIO_SIM"});
  } else {
    std::vector<std::string> refused;
    for (const std::string& chip : chips) {
      if (!probe.ReadableAndWritable("/dev/" + chip)) refused.push_back(chip);
    }
    if (refused.empty()) {
      findings.push_back(
          {Area::kGpio, "chips", State::kOk, fmt::format("{}", fmt::join(chips, ", ")), ""});
    } else {
      findings.push_back({Area::kGpio, "chips", State::kDegraded,
                          fmt::format("no permission for {}", fmt::join(refused, ", ")),
                          "sudo usermod -aG gpio \"$USER\", then log in again; or run as root"});
    }
  }
  return findings;
}

std::vector<Finding> CheckStorage(const Probe& probe, const std::string& folder) {
  const auto bytes = probe.FreeBytes(folder);
  if (!bytes) {
    return {{Area::kStorage, "disk", State::kMissing, folder + " cannot be used",
             "choose an existing folder that may be written"}};
  }
  const std::string found =
      fmt::format("{:.1f} GB free, room for {} s of recording", static_cast<double>(*bytes) / 1e9,
                  *bytes / kSessionBytesPerSecond);
  const State state = *bytes >= kComfortableBytes ? State::kOk
                      : *bytes >= kLeastBytes     ? State::kDegraded
                                                  : State::kMissing;
  return {{Area::kStorage, "disk", state, found,
           state == State::kOk ? "" : "free space, or record to another disk (--record FILE)"}};
}

std::vector<Finding> CheckMachine(const Probe& probe, const std::string& folder) {
  std::vector<Finding> all = CheckRealTime(probe);
  for (auto part :
       {CheckLcm(probe), CheckCan(probe), CheckGpio(probe), CheckStorage(probe, folder)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace levitas::doctor
