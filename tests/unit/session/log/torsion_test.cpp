// Measured torsion in a session: every bit comes back, its place in the file does not depend on how
// far behind the recorder is, and damage to it costs no record.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lcmtypes/torsion/torsion_codec.hpp"
#include "session/log/log_format.hpp"
#include "session/log/log_scanner.hpp"
#include "session/log/record_codec.hpp"
#include "session/log/recorder.hpp"
#include "session/log/torsion_recording.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;

constexpr std::uint32_t kRig = 0x8000'0001U;  // as DrawRecord has it

TorsionBatch DrawBatch(Random& draw, std::uint64_t first_cycle, std::uint32_t samples = 32) {
  TorsionBatch batch{
      .first_cycle = first_cycle, .rig_session = kRig, .couplings = 2, .samples = samples};
  for (std::size_t i = 0; i < std::size_t{2} * samples; ++i) {
    batch.torque_n_m[i] = draw.Normal();
    batch.twist_rad[i] = 1e-4 * draw.Normal();
  }
  return batch;
}

bool Same(const TorsionBatch& a, const TorsionBatch& b) {
  return a.first_cycle == b.first_cycle && a.rig_session == b.rig_session &&
         a.couplings == b.couplings && a.samples == b.samples && a.torque_n_m == b.torque_n_m &&
         a.twist_rad == b.twist_rad;
}

std::vector<std::uint8_t> Encoded(const TorsionBatch& batch) {
  TorsionCodec codec;
  std::vector<std::uint8_t> bytes(TorsionCodec::LargestSize());
  bytes.resize(codec.Encode(batch, bytes));
  return bytes;
}

TEST(TorsionCodec, GivesEveryBitBack) {
  Random draw{11};
  for (const std::uint32_t samples : {1U, 7U, 32U}) {
    const TorsionBatch batch = DrawBatch(draw, draw.Bits() >> 2, samples);
    TorsionBatch read;
    ASSERT_TRUE(TorsionCodec().Decode(Encoded(batch), read));
    EXPECT_TRUE(Same(read, batch)) << samples;
  }
}

TEST(TorsionCodec, RefusesEveryByteThatIsNotAsItWasWritten) {
  Random draw{12};
  const TorsionBatch batch = DrawBatch(draw, 5, 4);
  const auto sound = Encoded(batch);
  for (std::size_t i = 0; i < sound.size(); ++i) {
    auto bytes = sound;
    bytes[i] ^= 0x10U;
    TorsionBatch read = batch;
    ASSERT_FALSE(TorsionCodec().Decode(bytes, read)) << i;
    ASSERT_TRUE(Same(read, batch)) << i;
  }
}

/// A batch whose counts lie; its checksum fits.
std::vector<std::uint8_t> Lying(std::uint32_t couplings, std::uint32_t samples) {
  TorsionBatch batch;
  batch.couplings = couplings;
  batch.samples = samples;
  return Encoded(batch);
}

TEST(TorsionCodec, RefusesCountsThatNoBatchHas) {
  TorsionBatch read;
  ASSERT_TRUE(TorsionCodec().Decode(Lying(2, 3), read));
  EXPECT_FALSE(TorsionCodec().Decode(Lying(2, 0), read));
  EXPECT_FALSE(TorsionCodec().Decode(Lying(0, 2), read));
  EXPECT_FALSE(TorsionCodec().Decode(Lying(9, 1), read));
  EXPECT_FALSE(TorsionCodec().Decode(Lying(1, 33), read));
  // Negative ones, as the message counts.
  EXPECT_FALSE(TorsionCodec().Decode(Lying(0xFFFF'FFFEU, 0xFFFF'FFFDU), read));
}

TEST(TorsionCodec, WritesNoneThatDoesNotFit) {
  Random draw{13};
  const TorsionBatch batch = DrawBatch(draw, 5, 4);
  std::vector<std::uint8_t> small(Encoded(batch).size() - 1);
  EXPECT_EQ(TorsionCodec().Encode(batch, small), 0U);
}

class Torsion : public ::testing::Test {
 protected:
  [[nodiscard]] std::string Path() const { return folder_ / "s.lcmlog"; }

