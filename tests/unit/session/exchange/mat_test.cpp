// MAT files in: a matrix with a quantity a row, vectors with the names of columns, and what is
// refused. The files are written by synthetic.hpp byte by byte.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "session/exchange/csv_import.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using testing::Folder;
using ::testing::HasSubstr;
using testing::Matrix;
using testing::ReadAll;
using testing::WriteFile;

class Mat : public ::testing::Test {
 protected:
  ImportReport Import(const std::string& bytes) {
    WriteFile(mat_, bytes);
    RigNumbers rig;
    rig.channels = {"ball_x"};
    rig.bearings = {"ball"};
    rig.period_ns = 1'000'000;
    rig.bias_current_a = 0.5;
    return ImportMat(
        {.data_path = mat_,
         .out_path = out_,
         .rig = rig,
         .rig_yaml = "name: bench\n",
         .program_version = "0.1.0",
         .start_utc_ns = 5,
         .coils = {{10e-3, 2.5}},
         .matrix = "log",
         .matrix_rows = {"time_s", "gap_ball_x_m", "duty_towards_ball_x", "duty_away_ball_x",
                         "coil_current_towards_ball_x_a", "coil_current_away_ball_x_a"}});
  }
  std::vector<cycle::CycleRecord> Records() {
    SessionReader reader(out_);
    return ReadAll(reader);
  }
  std::string Refusal(const std::string& bytes) {
    try {
      Import(bytes);
    } catch (const BadInput& problem) {
      EXPECT_FALSE(std::filesystem::exists(out_));
      return problem.what();
    }
    return "accepted";
  }

  Folder folder_;
  std::string mat_ = folder_ / "data.mat";
  std::string out_ = folder_ / "data.lcmlog";
};

const std::vector<double> kTwoSamples{0.01,  8e-3, 0.5, 0.1, 1.2, 0.2,
                                      0.011, 9e-3, 0.4, 0.0, 1.1, 0.0};

TEST_F(Mat, MatrixOfTheRigsOwnLogBecomesPositionsCommandsAndCoilCurrents) {
  const ImportReport report = Import(Matrix("log", 6, kTwoSamples));
  EXPECT_EQ(report.rows, 2U);
  EXPECT_TRUE(report.has_coil_currents);
  const auto records = Records();
  ASSERT_EQ(records.size(), 2U);
  const auto& first = records[0];
  EXPECT_DOUBLE_EQ(first.in.frame.position_m[0], 10e-3 - 8e-3);
  // Half the difference and half the sum of 0.5 and 0.1, of 2.5 A.
  EXPECT_DOUBLE_EQ(first.out.current.control_current_a[0], 0.5);
  EXPECT_DOUBLE_EQ(first.out.current.bias_current_a, 0.75);
  ASSERT_EQ(first.in.coils, 2U);
  EXPECT_EQ(first.in.coil_current_a[0], 1.2);
  EXPECT_EQ(first.in.coil_current_a[1], 0.2);
  EXPECT_EQ(records[1].in.cycle, 1U);
  EXPECT_EQ(records[1].in.coil_current_a[0], 1.1);
}

TEST_F(Mat, VectorsNamedAsColumnsNeedNoLayout) {
  Import(
      Matrix("time_s", 1, {0.0, 0.001, 0.002}) + Matrix("position_ball_x_mm", 1, {1.0, 2.0, 3.0}) +
      Matrix("control_current_ball_x_a", 1, {0.1, 0.2, 0.3}) + Matrix("something_else", 1, {7.0}));
  const auto records = Records();
  ASSERT_EQ(records.size(), 3U);
  EXPECT_DOUBLE_EQ(records[2].in.frame.position_m[0], 3e-3);
  EXPECT_EQ(records[2].out.current.control_current_a[0], 0.3);
  EXPECT_EQ(records[2].out.current.bias_current_a, 0.5);
  EXPECT_EQ(records[2].in.coils, 0U);
}

TEST_F(Mat, WhatIsNoSuchFileOrMatrixIsRefusedAndLeavesNothingBehind) {
  EXPECT_THAT(Refusal("no mat file, but text that is long enough to hold a header of 128 bytes"),
              HasSubstr("data.mat"));
  EXPECT_THAT(Refusal(Matrix("log", 2, {1.0, 2.0, 3.0, 4.0})), HasSubstr("names 6 quantities"));
  EXPECT_THAT(Refusal(Matrix("time_s", 1, {0.0, 0.001})), HasSubstr("columns missing"));
  EXPECT_THAT(
      Refusal(Matrix("time_s", 1, {0.0, 0.001}) + Matrix("position_ball_x_m", 1, {0.0, 0.0, 0.0}) +
              Matrix("control_current_ball_x_a", 1, {0.0, 0.0})),
      HasSubstr("has 3 samples"));
  std::vector<double> broken = kTwoSamples;
  broken[8] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(Refusal(Matrix("log", 6, broken)), HasSubstr("duty_towards_ball_x"));
}

}  // namespace
}  // namespace levitas::session
