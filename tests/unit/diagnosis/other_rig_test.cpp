// When a rig file is doubted: the currents of a record made by hand move nothing, which no rig file
// foretells; what is too little to doubt by is not doubted.

#include "diagnosis/record_errors/other_rig.hpp"

#include <gtest/gtest.h>

#include "tests/unit/diagnosis/recorded_loop.hpp"

namespace levitas::diagnosis {
namespace {

RecordErrors Doubts(const Record& record) {
  AxisArray noise_m{};
  noise_m.fill(1e-6);  // of RecordedLoop
  RecordErrors out;
  FindOtherRig(RotorView(), AllColumns(record), noise_m, out);
  return out;
}

TEST(FindOtherRig, DoubtsAFileOfWhoseCurrentsTheRotorKnowsNothing) {
  const RecordErrors found = Doubts(RecordedLoop());
  ASSERT_EQ(found.errors.size(), 1U);
  EXPECT_EQ(found.errors.front().kind, RecordErrorKind::kOtherRig);
  EXPECT_GE(found.errors.front().size, 0.0);
  EXPECT_LT(found.errors.front().size, kLeastShare);
  EXPECT_FALSE(found.errors.front().by_map);
}

TEST(FindOtherRig, NeedsATestSignal) {
  LoopPlan plan;
  plan.test_signal = false;
  EXPECT_TRUE(Doubts(RecordedLoop(plan)).errors.empty());
}

TEST(FindOtherRig, NeedsEnoughRows) {
  LoopPlan plan;
  plan.rows = 2000;
  EXPECT_TRUE(Doubts(RecordedLoop(plan)).errors.empty());
}

TEST(FindOtherRig, NeedsASteadySpeed) {
  LoopPlan plan;
  plan.speed_rad_per_s = 200.0;
  Record record = RecordedLoop(plan);
  const double rows = static_cast<double>(record.rows.size());
  for (std::size_t n = 0; n < record.rows.size(); ++n) {
    record.rows[n].sample.speed_rad_per_s *= 1.0 + 0.5 * static_cast<double>(n) / rows;
  }
  EXPECT_TRUE(Doubts(record).errors.empty());
}

}  // namespace
}  // namespace levitas::diagnosis
