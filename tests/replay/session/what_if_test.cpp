#include "session/replay/what_if.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/problem.hpp"
#include "session/exchange/csv_import.hpp"
#include "session/replay/replay.hpp"
#include "tests/replay/session/recorded_run.hpp"
#include "tests/support/paths.hpp"

namespace levitas::session {
namespace {

using namespace testing;

class WhatIfs : public ::testing::Test {
 protected:
  static const std::vector<cycle::CycleRecord>& Records() {
    static const auto records = EventfulRun();
    return records;
  }
  WhatIfReport Compare(const cycle::CycleConfig& config, const WhatIfSink& sink = {}) {
    SessionReader reader(path_);
    return WhatIf(reader, config, path_, sink);
  }
  Folder folder_;
  std::string path_{folder_ / "s.lcmlog"};
};

TEST_F(WhatIfs, SameControllerDiffersNowhere) {
  WriteSession(path_, Records(), ShippedHeader());
  std::uint64_t given = 0;
  const WhatIfReport report = Compare(test::ShippedCycle(), [&](const auto& record, const auto& o) {
    EXPECT_EQ(record.out.current.control_current_a, o.current.control_current_a);
    ++given;
  });
  EXPECT_EQ(report.cycles, Records().size());
  EXPECT_EQ(report.compared, given);
  EXPECT_GT(report.compared, 10'000U);
  EXPECT_EQ(report.mode_differs, 0U);
  for (const auto& channel : report.channels) EXPECT_EQ(channel.max_a, 0.0) << channel.channel;
  EXPECT_EQ(report.fault, Fault::kSensorNotFinite);  // as recorded
}

TEST_F(WhatIfs, DifferenceIsInTheAxisWhoseLawWasChanged) {
  WriteSession(path_, Records(), ShippedHeader());
  cycle::CycleConfig config = test::ShippedCycle();
  config.law.axes[2].kp_a_per_m *= 0.9;
  const WhatIfReport report = Compare(config);
  EXPECT_EQ(report.channels[0].max_a, 0.0);
  EXPECT_EQ(report.channels[1].max_a, 0.0);
  EXPECT_EQ(report.channels[3].max_a, 0.0);
  EXPECT_EQ(report.channels[2].channel, "nde_x");
  EXPECT_GT(report.channels[2].rms_a, 0.0);
  EXPECT_GE(report.channels[2].max_a, report.channels[2].rms_a);
  EXPECT_GE(report.channels[2].rms_a, std::abs(report.channels[2].mean_a));
  EXPECT_GT(report.channels[2].max_time_s, 0.0);
}

TEST_F(WhatIfs, RefusesATripFile) {
  SessionHeader header = ShippedHeader();
  header.excerpt_of = "whole.lcmlog";
  WriteSession(path_, Records(), header);
  EXPECT_THROW(Compare(test::ShippedCycle()), BadInput);
  WriteSession(path_, {}, ShippedHeader());
  EXPECT_THROW(Compare(test::ShippedCycle()), BadInput);
}

// A record made by another program with the same law: the only check of the law's discretisation
// here that no code of ours takes part in on both sides.
TEST_F(WhatIfs, LawAloneCommandsWhatAForeignProgramCommanded) {
  ImportOptions import{.data_path = levitas::test::DataFolder() + "/records/standing_2s.csv.xz",
                       .out_path = path_,
                       .rig = test::ShippedRig().numbers,
                       .rig_yaml = configuration::WriteRig(test::ShippedRig()),
                       .program_version = "0.1.0",
                       .start_utc_ns = 0};
  ImportCsv(import);
  // From one sample to the next the two may differ by the file's digits only, except where one of
  // them is at the current limit (1 A) and the other, whose integrator started elsewhere, is not.
  std::array<double, 2> previous{};
  std::array<double, 2> largest_step{};
  std::array<int, 2> limited{};
  std::array<int, 2> judged{};
  const WhatIfReport report = Compare(test::ShippedCycle(), [&](const auto& record, const auto& o) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double theirs = record.out.current.control_current_a[axis];
      const double ours = o.current.control_current_a[axis];
      limited[axis] = std::max(std::abs(theirs), std::abs(ours)) > 0.999 ? 0 : limited[axis] + 1;
      if (limited[axis] > 1) {
        largest_step[axis] = std::max(largest_step[axis], std::abs(ours - theirs - previous[axis]));
        ++judged[axis];
      }
      previous[axis] = ours - theirs;
    }
  });
  EXPECT_EQ(report.compared, 19'000U);  // 2 s less the first 0.1 s
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // The file gives six digits: 0.5e-6 A in a current and, from 10 um on, 0.5e-10 m in a position,
    // which the law's high-frequency gain (Kp + Kd wd) wp / wz = 3.1e5 A/m makes 1.5e-5 A. Two
    // samples take part in a step, and the filters remember: twice the sum of both.
    EXPECT_LT(largest_step[axis], 2.0 * 2.0 * (0.5e-6 + 1.5e-5)) << axis;
    EXPECT_GT(judged[axis], 18'000) << axis;
    EXPECT_GT(report.channels[axis].recorded_rms_a, 0.1);
  }
}

}  // namespace
}  // namespace levitas::session
