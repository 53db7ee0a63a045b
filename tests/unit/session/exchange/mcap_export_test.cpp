// A session written as MCAP is read back by a small reader written here from the specification
// (mcap.dev, format 0) and from protobuf's encoding. tests/process/lcm_tools/mcap_test.py reads one
// with the format's own library where that is installed.

#include "session/exchange/mcap_export.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <sstream>

#include "common/crc32.hpp"
#include "common/problem.hpp"
#include "session/exchange/mcap_writer.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using testing::DrawRecords;
using testing::Folder;
using testing::WriteSession;

std::uint64_t Number(const std::string& bytes, std::size_t at, int size) {
  std::uint64_t value = 0;
  for (int i = size - 1; i >= 0; --i) {
    value = value << 8U | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
  }
  return value;
}

struct McapRecord {
  int opcode;
  std::size_t at;  ///< of the opcode
  std::string content;
};

/// Records from `at` on to the end of `bytes`.
std::vector<McapRecord> Records(const std::string& bytes, std::size_t at, std::size_t end) {
  std::vector<McapRecord> records;
  while (at < end) {
    const std::size_t size = Number(bytes, at + 1, 8);
    records.push_back({bytes[at], at, bytes.substr(at + 9, size)});
    at += 9 + size;
  }
  EXPECT_EQ(at, end);
  return records;
}

struct File {
  std::string bytes;
  std::vector<McapRecord> records;
  explicit File(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    bytes = text.str();
    EXPECT_EQ(bytes.substr(0, 8), std::string("\x89MCAP0\r\n"));
    EXPECT_EQ(bytes.substr(bytes.size() - 8), std::string("\x89MCAP0\r\n"));
    records = Records(bytes, 8, bytes.size() - 8);
  }
  [[nodiscard]] std::vector<McapRecord> All(int opcode) const {
    std::vector<McapRecord> found;
    for (const auto& record : records) {
      if (record.opcode == opcode) found.push_back(record);
    }
    return found;
  }
  /// Messages of every chunk; its CRC is checked on the way.
  [[nodiscard]] std::vector<McapRecord> Messages() const {
    std::vector<McapRecord> found;
    for (const auto& chunk : All(0x06)) {
      const std::string& c = chunk.content;
      EXPECT_EQ(Number(c, 28, 4), 0U) << "no compression";
      const std::string inside = c.substr(40);
      EXPECT_EQ(Number(c, 32, 8), inside.size());
      EXPECT_EQ(Number(c, 16, 8), inside.size());
      EXPECT_EQ(Number(c, 24, 4), Crc32(inside.data(), inside.size()));
      for (const auto& message : Records(inside, 0, inside.size())) found.push_back(message);
    }
    return found;
  }
};

/// Doubles of a protobuf message: a tag of one or two bytes, then eight.
std::vector<double> Doubles(const std::string& message) {
  std::vector<double> values;
  for (std::size_t at = 0; at < message.size();) {
    std::uint64_t tag = static_cast<unsigned char>(message[at++]);
    if (tag > 0x7FU) tag = (tag & 0x7FU) | Number(message, at++, 1) << 7U;
    EXPECT_EQ(tag & 7U, 1U);
    EXPECT_EQ(tag >> 3U, values.size() + 1);
    values.push_back(std::bit_cast<double>(Number(message, at, 8)));
    at += 8;
  }
  return values;
}

class McapExport : public ::testing::Test {
 protected:
  File Export(const std::vector<cycle::CycleRecord>& records) {
    WriteSession(folder_ / "s", records);
    SessionReader session(folder_ / "s");
    report_ = ExportMcap(session, folder_ / "s.mcap");
    return File(folder_ / "s.mcap");
  }
  Folder folder_;
  ExportReport report_;
};

