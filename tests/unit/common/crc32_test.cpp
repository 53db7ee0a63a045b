#include "common/crc32.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace levitas {
namespace {

// Check values of the CRC catalogue for CRC-32/ISO-HDLC, and of zlib's documentation.
TEST(Crc32, EqualsTheCatalogueCheckValue) {
  constexpr std::string_view text = "123456789";
  EXPECT_EQ(Crc32(text.data(), text.size()), 0xCBF43926U);
  EXPECT_EQ(Crc32(text.data(), 0), 0U);
}

TEST(Crc32, ContinuesOverPiecesOfAnyLength) {
  constexpr std::string_view text = "the quick brown rotor";
  const std::uint32_t whole = Crc32(text.data(), text.size());
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    const std::uint32_t first = Crc32(text.data(), cut);
    EXPECT_EQ(Crc32(text.data() + cut, text.size() - cut, first), whole) << "cut at " << cut;
  }
}

}  // namespace
}  // namespace levitas
