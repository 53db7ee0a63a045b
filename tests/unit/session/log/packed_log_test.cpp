// Packed sessions: the same log as the plain ones, whatever is cut off or damaged of them.

#include "session/log/packed_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <numeric>

#include "common/problem.hpp"
#include "session/log/log_scanner.hpp"
#include "session/log/repack.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// By the library in one go, as somebody else's program would.
std::string UnpackedByZstd(const std::string& packed, std::size_t most) {
  std::string plain(most, '\0');
  const std::size_t size =
      ZSTD_decompress(plain.data(), plain.size(), packed.data(), packed.size());
  EXPECT_EQ(ZSTD_isError(size), 0U) << ZSTD_getErrorName(size);
  plain.resize(ZSTD_isError(size) != 0 ? 0 : size);
  return plain;
}

/// Where the frames of a packed file begin.
std::vector<std::size_t> FramesOf(const std::string& packed) {
  std::vector<std::size_t> starts;
  for (std::size_t at = 0; at < packed.size();) {
    starts.push_back(at);
    const std::size_t size = ZSTD_findFrameCompressedSize(packed.data() + at, packed.size() - at);
    EXPECT_EQ(ZSTD_isError(size), 0U);
    if (ZSTD_isError(size) != 0) break;
    at += size;
  }
  return starts;
}

class Packed : public ::testing::Test {
 protected:
  // Of some 450 bytes each, so that there are several frames.
  static constexpr std::size_t kRecords = 30'000;

  void SetUp() override {
    WriteSession(plain_path_, records_);
    WriteSession(path_, records_);
    plain_ = ReadFile(plain_path_);
    packed_ = ReadFile(path_);
  }

  /// The cycles that a file of this content gives, each with the bits that were written.
  std::vector<std::uint64_t> CyclesOf(const std::string& content) {
    WriteFile(path_, content);
    SessionReader reader(path_);
    std::vector<std::uint64_t> cycles;
    for (const auto& record : ReadAll(reader)) {
      EXPECT_TRUE(SameBits(record, records_.at(record.in.cycle))) << record.in.cycle;
      cycles.push_back(record.in.cycle);
    }
    damage_ = reader.damage();
    return cycles;
  }

  Folder folder_;
  std::string plain_path_{folder_ / "s.lcm"};
  std::string path_{folder_ / "s.lcm.zst"};
  std::vector<cycle::CycleRecord> records_{DrawRecords(kRecords)};
  std::string plain_;
  std::string packed_;
  Damage damage_;
};

TEST_F(Packed, IsThePlainLogByteForByte) {
  EXPECT_TRUE(UnpackedByZstd(packed_, plain_.size() + 1) == plain_);
  EXPECT_LT(packed_.size(), plain_.size());
  EXPECT_GE(FramesOf(packed_).size(), 3U);
}

TEST_F(Packed, GivesEveryRecordAndNoDamage) {
  EXPECT_EQ(CyclesOf(packed_).size(), kRecords);
  EXPECT_FALSE(damage_.any()) << damage_.Text();
}

TEST_F(Packed, IsToldByItsBytesWhateverItsName) {
  const std::string other = folder_ / "s.lcm";
  WriteFile(other, packed_);
  SessionReader reader(other);
  EXPECT_EQ(ReadAll(reader).size(), kRecords);
  EXPECT_TRUE(IsPacked(other));
}

TEST_F(Packed, EveryFrameBeginsWithAnEvent) {
  for (const std::size_t start : FramesOf(packed_)) {
    const std::string path = folder_ / "tail.lcm.zst";
    WriteFile(path, packed_.substr(start));
    LogScanner scanner(path);
    RawEvent event;
    EXPECT_EQ(scanner.At(event), LogScanner::Look::kEvent) << start;
  }
}

TEST_F(Packed, CutOffAnywhereIsReadUpToItsLastCompleteBlock) {
  std::size_t before = 0;
  for (int part = 1; part <= 20; ++part) {
    const std::size_t size = packed_.size() * static_cast<std::size_t>(part) / 20 - 1;
    const auto cycles = CyclesOf(packed_.substr(0, size));
    std::vector<std::uint64_t> expected(cycles.size());
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(cycles, expected);
    // A block of zstd holds at most 128 KiB of the log; what comes before the cut is not lost.
    const double share = static_cast<double>(size) / static_cast<double>(packed_.size());
    EXPECT_GT(static_cast<double>(cycles.size()), (share - 0.1) * kRecords);
    EXPECT_GE(cycles.size(), before);
    before = cycles.size();
    EXPECT_TRUE(damage_.truncated);
    EXPECT_THAT(damage_.Text(), HasSubstr("up to its last complete"));
  }
}

TEST_F(Packed, DamageInOneFrameCostsNoOther) {
  const auto starts = FramesOf(packed_);
  ASSERT_GE(starts.size(), 3U);
  std::string content = packed_;
  const std::size_t middle = (starts[1] + starts[2]) / 2;
  std::fill_n(content.begin() + static_cast<std::ptrdiff_t>(middle), 5000, '\x55');
  const auto cycles = CyclesOf(content);
  EXPECT_EQ(damage_.corrupt_blocks, 1U);
  EXPECT_GT(damage_.missing_cycles, 0U);
  EXPECT_EQ(cycles.size() + damage_.missing_cycles, kRecords);
  EXPECT_EQ(cycles.back(), kRecords - 1);
  // A third of the log at most lies in that frame; the first half of the frame is read, too.
  EXPECT_GT(cycles.size(), kRecords / 2);
  EXPECT_THAT(damage_.Text(), HasSubstr("1 damaged packed block(s)"));
}

