#include "hil/socketcan/can_connection.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "common/problem.hpp"

namespace levitas::socketcan {
namespace {

constexpr std::size_t kMaxName = 15;  // of an interface, IFNAMSIZ less its end

[[noreturn]] void Refuse(const std::string& port, const std::string& why) {
  throw Problem(ExitStatus::kUsage,
                fmt::format("--port \"{}\": {}; allowed: can (interfaces of the rig's file), or "
                            "can:IF[,IF...], for example can:vcan0",
                            port, why));
}

std::vector<std::string> InterfacesOf(const std::string& port) {
  std::vector<std::string> names;
  if (port == "can") return names;
  std::istringstream list(port.substr(std::string("can:").size()));
  std::string name;
  while (std::getline(list, name, ',')) {
    if (name.empty() || name.size() > kMaxName || name.find_first_of(" /:") != std::string::npos) {
      Refuse(port, fmt::format("\"{}\" is no name of an interface", name));
    }
    names.push_back(name);
  }
  if (names.empty() || port.back() == ',') Refuse(port, "no interface named");
  return names;
}

/// Buses that share one real wire are one bus.
std::vector<can::BusConfig> MergeShared(const std::vector<can::BusConfig>& buses,
                                        bool (*is_virtual)(const std::string&)) {
  std::vector<can::BusConfig> merged;
  for (const can::BusConfig& bus : buses) {
    const auto same = std::find_if(merged.begin(), merged.end(), [&](const auto& other) {
      return other.interface == bus.interface;
    });
    if (same == merged.end() || is_virtual(bus.interface)) {
      merged.push_back(bus);
      continue;
    }
    same->name += " and " + bus.name;
    same->carries = can::Carries::kEverything;
    if (bus.carries == can::Carries::kToRig) same->current_acts = bus.current_acts;
    same->load_limit = std::min(same->load_limit, bus.load_limit);
    same->rates.arbitration_bit_per_s =
        std::min(same->rates.arbitration_bit_per_s, bus.rates.arbitration_bit_per_s);
    same->rates.data_bit_per_s = std::min(same->rates.data_bit_per_s, bus.rates.data_bit_per_s);
  }
  return merged;
}

/// On the first interface that does not exist, which may have been meant as a vcan; empty when all
/// exist. It comes first: of a vcan that is there, no load would have been asked.
std::string MissingText(const std::vector<can::BusConfig>& buses) {
  for (const can::BusConfig& bus : buses) {
    std::error_code none;
    if (std::filesystem::exists("/sys/class/net/" + bus.interface, none)) continue;
    return fmt::format(
        "there is no interface {0} here. For a simulated rig a virtual one does: sudo ip link add "
        "dev {0} type vcan; sudo ip link set {0} mtu 72 up (a kernel without vcan: "
        "scripts/test_machine.sh has one). A real bus would not do: ",
        bus.interface);
  }
  return {};
}

/// Buses, layout and load, whether or not the load fits.
CanConnection Loaded(const RigNumbers& rig, const std::vector<can::BusConfig>& buses,
                     const std::string& rig_name, const std::string& port,
                     bool (*is_virtual)(const std::string&)) {
  const std::vector<std::string> interfaces = InterfacesOf(port);
  if (buses.empty()) {
    throw BadInput(
        fmt::format("{}: names no CAN buses; --port {} needs a section buses, see docs/real_rig.md",
                    rig_name, port));
  }
  if (interfaces.size() > buses.size()) {
    Refuse(port, fmt::format("{} interfaces for the {} buses of {}", interfaces.size(),
                             buses.size(), rig_name));
  }
  CanConnection connection;
  connection.buses = buses;
  for (std::size_t at = 0; at < connection.buses.size() && !interfaces.empty(); ++at) {
    connection.buses[at].interface = interfaces[std::min(at, interfaces.size() - 1)];
  }
  connection.buses = MergeShared(connection.buses, is_virtual);
  connection.layout = can::MakeLayout(rig, can::FormatOf(connection.buses));
  connection.budget = can::MakeBudget(connection.layout, connection.buses);
  return connection;
}

/// Of a load that does not fit, without the end of its line.
std::string LoadRefusal(const can::Budget& budget) {
  std::string text = can::RefusalText(budget);
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace

std::string RealWireRefusal(const RigNumbers& rig, const std::vector<can::BusConfig>& buses,
                            const std::string& rig_name, const std::string& port) {
  const auto none = [](const std::string&) { return false; };
  return LoadRefusal(Loaded(rig, buses, rig_name, port, none).budget);
}

bool IsCanPort(const std::string& port) { return port == "can" || port.starts_with("can:"); }

bool IsVirtual(const std::string& interface) { return FindLink(interface) == LinkKind::kVirtual; }

std::string RealInterface(const std::vector<can::BusConfig>& buses, const std::string& port,
                          LinkKind (*find)(const std::string&)) {
  std::vector<std::string> names = InterfacesOf(port);
  if (names.empty()) {
    for (const can::BusConfig& bus : buses) names.push_back(bus.interface);
  }
  const auto real = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
    return find(name) == LinkKind::kReal;
  });
  return real == names.end() ? std::string{} : *real;
}

void RefuseLockstep(const std::vector<can::BusConfig>& buses, const std::string& port,
                    LinkKind (*find)(const std::string&)) {
  const std::string real = RealInterface(buses, port, find);
  if (real.empty()) return;
  throw Problem(
      ExitStatus::kUsage,
      fmt::format("--port {}: {} is no virtual CAN bus, so a real rig may be there, which "
                  "does not wait for its controller: --pace lockstep is refused, with it "
                  "no missing frame would trip and the rig's lines would not be used; "
                  "allowed: --pace realtime",
                  port, real));
}

CanConnection PlanConnection(const RigNumbers& rig, const std::vector<can::BusConfig>& buses,
                             const std::string& rig_name, const std::string& port,
                             bool (*is_virtual)(const std::string&)) {
  CanConnection connection = Loaded(rig, buses, rig_name, port, is_virtual);
  if (!connection.budget.fits()) {
    throw BadInput(fmt::format("{}: {}{}", rig_name, MissingText(connection.buses),
                               LoadRefusal(connection.budget)));
  }
  connection.virtual_bus = true;
  for (const can::BusConfig& bus : connection.buses) {
    connection.virtual_bus = connection.virtual_bus && is_virtual(bus.interface);
    connection.text +=
        fmt::format("{}{} ({})", connection.text.empty() ? "can:" : ",", bus.interface, bus.name);
  }
  return connection;
}

double DelayOnBuses(double of_file, const RigNumbers& rig, const can::Budget& budget) {
  // In whole nanoseconds: a hold until the next sample is a whole period to the bit.
  const auto delay_ns = static_cast<double>(std::llround(can::DelayOf(budget).total_s() * 1e9));
  return std::max(of_file, delay_ns / static_cast<double>(rig.period_ns));
}

}  // namespace levitas::socketcan
