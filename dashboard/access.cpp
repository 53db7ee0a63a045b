#include "dashboard/access.hpp"

#include <fmt/core.h>

#include <random>

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

}  // namespace levitas::dashboard
