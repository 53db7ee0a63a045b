#include "dashboard/access.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <random>

#include "common/private_file.hpp"
#include "common/problem.hpp"

namespace levitas::dashboard {

bool IsLoopback(std::string_view address) {
  if (address == "localhost" || address == "::1") return true;
  if (!address.starts_with("127.")) return false;
  return address.find_first_not_of("0123456789.") == std::string_view::npos;
}

bool HostIsLoopback(std::string_view host_header) {
  std::string_view host = host_header;
  if (host.starts_with('[')) {  // [::1]:8970
    const auto close = host.find(']');
    if (close == std::string_view::npos) return false;
    const std::string_view rest = host.substr(close + 1);
    return IsLoopback(host.substr(1, close - 1)) && (rest.empty() || rest.starts_with(':'));
  }
  return IsLoopback(host.substr(0, host.find(':')));
}

bool FromAnotherPage(std::string_view host, std::string_view origin, std::string_view fetch_site) {
  if (!fetch_site.empty() && fetch_site != "same-origin" && fetch_site != "none") return true;
  if (origin.empty()) return false;
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (origin.starts_with(scheme) && origin.substr(scheme.size()) == host) return false;
  }
  return true;  // "null" too
}

bool TokenMatches(std::string_view given, std::string_view wanted) {
  if (wanted.empty() || given.size() != wanted.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    difference |= static_cast<unsigned>(static_cast<unsigned char>(given[i]) ^
                                        static_cast<unsigned char>(wanted[i]));
  }
  return difference == 0;
}

std::string NewToken() {
  std::random_device device;  // of the system, not seeded: a token must not repeat
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

void CheckToken(std::string_view token, const std::string& source) {
  if (token.size() < kLeastTokenLength) {
    throw Problem(
        ExitStatus::kUsage,
        fmt::format("{}: a token of {} characters can be guessed; at least {} are needed, "
                    "for example of: openssl rand -hex 16",
                    source, token.size(), kLeastTokenLength));
  }
  const bool fit = std::all_of(token.begin(), token.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-._~").find(c) != std::string_view::npos;
  });
  if (fit) return;
  throw Problem(
      ExitStatus::kUsage,
      fmt::format("{}: a token is part of an address: letters, digits and - . _ ~ only", source));
}

std::string ReadToken(const std::string& path) {
  constexpr std::size_t kMostBytes = 1024;
  const PrivateFile file = ReadPrivateFile(path, kMostBytes);
  if (!file.refused.empty()) {
    throw BadInput(fmt::format("token file {}: {}", path, file.refused));
  }
  std::string token = file.content.substr(0, file.content.find_first_of("\r\n"));
  CheckToken(token, path);
  return token;
}

}  // namespace levitas::dashboard