TEST_F(Packed, AFileWhoseFirstBytesAreLostIsReadFromItsNextFrame) {
  std::string content = packed_;
  std::fill_n(content.begin(), 64, '\0');
  const auto cycles = CyclesOf(content);
  ASSERT_FALSE(cycles.empty());
  EXPECT_EQ(cycles.back(), kRecords - 1);
  EXPECT_GE(damage_.corrupt_blocks, 1U);
}

// A word of the header alone decides whether zstd takes anything of a frame at all.
TEST_F(Packed, AFrameWhoseHeaderIsNotUnderstoodCostsNoOther) {
  constexpr std::size_t kFew = 40;
  WriteSession(plain_path_, DrawRecords(kFew));
  const std::string plain = ReadFile(plain_path_);
  const auto frame_of = [](const std::string& part) {
    std::string frame(ZSTD_compressBound(part.size()), '\0');
    frame.resize(ZSTD_compress(frame.data(), frame.size(), part.data(), part.size(), 1));
    return frame;
  };
  const std::string first = frame_of(plain.substr(0, plain.size() / 2));
  const std::string second = frame_of(plain.substr(plain.size() / 2));
  constexpr std::size_t kDescriptor = 4;  // behind the four bytes by which a frame is known
  for (int value = 0; value < 256; ++value) {
    std::string content = first + second;
    content[first.size() + kDescriptor] = static_cast<char>(value);
    const auto before = CyclesOf(content);
    EXPECT_GE(before.size(), kFew / 3) << value;
    content = first + second;
    content[kDescriptor] = static_cast<char>(value);
    const auto behind = CyclesOf(content);
    ASSERT_GE(behind.size(), kFew / 3) << value;
    EXPECT_EQ(behind.back(), kFew - 1) << value;
  }
}

TEST_F(Packed, WhatFollowsTheLastFrameIsCountedAndCostsNothing) {
  EXPECT_EQ(CyclesOf(packed_ + std::string(10'000, '\0')).size(), kRecords);
  EXPECT_GE(damage_.corrupt_blocks, 1U);
}

TEST_F(Packed, ThatUnpacksWithoutEndIsRefused) {
  // 160 MiB of zeros, which a small file claims to be a session.
  const std::string zeros(std::size_t{160} << 20, '\0');
  std::string small(ZSTD_compressBound(zeros.size()), '\0');
  small.resize(ZSTD_compress(small.data(), small.size(), zeros.data(), zeros.size(), 1));
  WriteFile(path_, small);
  try {
    const SessionReader reader(path_);
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    EXPECT_THAT(problem.what(), HasSubstr("no session packs so well"));
  }
}

TEST_F(Packed, ByAnotherProgramInOneFrameIsReadAsWell) {
  std::string other(ZSTD_compressBound(plain_.size()), '\0');
  other.resize(ZSTD_compress(other.data(), other.size(), plain_.data(), plain_.size(), 1));
  EXPECT_EQ(CyclesOf(other).size(), kRecords);
  EXPECT_FALSE(damage_.any()) << damage_.Text();
}

TEST_F(Packed, IsRepackedWithoutLosingAByte) {
  const std::string again = folder_ / "again.lcm.zst";
  const std::string back = folder_ / "back.lcm";
  const RepackReport packed = Repack(plain_path_, again);
  EXPECT_EQ(packed.log_bytes, plain_.size());
  EXPECT_EQ(packed.out_bytes, ReadFile(again).size());
  EXPECT_EQ(Repack(again, back).log_bytes, plain_.size());
  EXPECT_TRUE(ReadFile(back) == plain_);
}

TEST_F(Packed, DamageOfThePlainLogIsPackedAsItIs) {
  std::string damaged = plain_;
  std::fill_n(damaged.begin() + 100'000, 3000, '\xEE');
  damaged.resize(damaged.size() - 7);
  WriteFile(plain_path_, "rubbish" + damaged);
  const std::string packed = folder_ / "p.lcm.zst";
  EXPECT_EQ(Repack(plain_path_, packed).log_bytes, damaged.size() + 7);
  EXPECT_TRUE(UnpackedByZstd(ReadFile(packed), damaged.size() + 8) == "rubbish" + damaged);
}

TEST(Packing, HandsOnWhatItWasGivenAtOnce) {
  Packer packer(kRecordingLevel);
  std::vector<std::uint8_t> out;
  std::string all;
  const std::string text = "an event that a reader may want now";
  const void* bytes = text.data();
  packer.Pack({static_cast<const std::uint8_t*>(bytes), text.size()}, out);
  all.assign(out.begin(), out.end());
  // Without the end of the frame: what is there can be unpacked.
  const Folder folder;
  WriteFile(folder / "x.zst", all);
  LogScanner scanner(folder / "x.zst");
  const auto got = scanner.Bytes(0, 1000);
  EXPECT_EQ(std::string(got.begin(), got.end()), text);
  ASSERT_NE(scanner.packed(), nullptr);
  EXPECT_TRUE(scanner.packed()->cut_off());
}

}  // namespace
}  // namespace levitas::session
