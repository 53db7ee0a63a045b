#include "transport/network_key.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/file_descriptor.hpp"
#include "common/private_file.hpp"
#include "common/problem.hpp"

namespace levitas::transport {

namespace {

constexpr std::size_t kDigits = 2 * SealingKey::kBytes;

// Chooses the fastest implementation for this processor, once; 1 on every later call.
void Prepare() {
  if (sodium_init() < 0) throw Problem(ExitStatus::kOther, "libsodium cannot be initialised");
}

[[noreturn]] void RefuseKey(const std::string& path, const std::string& why) {
  throw BadInput(fmt::format(
      "key file {}: {}; wanted: a regular file of this user or of root with {} hexadecimal digits "
      "that nobody else may read (mode 600 or 400); `amb key FILE` makes one",
      path, why, kDigits));
}

}  // namespace

SealingKey::~SealingKey() { sodium_memzero(secret_.data(), secret_.size()); }

SealingKey::Seal SealingKey::SealOf(std::span<const std::uint8_t> text) const noexcept {
  Seal seal{};
  crypto_generichash(seal.data(), seal.size(), text.data(), text.size(), secret_.data(),
                     secret_.size());
  return seal;
}

bool SealingKey::Made(std::span<const std::uint8_t> seal,
                      std::span<const std::uint8_t> text) const noexcept {
  const Seal right = SealOf(text);
  return seal.size() == right.size() && sodium_memcmp(right.data(), seal.data(), right.size()) == 0;
}

NetworkKey::NetworkKey(const SealingKey::Bytes& secret, std::string path)
    : master_(secret), path_(std::move(path)) {
  Prepare();
}

std::shared_ptr<const NetworkKey> NetworkKey::Load(const std::string& path) {
  PrivateFile file = ReadPrivateFile(path, kDigits + 2);  // a line end, and one to see more
  if (!file.refused.empty()) RefuseKey(path, file.refused);
  std::string& digits = file.content;
  const bool line_end = digits.size() == kDigits + 1 && digits[kDigits] == '\n';
  SealingKey::Bytes secret{};
  std::size_t bytes = 0;
  if ((digits.size() != kDigits && !line_end) ||
      sodium_hex2bin(secret.data(), secret.size(), digits.data(), kDigits, nullptr, &bytes,
                     nullptr) != 0 ||
      bytes != secret.size()) {
    sodium_memzero(digits.data(), digits.size());
    sodium_memzero(secret.data(), secret.size());
    RefuseKey(path, fmt::format("its content is not {} hexadecimal digits on one line", kDigits));
  }
  auto key = std::make_shared<const NetworkKey>(secret, path);
  sodium_memzero(digits.data(), digits.size());
  sodium_memzero(secret.data(), secret.size());
  return key;
}

void NetworkKey::Make(const std::string& path) {
  Prepare();
  const FileDescriptor file(
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (file.handle() < 0) {
    throw BadInput(fmt::format("key file {}: {}; a key is never written over another file", path,
                               std::strerror(errno)));
  }
  SealingKey::Bytes secret{};
  randombytes_buf(secret.data(), secret.size());
  std::array<char, kDigits + 1> digits{};
  sodium_bin2hex(digits.data(), digits.size(), secret.data(), secret.size());
  digits[kDigits] = '\n';
  const bool written =
      write(file.handle(), digits.data(), digits.size()) == static_cast<ssize_t>(digits.size()) &&
      fsync(file.handle()) == 0;
  sodium_memzero(digits.data(), digits.size());
  sodium_memzero(secret.data(), secret.size());
  if (!written) {
    unlink(path.c_str());
    throw Problem(ExitStatus::kOther, fmt::format("key file {}: it could not be written", path));
  }
}

SealingKey NetworkKey::For(const std::string& name) const noexcept {
  const std::string text = "levitas network key 1 " + name;
  SealingKey::Bytes derived{};
  const auto half = [&](const char* which, std::size_t at) {
    const std::string part = text + which;
    const SealingKey::Seal seal =
        master_.SealOf({reinterpret_cast<const std::uint8_t*>(part.data()), part.size()});
    std::memcpy(derived.data() + at, seal.data(), seal.size());
  };
  half(" a", 0);
  half(" b", SealingKey::kSealBytes);
  return SealingKey(derived);
}

}  // namespace levitas::transport
