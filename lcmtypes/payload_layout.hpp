#pragma once
// The layout of a message's bytes, and whether given bytes have it.
//
// Why      LCM's generated decoders believe every count and length that they read: a wrong one
//          makes them ask for gigabytes, throw, or read beyond the bytes. So bytes from a file or
//          from the network are walked along the type's layout first, and decoded only if they fit.
// Fits     every count lies in 0 .. its @max of the .lcm file, every text ends with its only zero,
//          and the last piece ends with the last byte.
// Source   the layouts are written from lcmtypes/*.lcm by cmake/lcm_layouts.py at build time.
// Thread   any; no state, no allocation, no exception; it never reads beyond the payload.
// Not done the type's hash: the decoder compares it before it reads anything.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace levitas::message {

struct Piece {
  enum class Kind : std::uint8_t { kBytes, kCount, kArray, kText, kTexts } kind;
  std::uint8_t slot;    ///< which count: the one that is read, or that says how many
  std::uint32_t bytes;  ///< of the whole piece, or of one element of an array
  std::uint32_t max;    ///< of a count
};

constexpr Piece BytesPiece(std::uint32_t bytes) { return {Piece::Kind::kBytes, 0, bytes, 0}; }
constexpr Piece CountPiece(std::uint8_t slot, std::uint32_t max) {
  return {Piece::Kind::kCount, slot, 4, max};
}
constexpr Piece ArrayPiece(std::uint8_t slot, std::uint32_t bytes) {
  return {Piece::Kind::kArray, slot, bytes, 0};
}
constexpr Piece TextPiece() { return {Piece::Kind::kText, 0, 0, 0}; }
constexpr Piece TextsPiece(std::uint8_t slot) { return {Piece::Kind::kTexts, slot, 0, 0}; }

/// Specialised for every message by levitas_msg/layouts.hpp.
template <class Message>
inline constexpr std::array<Piece, 0> kLayout{};

inline constexpr std::size_t kMaxCounts = 4;
inline constexpr std::size_t kHashBytes = 8;

/// The bytes that are not walked over yet.
class Rest {
 public:
  explicit Rest(std::span<const std::uint8_t> bytes) noexcept : bytes_(bytes) {}

  [[nodiscard]] bool empty() const noexcept { return bytes_.empty(); }

  [[nodiscard]] bool Skip(std::uint64_t count) noexcept {
    if (count > bytes_.size()) return false;
    bytes_ = bytes_.subspan(static_cast<std::size_t>(count));
    return true;
  }

  [[nodiscard]] bool Read(std::uint32_t& word) noexcept {
    if (bytes_.size() < 4) return false;
    word = 0;
    for (const std::uint8_t byte : bytes_.first(4)) word = word << 8U | byte;
    return Skip(4);
  }

  /// A length of at least 1, then a text with its zero at its end and nowhere else.
  [[nodiscard]] bool SkipText() noexcept {
    std::uint32_t length = 0;
    if (!Read(length) || length < 1 || length > bytes_.size()) return false;
    const auto text = bytes_.first(length);
    return std::find(text.begin(), text.end(), 0) == text.end() - 1 && Skip(length);
  }

  [[nodiscard]] bool SkipTexts(std::uint32_t count) noexcept {
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!SkipText()) return false;
    }
    return true;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Whether `payload`, hash included, is exactly as long as `layout` and its own counts say.
[[nodiscard]] inline bool Fits(std::span<const Piece> layout,
                               std::span<const std::uint8_t> payload) noexcept {
  std::array<std::uint32_t, kMaxCounts> counts{};
  Rest rest(payload);
  bool good = rest.Skip(kHashBytes);
  for (const Piece& piece : layout) {
    if (!good) return false;
    std::uint32_t& count = counts[piece.slot];
    switch (piece.kind) {
      case Piece::Kind::kBytes:
        good = rest.Skip(piece.bytes);
        break;
      case Piece::Kind::kCount:  // a negative one is a large one here
        good = rest.Read(count) && count <= piece.max;
        break;
      case Piece::Kind::kArray:
        good = rest.Skip(std::uint64_t{count} * piece.bytes);
        break;
      case Piece::Kind::kText:
        good = rest.SkipText();
        break;
      case Piece::Kind::kTexts:
        good = rest.SkipTexts(count);
        break;
    }
  }
  return good && rest.empty();
}

}  // namespace levitas::message
