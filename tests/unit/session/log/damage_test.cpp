// Damage injected into real session files: what stood before it is always given back, bit for bit,
// what stands behind it too, and the reader says what was lost.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "common/crc32.hpp"
#include "common/problem.hpp"
#include "session/log/log_format.hpp"
#include "session/log/log_scanner.hpp"
#include "session/log/record_codec.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

class Damaged : public ::testing::Test {
 protected:
  void SetUp() override {
    WriteSession(path_, records_);
    sound_ = ReadFile(path_);
    LogScanner scanner(path_);
    RawEvent event;
    while (scanner.At(event) == LogScanner::Look::kEvent) {
      if (event.channel == kCycleChannel) offsets_.push_back(event.offset);
      ends_.push_back(event.end);
      scanner.MoveTo(event.end);
    }
    ASSERT_EQ(offsets_.size(), records_.size());
  }

  /// Reads the damaged content and checks that only sound records come out, in order.
  std::vector<std::uint64_t> CyclesOf(const std::string& content) {
    WriteFile(path_, content);
    SessionReader reader(path_);
    std::vector<std::uint64_t> cycles;
    for (const auto& record : ReadAll(reader)) {
      EXPECT_LT(record.in.cycle, records_.size());
      EXPECT_TRUE(SameBits(record, records_[record.in.cycle])) << "cycle " << record.in.cycle;
      cycles.push_back(record.in.cycle);
    }
    damage_ = reader.damage();
    return cycles;
  }

  /// 0 .. count-1 without `from` .. `to` (exclusive).
  std::vector<std::uint64_t> AllBut(std::uint64_t from, std::uint64_t to) {
    std::vector<std::uint64_t> cycles;
    for (std::uint64_t i = 0; i < records_.size(); ++i) {
      if (i < from || i >= to) cycles.push_back(i);
    }
    return cycles;
  }

