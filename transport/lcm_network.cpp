#include "transport/lcm_network.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <netinet/in.h>

#include <charconv>
#include <string_view>

#include "common/problem.hpp"
#include "transport/network_key.hpp"

namespace levitas::transport {

namespace {

constexpr int kMaxBasePort = 65'535 - 3;  // four consecutive ports

[[noreturn]] void Refuse(const std::string& text, const std::string& why,
                         const std::string& other_forms = {}) {
  throw Problem(ExitStatus::kUsage,
                fmt::format("--port \"{}\": {}; allowed: lcm, {}or "
                            "lcm:udpm://<multicast address>:<port 1 to {}>?ttl=<0 to 255>",
                            text, why, other_forms, kMaxBasePort));
}

int ReadInt(const std::string& whole, std::string_view part, int low, int high, const char* what) {
  int value = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (error != std::errc{} || end != part.data() + part.size() || value < low || value > high) {
    Refuse(whole, fmt::format("{} \"{}\" is not a number from {} to {}", what, part, low, high));
  }
  return value;
}

}  // namespace

std::string LcmNetwork::Url(Direction direction) const {
  return fmt::format("udpm://{}:{}?ttl={}", group, Port(direction), ttl);
}

LcmNetwork ParseLcmNetwork(const std::string& text, const std::string& other_forms) {
  LcmNetwork network;
  if (text == "lcm") return network;
  constexpr std::string_view kPrefix = "lcm:udpm://";
  if (!text.starts_with(kPrefix)) Refuse(text, "unknown form", other_forms);
  std::string_view rest = std::string_view(text).substr(kPrefix.size());
  constexpr std::string_view kTtl = "?ttl=";
  if (const auto query = rest.find('?'); query != std::string_view::npos) {
    if (!rest.substr(query).starts_with(kTtl)) Refuse(text, "unknown option after ?");
    network.ttl = ReadInt(text, rest.substr(query + kTtl.size()), 0, 255, "ttl");
    rest = rest.substr(0, query);
  }
  const auto colon = rest.find(':');
  if (colon == std::string_view::npos) Refuse(text, "no port");
  network.group = std::string(rest.substr(0, colon));
  network.base_port =
      static_cast<std::uint16_t>(ReadInt(text, rest.substr(colon + 1), 1, kMaxBasePort, "port"));
  in_addr address{};
  if (inet_pton(AF_INET, network.group.c_str(), &address) != 1 ||
      !IN_MULTICAST(ntohl(address.s_addr))) {
    Refuse(text, fmt::format("\"{}\" is not a multicast address (224.0.0.0 to 239.255.255.255)",
                             network.group));
  }
  return network;
}

void TakeKey(LcmNetwork& network, const std::string& key_path, const char* could) {
  if (!key_path.empty()) network.key = NetworkKey::Load(key_path);
  if (network.key || network.this_machine_only()) return;
  throw Problem(
      ExitStatus::kUsage,
      fmt::format("{}: other machines reach this network and could {}; name the key of those who "
                  "may with --key FILE (`amb key FILE` makes one), or keep to this machine with "
                  "ttl=0",
                  network.Url(Direction::kSensor), could));
}

}  // namespace levitas::transport
