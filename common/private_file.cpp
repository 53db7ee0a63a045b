#include "common/private_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/file_descriptor.hpp"

namespace levitas {

namespace {

constexpr mode_t kOthers = S_IRWXG | S_IRWXO;

}  // namespace

std::string WhyNotPrivate(const struct stat& facts, uid_t reader, const std::string& path) {
  if (!S_ISREG(facts.st_mode)) return "it is not a regular file";
  if (facts.st_uid != reader && facts.st_uid != 0) {
    return fmt::format("it belongs to user {}", facts.st_uid);
  }
  if ((facts.st_mode & kOthers) != 0) {
    return fmt::format("its mode {:o} lets others read or write it (chmod 600 {})",
                       facts.st_mode & (S_IRWXU | kOthers), path);
  }
  return "";
}

PrivateFile ReadPrivateFile(const std::string& path, std::size_t most_bytes) {
  const auto refuse = [](const std::string& why) { return PrivateFile{"", why}; };
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  struct stat facts {};
  if (!file.is_open() || fstat(file.handle(), &facts) != 0) return refuse(std::strerror(errno));
  if (std::string why = WhyNotPrivate(facts, geteuid(), path); !why.empty()) return refuse(why);
  PrivateFile read_file;
  read_file.content.resize(most_bytes);
  const ssize_t count = read(file.handle(), read_file.content.data(), most_bytes);
  if (count < 0) return refuse(std::strerror(errno));
  read_file.content.resize(static_cast<std::size_t>(count));
  return read_file;
}

}  // namespace levitas