TEST_F(McapExport, HoldsEveryNumberOfEveryFrame) {
  const auto records = DrawRecords(500);
  const File file = Export(records);
  EXPECT_EQ(report_.rows, records.size());
  std::size_t row = 0;
  for (const auto& message : file.Messages()) {
    ASSERT_EQ(message.opcode, 0x05);
    if (Number(message.content, 0, 2) != 1) continue;  // an event
    const auto values = Doubles(message.content.substr(22));
    const auto& record = records.at(row);
    const std::size_t axes = record.in.frame.axes;
    ASSERT_EQ(values.size(), 3 + 3 * axes + 1);
    EXPECT_EQ(values.back(), static_cast<double>(record.out.mode));
    EXPECT_EQ(values[0], 1e-9 * static_cast<double>(record.in.frame.sample_time_ns));
    for (std::size_t i = 0; i < axes; ++i) {
      const double position_m = record.in.frame.position_m[i];
      EXPECT_EQ(std::memcmp(&values[3 + i], &position_m, sizeof(double)), 0);
    }
    EXPECT_EQ(Number(message.content, 2, 4), row) << "sequence";
    ++row;
  }
  EXPECT_EQ(row, records.size());
}

TEST_F(McapExport, LeavesOutCyclesWithoutASensorFrame) {
  auto records = DrawRecords(20);
  records[7].in.frame_present = false;
  (void)Export(records);
  EXPECT_EQ(report_.rows, 19U);
  EXPECT_EQ(report_.cycles_without_frame, 1U);
}

TEST_F(McapExport, NamesItsColumnsAndKeepsTheHeader) {
  const File file = Export(DrawRecords(3));
  const auto schemas = file.All(0x03);
  ASSERT_GE(schemas.size(), 2U);  // in the data and again in the summary
  for (const char* name : {"time_s", "rotor_angle_rad", "speed_rpm", "levitas"}) {
    EXPECT_NE(schemas[0].content.find(name), std::string::npos) << name;
  }
  const auto metadata = file.All(0x0C);
  ASSERT_EQ(metadata.size(), 1U);
  EXPECT_NE(metadata[0].content.find("controller"), std::string::npos);
  const auto index = file.All(0x0D);
  ASSERT_EQ(index.size(), 1U);
  EXPECT_EQ(Number(index[0].content, 0, 8), metadata[0].at);
  EXPECT_EQ(Number(index[0].content, 8, 8), metadata[0].content.size() + 9);
}

TEST_F(McapExport, IndexesEveryChunkWhereItLies) {
  const File file = Export(DrawRecords(20'000));  // more than one chunk of 1 MiB
  const auto chunks = file.All(0x06);
  const auto indexes = file.All(0x08);
  ASSERT_GT(chunks.size(), 1U);
  ASSERT_EQ(indexes.size(), chunks.size());
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    EXPECT_EQ(Number(indexes[i].content, 16, 8), chunks[i].at);
    EXPECT_EQ(Number(indexes[i].content, 24, 8), chunks[i].content.size() + 9);
    EXPECT_EQ(indexes[i].content.substr(0, 16), chunks[i].content.substr(0, 16));  // times
  }
  const auto statistics = file.All(0x0B);
  ASSERT_EQ(statistics.size(), 1U);
  EXPECT_EQ(Number(statistics[0].content, 0, 8), file.Messages().size());
}

TEST_F(McapExport, GuardsDataAndSummaryWithTheirCrc) {
  const File file = Export(DrawRecords(50));
  const auto end = file.All(0x0F).at(0);
  EXPECT_EQ(Number(end.content, 0, 4), Crc32(file.bytes.data(), end.at));
  const auto footer = file.All(0x02).at(0);
  const std::size_t summary_at = Number(footer.content, 0, 8);
  EXPECT_EQ(summary_at, end.at + 13);
  // All of the summary and the footer up to the CRC itself.
  EXPECT_EQ(Number(footer.content, 16, 4),
            Crc32(file.bytes.data() + summary_at, footer.at + 9 + 16 - summary_at));
}

TEST_F(McapExport, OfAFolderThatIsNotThereIsRefusedWithItsName) {
  WriteSession(folder_ / "s", DrawRecords(3));
  SessionReader session(folder_ / "s");
  try {
    static_cast<void>(ExportMcap(session, folder_ / "no/s.mcap"));
    FAIL() << "written into a folder that is not there";
  } catch (const BadInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("no/s.mcap"), std::string::npos);
  }
}

TEST(McapWriter, OfNothingIsStillAWholeFile) {
  std::string out;
  McapWriter writer([&out](std::string_view bytes) { out += bytes; }, "test");
  writer.Finish();
  EXPECT_EQ(out.substr(out.size() - 8), std::string("\x89MCAP0\r\n"));
}

}  // namespace
}  // namespace levitas::session