  /// Records 0 .. 199; a batch comes with the frame of its last instant. DrawRecord's frame of a
  /// cycle is the rig's third after it.
  void RecordAll() {
    const auto records = DrawRecords(200);
    Random draw{14};
    RecorderOptions options;
    options.session_path = Path();
    options.trip_folder = folder_ / "";
    options.header = Header();
    Recorder recorder(std::move(options));
    for (const auto& record : records) {
      const std::uint64_t instant = record.in.frame.cycle;
      if (instant >= 40 && (instant - 40) % 32 == 31) {
        sent_.push_back(DrawBatch(draw, instant - 31));
        recorder.PostTorsion(sent_.back());
      }
      recorder.Post(record);
    }
    recorder.Finish();
  }

  Folder folder_;
  std::vector<TorsionBatch> sent_;
};

TEST_F(Torsion, IsKeptWhereAskedForAndChangesNoRecord) {
  RecordAll();
  SessionReader reader(Path());
  reader.KeepTorsion();
  const auto read = ReadAll(reader);
  const auto records = DrawRecords(200);
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t i = 0; i < read.size(); ++i) ASSERT_TRUE(SameBits(read[i], records[i]));
  ASSERT_EQ(reader.torsion().size(), sent_.size());
  for (std::size_t i = 0; i < sent_.size(); ++i) EXPECT_TRUE(Same(reader.torsion()[i], sent_[i]));
  EXPECT_FALSE(reader.damage().any());
  SessionReader other(Path());
  EXPECT_EQ(ReadAll(other).size(), records.size());
  EXPECT_TRUE(other.torsion().empty());
}

TEST_F(Torsion, StandsBeforeTheFirstRecordOfALaterInstant) {
  RecordAll();
  LogScanner log(Path());
  RecordCodec codec(0);
  TorsionCodec torsion;
  RawEvent event;
  std::uint64_t instant = 0;
  std::size_t batches = 0;
  while (log.At(event) == LogScanner::Look::kEvent) {
    cycle::CycleRecord record;
    TorsionBatch batch;
    if (event.channel == kCycleChannel && codec.Decode(event.data, record)) {
      instant = record.in.frame.cycle;
    }
    if (event.channel == kTorsionChannel) {
      ASSERT_TRUE(torsion.Decode(event.data, batch));
      EXPECT_EQ(batch.first_cycle + batch.samples - 1, instant);
      ++batches;
    }
    log.MoveTo(event.end);
  }
  EXPECT_EQ(batches, sent_.size());
}

TEST_F(Torsion, ADamagedBatchIsSaidAndCostsNoRecord) {
  RecordAll();
  std::string bytes = ReadFile(Path());
  const std::size_t at = bytes.find(std::string(kTorsionChannel));
  ASSERT_NE(at, std::string::npos);
  bytes[at + kTorsionChannel.size() + 100] ^= 0x01;
  std::ofstream(Path(), std::ios::binary) << bytes;
  SessionReader reader(Path());
  reader.KeepTorsion();
  EXPECT_EQ(ReadAll(reader).size(), 200U);
  EXPECT_EQ(reader.torsion().size(), sent_.size() - 1);
  EXPECT_EQ(reader.damage().corrupt_records, 1U);
}

TEST(TorsionRecording, FindsTheRowOfAnInstantAndNoneWhereABatchWasLost) {
  TorsionRecording torsion;
  torsion.rig_session = {1, 1, 1, 2, 2};
  torsion.cycle = {4, 5, 9, 4, 5};
  EXPECT_EQ(torsion.RowOf(1, 5), 1U);
  EXPECT_EQ(torsion.RowOf(1, 9), 2U);
  EXPECT_EQ(torsion.RowOf(2, 4), 3U);
  EXPECT_EQ(torsion.RowOf(1, 6), std::nullopt);
  EXPECT_EQ(torsion.RowOf(1, 10), std::nullopt);
  EXPECT_EQ(torsion.RowOf(2, 9), std::nullopt);
  EXPECT_EQ(torsion.RowOf(3, 4), std::nullopt);
  EXPECT_EQ(TorsionRecording{}.RowOf(1, 4), std::nullopt);
}

}  // namespace
}  // namespace levitas::session
