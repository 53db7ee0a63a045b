#include "dashboard/access.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <random>

#include "common/problem.hpp"
#include "dashboard/connection.hpp"

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
  // Not waiting for a writer, should it be a pipe.
  const Connection file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat facts {};
  if (file.socket() < 0 || ::fstat(file.socket(), &facts) != 0) {
    throw BadInput(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  }
  if (!S_ISREG(facts.st_mode)) throw BadInput(fmt::format("{}: is not a regular file", path));
  if ((facts.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    throw BadInput(
        fmt::format("{}: others may read or write the token (mode {:03o}); remedy: chmod 600 {}",
                    path, facts.st_mode & (S_IRWXU | S_IRWXG | S_IRWXO), path));
  }
  if (facts.st_uid != ::geteuid() && facts.st_uid != 0) {
    throw BadInput(fmt::format("{}: belongs to another user", path));
  }
  std::array<char, 1024> text{};
  const ssize_t count = ::read(file.socket(), text.data(), text.size());
  if (count < 0) throw BadInput(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  const std::string_view whole(text.data(), static_cast<std::size_t>(count));
  std::string token(whole.substr(0, whole.find_first_of("\r\n")));
  CheckToken(token, path);
  return token;
}

}  // namespace levitas::dashboard
