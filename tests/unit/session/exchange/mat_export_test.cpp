// A session written as a MAT file is read back as it was, by the reader of measured MAT files.

#include "session/exchange/mat_export.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "common/problem.hpp"
#include "session/exchange/mat_rows.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using testing::DrawRecords;
using testing::Folder;
using testing::Header;
using testing::WriteSession;

TEST(MatExport, IsReadBackWithEveryNumberAsItWas) {
  const Folder folder;
  const auto records = DrawRecords(500);
  WriteSession(folder / "s", records);
  SessionReader session(folder / "s");
  EXPECT_EQ(ExportMat(session, folder / "s.mat").rows, records.size());
  MatRows rows(folder / "s.mat", Header().channels, "", {});
  CsvRow row;
  for (const auto& record : records) {
    ASSERT_TRUE(rows.Next(row));
    EXPECT_DOUBLE_EQ(row.time_s, 1e-9 * static_cast<double>(record.in.frame.sample_time_ns));
    EXPECT_EQ(row.angle_rad, record.in.frame.angle_rad);
    // To rpm and back: two roundings.
    EXPECT_DOUBLE_EQ(row.speed_rad_per_s, record.in.frame.speed_rad_per_s);
    EXPECT_TRUE(testing::SameBits(row.position_m, record.in.frame.position_m));
    EXPECT_TRUE(testing::SameBits(row.control_current_a, record.out.current.control_current_a));
    EXPECT_TRUE(testing::SameBits(row.excitation_a, record.in.op.excitation_a));
  }
  EXPECT_FALSE(rows.Next(row));
}

TEST(MatExport, LeavesOutCyclesWithoutASensorFrameAndCountsThem) {
  const Folder folder;
  auto records = DrawRecords(20);
  records[7].in.frame_present = false;
  WriteSession(folder / "s", records);
  SessionReader session(folder / "s");
  const ExportReport report = ExportMat(session, folder / "s.mat");
  EXPECT_EQ(report.rows, 19U);
  EXPECT_EQ(report.cycles_without_frame, 1U);
}

TEST(MatExport, HoldsTheRowsThatAreAskedFor) {
  const Folder folder;
  const auto records = DrawRecords(20);
  WriteSession(folder / "s", records);
  SessionReader session(folder / "s");
  EXPECT_EQ(ExportMat(session, folder / "s.mat", {.from_s = 0.0005, .every = 5}).rows, 3U);
  MatRows rows(folder / "s.mat", Header().channels, "", {});
  CsvRow row;
  for (const std::size_t expected : {5U, 10U, 15U}) {
    ASSERT_TRUE(rows.Next(row));
    EXPECT_TRUE(testing::SameBits(row.position_m, records[expected].in.frame.position_m));
  }
  EXPECT_FALSE(rows.Next(row));
}

TEST(MatExport, OfAFolderThatIsNotThereIsRefusedWithItsName) {
  const Folder folder;
  WriteSession(folder / "s", DrawRecords(3));
  SessionReader session(folder / "s");
  try {
    static_cast<void>(ExportMat(session, folder / "no/s.mat"));
    FAIL() << "written into a folder that is not there";
  } catch (const BadInput& problem) {
    EXPECT_NE(std::string(problem.what()).find("no/s.mat"), std::string::npos);
  }
}

// matio reports success when nothing could be written.
TEST(MatExport, ThatDoesNotReachTheDiskIsStatusOneAndLeavesNothing) {
  const Folder folder;
  WriteSession(folder / "s", DrawRecords(3000));
  SessionReader session(folder / "s");
  struct rlimit before {};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const struct rlimit small { .rlim_cur = 100'000, .rlim_max = before.rlim_max };
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  ExitStatus status = ExitStatus::kDone;
  std::string text;
  try {
    static_cast<void>(ExportMat(session, folder / "s.mat"));
  } catch (const Problem& problem) {
    status = problem.status();
    text = problem.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(status, ExitStatus::kOther);
  EXPECT_NE(text.find("s.mat: writing failed: File too large"), std::string::npos) << text;
  EXPECT_FALSE(std::filesystem::exists(folder / "s.mat"));
}

TEST(MatExport, ToADeviceIsAUsageProblem) {
  const Folder folder;
  WriteSession(folder / "s", DrawRecords(3));
  SessionReader session(folder / "s");
  try {
    static_cast<void>(ExportMat(session, "/dev/full"));
    FAIL() << "nothing was written, and nothing said";
  } catch (const Problem& problem) {
    EXPECT_EQ(problem.status(), ExitStatus::kUsage);
  }
}

}  // namespace
}  // namespace levitas::session
