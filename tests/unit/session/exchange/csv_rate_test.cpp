// Steps in time of a measured file: another sampling rate is no series of drop-outs, and a gap has
// a limit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "session/exchange/csv_import.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kOneAxisNames = "time_s,position_x_m,control_current_x_a\n";

class CsvRate : public ::testing::Test {
 protected:
  ImportReport Import(const std::string& content) {
    RigNumbers rig;
    rig.name = "bench";
    rig.channels = {"x"};
    rig.bearings = {"b"};
    rig.period_ns = 100'000;  // 10 kHz
    WriteFile(folder_ / "data.csv", content);
    return ImportCsv({.data_path = folder_ / "data.csv",
                      .out_path = folder_ / "s.lcmlog",
                      .rig = rig,
                      .rig_yaml = "name: bench\n",
                      .program_version = "0.1.0"});
  }
  std::string Refusal(const std::string& content) {
    std::filesystem::remove(folder_ / "s.lcmlog");
    try {
      Import(content);
    } catch (const BadInput& problem) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "s.lcmlog"));
      return problem.what();
    }
    return "accepted";
  }
  Folder folder_;
};

/// `rows` rows, `step` periods apart but for the first `whole` ones, which follow each other.
std::string SteppedRows(int rows, int step, int whole = 0) {
  std::string text = kOneAxisNames;
  int at = 0;
  for (int n = 0; n < rows; ++n) {
    text += std::to_string(1e-4 * at) + ",0,0\n";
    at += n < whole ? 1 : step;
  }
  return text;
}

TEST_F(CsvRate, OfHalfTheRateIsRefusedAsSuchAndNotTakenForDropOuts) {
  EXPECT_THAT(Refusal(SteppedRows(2000, 2)),
              HasSubstr("the file's rate is 5000 Hz, the rig's 10000 Hz"));
  EXPECT_THAT(Refusal(SteppedRows(2000, 10)),
              AllOf(HasSubstr("the file's rate is 1000 Hz"), HasSubstr("resample")));
  EXPECT_THAT(Refusal(SteppedRows(200, 1000)),
              AllOf(HasSubstr("the file's rate is 10 Hz"), HasSubstr("unit: ms")));
  EXPECT_THAT(Refusal(SteppedRows(10, 2)), Not(HasSubstr("rate"))) << "nine steps tell nothing yet";
}

TEST_F(CsvRate, WithDropOutsInHalfOfItsStepsIsStillTheRigsRate) {
  EXPECT_EQ(Import(SteppedRows(101, 2, 50)).drop_outs, 50U);
  EXPECT_THAT(Refusal(SteppedRows(101, 2, 49)), HasSubstr("the file's rate is 5000 Hz"));
}

TEST_F(CsvRate, WithAGapOfMoreThanAMinuteIsRefused) {
  const std::string begin = std::string(kOneAxisNames) + "0,0,0\n0.0001,0,0\n";
  EXPECT_EQ(Import(begin + "60.0001,0,0\n").missing_cycles, 599'999U);
  EXPECT_THAT(Refusal(begin + "60.0002,0,0\n"), HasSubstr("a gap of 60.0001 s; allowed 60 s"));
  EXPECT_THAT(Refusal(begin + "3.9e9,0,0\n"), HasSubstr("Split the file there"));
}

}  // namespace
}  // namespace levitas::session
