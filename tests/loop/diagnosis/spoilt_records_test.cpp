// Records of the flexible rotor, spoilt one way at a time: the error is named with its columns and
// size; the same records whole are accused of nothing. Columns and sizes are drawn by seed.

#include <gtest/gtest.h>

#include "benchmark/accuracy/spoilt_record.hpp"
#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/record_errors/find.hpp"

namespace levitas::accuracy {
namespace {

using diagnosis::RecordErrorKind;

/// A rig within its tolerances, standing, spinning and running up.
const Trial& TheTrial() {
  static const Trial trial = [] {
    TrialPlan plan;
    plan.seed = 20261126;
    plan.bits_per_axis = 700;
    plan.runup_s = 1.0;
    return MakeTrial(LoadTestRig("flexible_rotor", {"flexible_rotor"}), plan);
  }();
  return trial;
}

const diagnosis::RigView& TheView() {
  static const diagnosis::RigView view(TheTrial().rig.numbers, TheTrial().rig.plant);
  return view;
}

class OfKind : public ::testing::TestWithParam<RecordErrorKind> {};

TEST_P(OfKind, IsNamedWithItsColumnsInOneRecordAtLeast) {
  const Spoilt made = Spoil(TheTrial().rig, TheTrial().records, GetParam(), 4);
  bool named = false;
  std::string said;
  for (std::size_t r = 0; r < made.records.size(); ++r) {
    const auto found = diagnosis::FindRecordErrors(TheView(), made.records[r], made.times_s[r]);
    named = named || IsNamed(made, found);
    for (const auto& error : found.errors) said += error.sentence + "\n";
  }
  EXPECT_TRUE(named) << made.columns.front() << " by " << made.size << ", found:\n" << said;
}

INSTANTIATE_TEST_SUITE_P(SpoiltRecords, OfKind,
                         ::testing::Values(RecordErrorKind::kSwapped, RecordErrorKind::kReversed,
                                           RecordErrorKind::kUnit, RecordErrorKind::kQuantised,
                                           RecordErrorKind::kClipped, RecordErrorKind::kHeld,
                                           RecordErrorKind::kDelayed),
                         [](const auto& of) { return std::string(diagnosis::Name(of.param)); });

TEST(WholeRecords, AreAccusedOfNothing) {
  for (const diagnosis::Record& record : TheTrial().records) {
    const auto found = diagnosis::FindRecordErrors(TheView(), record);
    EXPECT_TRUE(found.errors.empty()) << record.name << ": " << found.errors.front().sentence;
  }
}

TEST(MendedRecord, HasTheColumnsThatWereExchangedWhereTheyBelong) {
  diagnosis::Record record = TheTrial().records.front();
  for (auto& row : record.rows) std::swap(row.sample.position_m[0], row.sample.position_m[1]);
  const auto found = diagnosis::FindRecordErrors(TheView(), record);
  const diagnosis::Record mended = diagnosis::Mended(TheView(), record, found);
  for (std::size_t n = 0; n < mended.rows.size(); n += 1000) {
    EXPECT_EQ(mended.rows[n].sample.position_m,
              TheTrial().records.front().rows[n].sample.position_m);
  }
}

TEST(Clock, ThatIsScaledOrDriftsIsNamedByTheTimesAlone) {
  const diagnosis::Record& record = TheTrial().records.front();
  for (const double drift : {0.0, 0.03}) {
    std::vector<double> times_s;
    double now_s = 0.0;
    for (std::size_t n = 0; n < record.rows.size(); ++n) {
      times_s.push_back(now_s);
      const double share = static_cast<double>(n) / static_cast<double>(record.rows.size());
      now_s += 1e-4 * ((drift == 0.0 ? 1.02 : 1.0) + drift * share);
    }
    const auto found = diagnosis::FindRecordErrors(TheView(), record, times_s);
    ASSERT_EQ(found.errors.size(), 1U);
    EXPECT_EQ(found.errors.front().kind, RecordErrorKind::kRate);
    EXPECT_EQ(found.drifts, drift != 0.0);
  }
}

}  // namespace
}  // namespace levitas::accuracy
