#include "session/log/log_scanner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "session/log/log_format.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using Look = LogScanner::Look;

std::string EventBytes(const std::string& channel, const std::string& data,
                       std::int64_t number = 0) {
  std::string bytes(kEventHeaderBytes, '\0');
  std::array<std::uint8_t, kEventHeaderBytes> header{};
  PutEventHeader(header.data(), {.number = number,
                                 .time_us = 77,
                                 .channel_bytes = static_cast<std::int32_t>(channel.size()),
                                 .data_bytes = static_cast<std::int32_t>(data.size())});
  std::copy(header.begin(), header.end(), bytes.begin());
  return bytes + channel + data;
}

class Scanning : public ::testing::Test {
 protected:
  LogScanner& Over(const std::string& content) {
    WriteFile(path_, content);
    scanner_.emplace(path_);
    return *scanner_;
  }
  Folder folder_;
  std::string path_{folder_ / "log"};
  std::optional<LogScanner> scanner_;
  RawEvent event_;
};

// The layout of LCM's documentation, byte by byte.
TEST(EventHeader, IsBigEndianInTheDocumentedOrder) {
  const std::string bytes = EventBytes("AB", "xyz", 0x0102030405060708);
  EXPECT_EQ(bytes.substr(0, 12), std::string("\xED\xA1\xDA\x01\1\2\3\4\5\6\7\10", 12));
  EXPECT_EQ(bytes.substr(12, 16), std::string("\0\0\0\0\0\0\0\x4D\0\0\0\2\0\0\0\3", 16));
  EXPECT_EQ(bytes.substr(28), "ABxyz");
}

TEST_F(Scanning, GivesChannelDataAndTimeOfEachEvent) {
  LogScanner& scanner = Over(EventBytes("ONE", "first") + EventBytes("TWO", ""));
  ASSERT_EQ(scanner.At(event_), Look::kEvent);
  EXPECT_EQ(event_.channel, "ONE");
  EXPECT_EQ(std::string(event_.data.begin(), event_.data.end()), "first");
  EXPECT_EQ(event_.time_us, 77);
  EXPECT_EQ(event_.offset, 0U);
  scanner.MoveTo(event_.end);
  ASSERT_EQ(scanner.At(event_), Look::kEvent);
  EXPECT_EQ(event_.channel, "TWO");
  EXPECT_TRUE(event_.data.empty());
  scanner.MoveTo(event_.end);
  EXPECT_EQ(scanner.At(event_), Look::kEnd);
}

TEST_F(Scanning, TellsACutOffEventFromOneThatIsNone) {
  const std::string whole = EventBytes("ONE", "first");
  for (std::size_t size = 1; size < whole.size(); ++size) {
    EXPECT_EQ(Over(whole.substr(0, size)).At(event_), Look::kCutOff) << size;
  }
  EXPECT_EQ(Over("rubbish").At(event_), Look::kNotEvent);
  EXPECT_EQ(Over(std::string(100, '\xED')).At(event_), Look::kNotEvent);
}

TEST_F(Scanning, RefusesLengthsNobodyWrites) {
  for (const std::int32_t length : {-1, 0, 64, 0x7FFFFFFF}) {
    std::string bytes = EventBytes("ONE", "first") + std::string(1000, ' ');
    std::array<std::uint8_t, 4> word{};
    PutBigEndian(word.data(), length);
    std::copy(word.begin(), word.end(), bytes.begin() + 20);
    EXPECT_EQ(Over(bytes).At(event_), Look::kNotEvent) << length;
  }
}

TEST_F(Scanning, FindsASyncWordAcrossTheEdgeOfItsWindow) {
  // The search takes quarters of a mebibyte, the window is one: every alignment near both edges.
  for (const std::size_t edge : {std::size_t{1} << 18, std::size_t{1} << 20}) {
    for (std::size_t before = 0; before <= 5; ++before) {
      const std::size_t at = edge - before;
      LogScanner& scanner = Over(std::string(at, 'x') + EventBytes("ONE", "first"));
      ASSERT_TRUE(scanner.SkipToSync());
      EXPECT_EQ(scanner.offset(), at);
      EXPECT_EQ(scanner.At(event_), Look::kEvent);
    }
  }
}

TEST_F(Scanning, SkipsToTheEndWhenThereIsNoSyncWord) {
  LogScanner& scanner = Over(std::string(3'000'000, 'x'));
  EXPECT_FALSE(scanner.SkipToSync());
  EXPECT_EQ(scanner.offset(), 3'000'000U);
  EXPECT_EQ(scanner.At(event_), Look::kEnd);
}

TEST_F(Scanning, ReadsAnEventLongerThanItsWindow) {
  const std::string data(3'000'000, 'd');
  LogScanner& scanner = Over(EventBytes("ONE", "x") + EventBytes("BIG", data));
  ASSERT_EQ(scanner.At(event_), Look::kEvent);
  scanner.MoveTo(event_.end);
  ASSERT_EQ(scanner.At(event_), Look::kEvent);
  EXPECT_EQ(event_.data.size(), data.size());
  EXPECT_EQ(event_.data.back(), 'd');
  scanner.MoveTo(0);
  ASSERT_EQ(scanner.At(event_), Look::kEvent);
  EXPECT_EQ(event_.channel, "ONE");
}

}  // namespace
}  // namespace levitas::session
