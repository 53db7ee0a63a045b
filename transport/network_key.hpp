#pragma once
// The secret that those share who may speak on one network, and what is made of it.
//
// File     kBytes random bytes as hexadecimal digits on one line; a regular file of this user or of
//          root that nobody else may read or write. docs/dashboard.md.
// Seal     a keyed BLAKE2b of kSealBytes (libsodium, no allocation), with a key of its own for each
//          group and port: what was said on one port is worth nothing on another.
// Thread   after construction any; const.
// Failure  Load and Make: BadInput (exit status 3) with the remedy. The memory of the key is wiped.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace levitas::transport {

class SealingKey {
 public:
  static constexpr std::size_t kBytes = 32;
  static constexpr std::size_t kSealBytes = 16;
  using Bytes = std::array<std::uint8_t, kBytes>;
  using Seal = std::array<std::uint8_t, kSealBytes>;

  explicit SealingKey(const Bytes& secret) noexcept : secret_(secret) {}
  ~SealingKey();
  SealingKey(const SealingKey&) = default;
  SealingKey& operator=(const SealingKey&) = default;

  [[nodiscard]] Seal SealOf(std::span<const std::uint8_t> text) const noexcept;
  /// Takes the same time whatever is wrong.
  [[nodiscard]] bool Made(std::span<const std::uint8_t> seal,
                          std::span<const std::uint8_t> text) const noexcept;

 private:
  Bytes secret_;
};

class NetworkKey {
 public:
  [[nodiscard]] static std::shared_ptr<const NetworkKey> Load(const std::string& path);
  /// Writes a new random key to a file that does not exist yet, for this user only.
  static void Make(const std::string& path);

  NetworkKey(const SealingKey::Bytes& secret, std::string path);
  /// The key of one network; `name` is its group and port.
  [[nodiscard]] SealingKey For(const std::string& name) const noexcept;
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  SealingKey master_;
  std::string path_;
};

}  // namespace levitas::transport