  std::string Refusal(const std::string& content) {
    WriteFile(path_, content);
    try {
      const SessionReader reader(path_);
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  }

  Folder folder_;
  std::string path_{folder_ / "s.lcmlog"};
  std::vector<cycle::CycleRecord> records_{DrawRecords(60)};
  std::string sound_;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::uint64_t> ends_;
  Damage damage_;
};

TEST_F(Damaged, TruncationAtEveryByteOfARecordLosesThatRecordOnly) {
  for (std::uint64_t cut = offsets_[30] + 1; cut < offsets_[31]; ++cut) {
    EXPECT_EQ(CyclesOf(sound_.substr(0, cut)), AllBut(30, 60)) << "cut at " << cut;
    EXPECT_TRUE(damage_.truncated) << "cut at " << cut;
    EXPECT_EQ(damage_.first_bad_offset, offsets_[30]);
  }
  EXPECT_THAT(damage_.Text(), HasSubstr("ends inside a record"));
}

TEST_F(Damaged, TruncationBetweenRecordsIsNoDamage) {
  EXPECT_EQ(CyclesOf(sound_.substr(0, offsets_[30])), AllBut(30, 60));
  EXPECT_FALSE(damage_.any());
}

TEST_F(Damaged, ZeroedBlockLosesTheRecordsItTouchesOnly) {
  std::string content = sound_;
  std::fill(content.begin() + static_cast<long>(offsets_[20] + 5),
            content.begin() + static_cast<long>(offsets_[25] + 5), '\0');
  EXPECT_EQ(CyclesOf(content), AllBut(20, 26));
  EXPECT_EQ(damage_.missing_cycles, 6U);
  EXPECT_EQ(damage_.corrupt_bytes, offsets_[26] - offsets_[20]);
  EXPECT_EQ(damage_.first_bad_offset, offsets_[20]);
  EXPECT_THAT(damage_.Text(), HasSubstr("6 cycle(s) missing"));
}

TEST_F(Damaged, AnyFlippedBitOfARecordsDataLosesThatRecordOnly) {
  const std::uint64_t data = offsets_[40] + kEventHeaderBytes + kCycleChannel.size();
  for (std::uint64_t byte = data; byte < offsets_[41]; ++byte) {
    std::string content = sound_;
    content[byte] = static_cast<char>(content[byte] ^ (1 << (byte % 8)));
    ASSERT_EQ(CyclesOf(content), AllBut(40, 41)) << "byte " << byte - offsets_[40];
    EXPECT_EQ(damage_.corrupt_records, 1U);
    EXPECT_EQ(damage_.first_bad_offset, offsets_[40]);
  }
}

TEST_F(Damaged, AnyLengthLosesThatRecordOnly) {
  // Among them: negative, zero, one event too long (swallows the next), far too long.
  const auto data_bytes =
      static_cast<std::int32_t>(offsets_[11] - offsets_[10] - kEventHeaderBytes - 13);
  const auto event_bytes = static_cast<std::int32_t>(offsets_[11] - offsets_[10]);
  for (const std::int32_t length :
       {0, 1, -1, data_bytes - 1, data_bytes + 1, data_bytes + event_bytes,
        data_bytes + 5 * event_bytes, 1 << 20, 0x7FFFFFFF}) {
    std::string content = sound_;
    std::uint8_t bytes[4];
    PutBigEndian(bytes, length);
    std::copy_n(bytes, 4, content.begin() + static_cast<long>(offsets_[10] + 24));
    EXPECT_EQ(CyclesOf(content), AllBut(10, 11)) << "length " << length;
    EXPECT_TRUE(damage_.any());
    EXPECT_FALSE(damage_.truncated);
  }
}

TEST_F(Damaged, DamagedChannelNameIsNoticed) {
  std::string content = sound_;
  content[offsets_[59] + kEventHeaderBytes + 9] = 'X';
  EXPECT_EQ(CyclesOf(content), AllBut(59, 60));
  EXPECT_EQ(damage_.corrupt_records, 1U);
}

TEST_F(Damaged, RepeatedBlockIsGivenBackOnce) {
  const std::string block = sound_.substr(offsets_[10], offsets_[15] - offsets_[10]);
  std::string content = sound_;
  content.insert(offsets_[20], block);
  EXPECT_EQ(CyclesOf(content), AllBut(60, 60));
  EXPECT_EQ(damage_.corrupt_records, 5U);
  EXPECT_EQ(damage_.missing_cycles, 0U);
}

TEST_F(Damaged, GarbageInFrontAndBehindIsSkipped) {
  EXPECT_EQ(CyclesOf("garbage" + sound_ + "more garbage"), AllBut(60, 60));
  EXPECT_EQ(damage_.corrupt_bytes, 7U + 12U);
}

TEST_F(Damaged, HeaderIsFoundInItsCopy) {
  std::string content = sound_;
  content[60] = static_cast<char>(content[60] ^ 4);
  EXPECT_EQ(CyclesOf(content), AllBut(60, 60));
  EXPECT_EQ(damage_.corrupt_records, 1U);
  EXPECT_EQ(damage_.first_bad_offset, 0U);
}

TEST_F(Damaged, HeaderWithoutACopyIsRefused) {
  std::string content = sound_.substr(0, ends_[ends_.size() - 2]);
  content[60] = static_cast<char>(content[60] ^ 4);
  EXPECT_THAT(Refusal(content), HasSubstr("header is damaged and no sound copy"));
}

TEST_F(Damaged, FilesThatAreNoSessionsAreRefusedWithTheReason) {
  EXPECT_THAT(Refusal(""), HasSubstr("the file is empty"));
  EXPECT_THAT(Refusal("time_s,position\n0,1\n"), HasSubstr("not a session: there is no LCM log"));
  EXPECT_THAT(Refusal(std::string(100'000, '\0')), HasSubstr("not a session"));
  EXPECT_THAT(Refusal(sound_.substr(0, 20)), HasSubstr("not a session"));
  // A log of records only, as lcm-logger might have made it.
  const std::string headless = sound_.substr(offsets_[0], offsets_[10] - offsets_[0]);
  EXPECT_THAT(Refusal(headless), HasSubstr("an LCM log without a LEVITAS_HEADER event"));
}

TEST_F(Damaged, MissingFileAndFolderAreRefusedWithTheReason) {
  EXPECT_THROW(SessionReader(folder_ / "absent.lcmlog"), BadInput);
  try {
    const SessionReader reader(folder_ / "");
    FAIL();
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("it is not a file"));
  }
}

TEST_F(Damaged, OtherFormatVersionIsRefusedByItsNumber) {
  // The same header with version 2 and a CRC that fits.
  Bytes bytes;
  EncodeHeader(Header(), bytes);
  PutBigEndian<std::int32_t>(bytes.data() + 8, 2);
  std::fill(bytes.end() - 4, bytes.end(), std::uint8_t{0});
  PutBigEndian(bytes.data() + bytes.size() - 4, Crc32(bytes.data(), bytes.size()));
  std::string content = sound_;
  std::copy(bytes.begin(), bytes.end(),
            content.begin() + static_cast<long>(kEventHeaderBytes + kHeaderChannel.size()));
  EXPECT_THAT(Refusal(content),
              HasSubstr("session format version 2, this program reads version 1"));
}

/// One random mutation of `content`; returns the first byte it touched.
std::uint64_t Mutate(Random& draw, std::string& content) {
  const auto at = static_cast<std::size_t>(draw.Bits() % content.size());
  const auto length = static_cast<std::size_t>(draw.Bits() % 2000);
  switch (draw.Bits() % 6) {
    case 0:
      content[at] = static_cast<char>(content[at] ^ (1 << (draw.Bits() % 8)));
      break;
    case 1:
      content.resize(at);
      break;
    case 2:
      content.erase(at, length);
      break;
    case 3:
      content.replace(at, std::min(length, content.size() - at),
                      std::min(length, content.size() - at), '\0');
      break;
    case 4:
      for (std::size_t i = at; i < std::min(at + length, content.size()); ++i) {
        content[i] = static_cast<char>(draw.Bits());
      }
      break;
    default:
      content.insert(at, content.substr(static_cast<std::size_t>(draw.Bits() % (at + 1)), length));
  }
  return at;
}

TEST_F(Damaged, NoRandomMutationCrashesOrCostsARecordBeforeIt) {
  Random draw{20261121};
  for (int trial = 0; trial < 500; ++trial) {
    std::string content = sound_;
    std::uint64_t first = content.size();
    const auto mutations = 1 + draw.Bits() % 3;
    for (std::uint64_t i = 0; i < mutations && content.size() > 100; ++i) {
      first = std::min(first, Mutate(draw, content));
    }
    std::vector<std::uint64_t> cycles;
    try {
      cycles = CyclesOf(content);
    } catch (const BadInput&) {
      // Allowed only when the first header was hit: without it, and without its copy at the end,
      // nothing can be said about the records.
      ASSERT_LT(first, ends_[0]) << "trial " << trial;
      continue;
    }
    std::uint64_t sound_before = 0;
    while (sound_before < offsets_.size() && ends_[sound_before + 1] <= first) ++sound_before;
    ASSERT_GE(cycles.size(), sound_before) << "trial " << trial;
    for (std::uint64_t i = 0; i < sound_before; ++i) ASSERT_EQ(cycles[i], i) << "trial " << trial;
  }
}

}  // namespace
}  // namespace levitas::session
