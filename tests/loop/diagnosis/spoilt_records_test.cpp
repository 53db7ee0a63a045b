// Records of the flexible rotor, spoilt one way at a time: the error is named with its columns and
// size; the same records whole are accused of nothing. Columns and sizes are drawn by seed.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "benchmark/accuracy/drawn_rig.hpp"
#include "benchmark/accuracy/spoilt_record.hpp"
#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/record_errors/find.hpp"
#include "diagnosis/records/load.hpp"
#include "tests/support/paths.hpp"

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
  for (const auto& found : diagnosis::FindErrorsOfRecords(TheView(), made.records)) {
    named = named || IsNamed(made, found);
    for (const auto& error : found.errors) said += error.sentence + "\n";
  }
  EXPECT_TRUE(named) << made.columns.front() << " by " << made.size << ", found:\n" << said;
}

INSTANTIATE_TEST_SUITE_P(SpoiltRecords, OfKind,
                         ::testing::Values(RecordErrorKind::kSwapped, RecordErrorKind::kReversed,
                                           RecordErrorKind::kUnit, RecordErrorKind::kQuantised,
                                           RecordErrorKind::kClipped, RecordErrorKind::kHeld,
                                           RecordErrorKind::kDelayed, RecordErrorKind::kRate,
                                           RecordErrorKind::kGaps),
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

/// Files that another program wrote, of rigs within their tolerances and with a fault.
TEST(WholeRecords, OfAnotherSimulatorAreAccusedOfNothingToo) {
  const configuration::RigFile rig = LoadTestRig("flexible_rotor", {"flexible_rotor"}).rig;
  const diagnosis::RigView view(rig.numbers, rig.plant);
  for (const char* campaign : {"none", "eddy_current", "unbalance"}) {
    std::vector<diagnosis::Record> records;
    for (const char* run : {"standing", "spinning", "runup"}) {
      records.push_back(diagnosis::LoadRecord(
          fmt::format("{}/tests/data/records/{}/{}.csv.xz", test::SourceFolder(), campaign, run),
          rig));
    }
    for (const auto& found : diagnosis::FindErrorsOfRecords(view, records)) {
      EXPECT_TRUE(found.errors.empty())
          << campaign << " " << found.record << ": " << found.errors.front().sentence;
    }
  }
}

TEST(ErrorsOfRecords, AreNotSeenInAStrongFaultOfTheRig) {
  for (const effect::Id hidden : {effect::Id::kCouplingStiffness, effect::Id::kCurrentGain}) {
    TrialPlan plan;
    plan.seed = 20261126;
    plan.bits_per_axis = 700;
    plan.runup_s = 1.0;
    plan.hidden = {hidden};
    const Trial trial = MakeTrial(LoadTestRig("flexible_rotor", {"flexible_rotor"}), plan);
    const diagnosis::RigView view(trial.rig.numbers, trial.rig.plant);
    for (const auto& found : diagnosis::FindErrorsOfRecords(view, trial.records))
      EXPECT_TRUE(found.errors.empty()) << found.errors.front().sentence;
  }
}

/// A run-up has no test signal: position and current of an axis that pushes to the wrong side look
/// alike in it, and the records beside it tell which of them has the wrong sign.
TEST(RecordsOfOneRig, TellWhatARecordWithoutTestSignalCannot) {
  std::vector<diagnosis::Record> records = TheTrial().records;
  for (diagnosis::Record& record : records) {
    for (auto& row : record.rows) row.sample.position_m[0] *= -1.0;
  }
  for (const auto& found : diagnosis::FindErrorsOfRecords(TheView(), records)) {
    ASSERT_EQ(found.errors.size(), 1U) << found.record;
    EXPECT_EQ(found.errors.front().columns, std::vector<std::string>{"position_de_x"});
  }
}

/// Of this rig at rest every second row looks like rows that are twice as dense; what turns shows
/// that half of them is missing.
TEST(RecordsOfOneRig, ContradictTheWrongRateOfARecordAtRest) {
  TrialPlan plan;
  plan.seed = 157000;
  plan.bits_per_axis = 700;
  plan.runup_s = 1.0;
  const Trial trial = MakeDrawnTrial(
      LoadTestRig("flexible_rotor", {"flexible_rotor", "flexible_rotor_commissioned"}), plan);
  const Spoilt made = Spoil(trial.rig, trial.records, RecordErrorKind::kRate, 77 * plan.seed + 1);
  const diagnosis::RigView view(trial.rig.numbers, trial.rig.plant);

  const auto alone = diagnosis::FindRecordErrors(view, made.records.front());
  ASSERT_EQ(alone.errors.size(), 1U);
  EXPECT_EQ(alone.errors.front().size, 0.5);

  std::size_t right = 0;
  for (const auto& found : diagnosis::FindErrorsOfRecords(view, made.records)) {
    for (const auto& error : found.errors) {
      EXPECT_EQ(error.kind, RecordErrorKind::kRate) << found.record;
      EXPECT_NEAR(error.size, 2.0, 0.01) << found.record;
      ++right;
    }
  }
  EXPECT_GE(right, 2U) << "both records that turn";
}

}  // namespace
}  // namespace levitas::accuracy
