// Session files that were made to harm: checksums right, counts and lengths wrong. Each is one
// clear refusal or one lost record, quickly.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/crc32.hpp"
#include "common/problem.hpp"
#include "session/exchange/export_rows.hpp"
#include "session/log/log_format.hpp"
#include "session/log/record_codec.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

void Sign(Bytes& bytes) {
  std::fill(bytes.end() - 4, bytes.end(), std::uint8_t{0});
  PutBigEndian(bytes.data() + bytes.size() - 4, Crc32(bytes.data(), bytes.size()));
}

/// An event of a log whose length says `claimed` bytes.
std::string LogEvent(std::string_view channel, const Bytes& data, std::size_t claimed) {
  std::string head(kEventHeaderBytes, '\0');
  std::array<std::uint8_t, kEventHeaderBytes> bytes{};
  PutEventHeader(bytes.data(), {.channel_bytes = static_cast<std::int32_t>(channel.size()),
                                .data_bytes = static_cast<std::int32_t>(claimed)});
  std::copy(bytes.begin(), bytes.end(), head.begin());
  return head + std::string(channel) + std::string(data.begin(), data.end());
}
std::string LogEvent(std::string_view channel, const Bytes& data) {
  return LogEvent(channel, data, data.size());
}

Bytes EncodedHeader(const SessionHeader& header = Header()) {
  Bytes bytes;
  EncodeHeader(header, bytes);
  return bytes;
}

Bytes EncodedRecord(std::uint64_t cycle) {
  Random draw{cycle + 1};
  Bytes bytes;
  RecordCodec(4).Encode(DrawRecord(draw, cycle), bytes);
  return bytes;
}

/// Where the count of coil currents stands in a record of four axes.
constexpr std::size_t kCoilsAt =
    8 + (8 + 4 + 1 + 8 + 8 + 4 + 4 + 4 + 4) + 4 * 8 + (8 + 8 + 4 + 1 + 8 + 8) + 2 * 4 * 8;

class HostileFile : public ::testing::Test {
 protected:
  std::string Refusal(const std::string& content) {
    WriteFile(path_, content);
    try {
      SessionReader reader(path_);
      (void)ReadAll(reader);
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "read";
  }
  Folder folder_;
  std::string path_{folder_ / "run.lcm"};
};

TEST_F(HostileFile, ACountOfCoilsThatLiesCostsItsRecordAlone) {
  for (const std::uint32_t lie : {1U, 16U, 17U, 0x20000000U, 0x20000001U, 0x7fffffffU, ~0U}) {
    Bytes bad = EncodedRecord(1);
    ASSERT_EQ(GetBigEndian<std::uint32_t>(bad.data() + kCoilsAt), 0U);
    PutBigEndian(bad.data() + kCoilsAt, lie);
    Sign(bad);
    WriteFile(path_, LogEvent(kHeaderChannel, EncodedHeader()) +
                         LogEvent(kCycleChannel, EncodedRecord(0)) + LogEvent(kCycleChannel, bad) +
                         LogEvent(kCycleChannel, EncodedRecord(2)));
    SessionReader reader(path_);
    EXPECT_EQ(ReadAll(reader).size(), 2U) << lie;
    EXPECT_EQ(reader.damage().corrupt_records, 1U) << lie;
  }
}

TEST_F(HostileFile, AHeaderOfMoreThanEightChannelsIsRefused) {
  for (const std::size_t channels : {9U, 12U, 5000U}) {
    SessionHeader header = Header();
    header.channels.assign(channels, "c");
    EXPECT_THAT(Refusal(LogEvent(kHeaderChannel, EncodedHeader(header)) +
                        LogEvent(kCycleChannel, EncodedRecord(0))),
                HasSubstr("the session's header is damaged"))
        << channels;
  }
}

TEST_F(HostileFile, AHeaderWhoseLengthsLieIsRefused) {
  constexpr std::size_t kFirstTextAt = 8 + 4;
  for (const std::uint32_t lie : {0U, 50'000'000U, 0x7fffffffU, 0x80000000U, ~0U}) {
    Bytes header = EncodedHeader();
    PutBigEndian(header.data() + kFirstTextAt, lie);
    Sign(header);
    EXPECT_THAT(Refusal(LogEvent(kHeaderChannel, header)), HasSubstr("header is damaged")) << lie;
  }
}

TEST_F(HostileFile, APeriodThatIsNoneIsRefused) {
  for (const std::int64_t period_ns : {std::int64_t{0}, std::int64_t{-100'000}, INT64_MIN}) {
    SessionHeader header = Header();
    header.period_ns = period_ns;
    EXPECT_THAT(Refusal(LogEvent(kHeaderChannel, EncodedHeader(header))),
                HasSubstr("sampling period"));
  }
}

// Each of the events claims 4 MB, so that they lie in one another: work for each of them would
// take minutes (the test has the time limit of ctest and no other).
TEST_F(HostileFile, EventsThatClaimOneAnotherAreLookedThroughInOneGo) {
  constexpr std::size_t kEvents = 60'000;
  for (const std::string_view channel : {kHeaderChannel, kCycleChannel, kEventChannel}) {
    std::string content;
    for (std::size_t i = 0; i < kEvents; ++i) content += LogEvent(channel, {}, kMaxDataBytes);
    content += std::string(kMaxDataBytes, '\0');
    EXPECT_NE(Refusal(content), "read");
    const std::string sound =
        LogEvent(kHeaderChannel, EncodedHeader()) + LogEvent(kCycleChannel, EncodedRecord(0));
    WriteFile(path_, content + sound);
    SessionReader reader(path_);
    EXPECT_EQ(ReadAll(reader).size(), 1U) << "what follows is still found";
  }
}

TEST(ExportTime, OfStampsThatNoRigGivesIsSomethingAndNotUndefined) {
  SessionHeader header = Header();
  header.pace = "realtime";
  ExportRows rows(header);
  std::vector<double> values;
  cycle::CycleRecord record;
  record.in.frame.sample_time_ns = INT64_MIN;
  EXPECT_EQ(rows.Next(record, values), 0);
  record.in.frame.rig_session = 1;
  record.in.cycle = UINT64_MAX;
  record.in.frame.sample_time_ns = INT64_MAX;
  EXPECT_EQ(rows.Next(record, values), -header.period_ns) << "a count that went back by one";
}

}  // namespace
}  // namespace levitas::session
