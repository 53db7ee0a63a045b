// The controller's law in a record, what breaks it, and rows that are left out of it.

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/record_errors/find.hpp"
#include "diagnosis/record_errors/gaps.hpp"
#include "diagnosis/record_errors/law_fit.hpp"
#include "diagnosis/record_errors/wiring.hpp"
#include "tests/unit/diagnosis/recorded_loop.hpp"

namespace levitas::diagnosis {
namespace {

double& Current(analysis::RecordedRow& row, std::size_t axis) {
  return row.sample.command.control_current_a[axis];
}

std::vector<LawOfColumn> Laws(const Record& record) {
  return FitLaw(RotorView(), AllColumns(record));
}

int BreaksOf(const Record& record) { return Breaks(Laws(record), {}, RotorView().axes); }

TEST(LawFit, KnowsADecentralisedLawAndBreaksNothing) {
  const Record record = RecordedLoop();
  const std::vector<LawOfColumn> laws = Laws(record);
  ASSERT_EQ(laws.size(), 4U);
  for (std::size_t a = 0; a < laws.size(); ++a) {
    EXPECT_TRUE(laws[a].known);
    EXPECT_EQ(laws[a].position, a);
    EXPECT_EQ(laws[a].shift, 0);
    EXPECT_LT(laws[a].direct_a_per_m, 0.0);
    EXPECT_EQ(laws[a].test, a);
  }
  EXPECT_EQ(Breaks(laws, {}, 4), 0);
}

TEST(LawFit, DoesNotKnowCurrentsThatFollowNothing) {
  Record record = RecordedLoop();
  std::mt19937_64 draw{3};
  std::normal_distribution<double> normal{0.0, 0.1};
  for (auto& row : record.rows) {
    for (std::size_t a = 0; a < 4; ++a) Current(row, a) = normal(draw);
  }
  for (const LawOfColumn& law : Laws(record)) EXPECT_FALSE(law.known);
  EXPECT_EQ(BreaksOf(record), 0) << "what is not known cannot be broken";
}

// A minute in which every axis is excited for a few seconds: four spans of 0.4 s miss most.
TEST(Columns, HoldTheTestSignalOfEveryAxis) {
  Record record = RecordedLoop({.rows = 100'000});
  for (std::size_t n = 0; n < record.rows.size(); ++n) {
    for (std::size_t a = 0; a < 4; ++a) {
      if (n < 40'000 + 5'000 * a || n >= 45'000 + 5'000 * a) record.rows[n].excitation_a[a] = 0.0;
    }
  }
  const Columns columns = ColumnsOf(record, RotorView(), 16'000);
  for (Eigen::Index a = 0; a < 4; ++a) {
    EXPECT_GE((columns.excitation_a.col(a).array() != 0.0).count(), 1000) << a;
  }
  EXPECT_LE(columns.rows(), 32'000);
  EXPECT_EQ(std::count(columns.missing.begin() + 1, columns.missing.end(), 0) + 7,
            columns.rows() - 1);
}

TEST(Breaks, ByTwoColumnsThatAreExchangedAndMendedByExchangingThem) {
  Record record = RecordedLoop();
  for (auto& row : record.rows) std::swap(row.sample.position_m[0], row.sample.position_m[3]);
  EXPECT_GE(BreaksOf(record), 2);
  ColumnUses uses;
  std::swap(uses.position[0], uses.position[3]);
  EXPECT_EQ(Breaks(Laws(record), uses, 4), 0);
}

TEST(Breaks, ByASignAndByAUnit) {
  for (const double factor : {-1.0, 1000.0}) {
    Record record = RecordedLoop();
    for (auto& row : record.rows) Current(row, 1) *= factor;
    // 1000 A are beyond the limit, where no law is: the unit is only seen below it.
    if (factor > 1.0) {
      for (auto& row : record.rows) Current(row, 1) *= 1e-6;
    }
    EXPECT_GE(BreaksOf(record), 1) << factor;
    ColumnUses uses;
    uses.current[1].factor = factor > 1.0 ? 1e3 : -1.0;
    EXPECT_EQ(Breaks(Laws(record), uses, 4), 0) << factor;
  }
}

TEST(Breaks, ByAColumnThatIsLate) {
  Record record = RecordedLoop();
  for (std::size_t n = record.rows.size(); n-- > 2;)
    Current(record.rows[n], 2) = Current(record.rows[n - 2], 2);
  EXPECT_EQ(Laws(record)[2].shift, 2);
  EXPECT_GE(BreaksOf(record), 1);
  ColumnUses uses;
  uses.current[2].late = 2;
  EXPECT_EQ(Breaks(Laws(record), uses, 4), 0);
}

/// Without `count` rows from each of `places` on; cycles run on.
Record LeftOut(const Record& whole, const std::vector<std::size_t>& places, std::size_t count) {
  Record record = whole;
  record.rows.clear();
  for (std::size_t n = 0; n < whole.rows.size(); ++n) {
    const bool out = std::ranges::any_of(
        places, [&](std::size_t place) { return n >= place && n < place + count; });
    if (out) continue;
    record.rows.push_back(whole.rows[n]);
    record.rows.back().cycle = record.rows.size() - 1;
  }
  return record;
}

RecordErrors Gaps(const Record& record) {
  RecordErrors out;
  FindGaps(RotorView(), record, 0, out);
  return out;
}

TEST(Gaps, AreNamedWithTheirPlaces) {
  const Record record = LeftOut(RecordedLoop(), {1000, 2500, 4000}, 40);
  const RecordErrors found = Gaps(record);
  ASSERT_EQ(found.errors.size(), 1U);
  EXPECT_EQ(found.errors[0].kind, RecordErrorKind::kGaps);
  EXPECT_EQ(found.errors[0].size, 3.0);
  EXPECT_EQ(found.gaps, (std::vector<std::uint64_t>{1000, 2460, 3920}));
  EXPECT_NE(found.errors[0].sentence.find("0.1000 s"), std::string::npos)
      << found.errors[0].sentence;
}

TEST(Gaps, OfTwoRowsAreSeen) {
  EXPECT_EQ(Gaps(LeftOut(RecordedLoop(), {3000}, 2)).gaps, std::vector<std::uint64_t>{3000});
}

TEST(Gaps, AreNotInAWholeRecordNorWhereTheCyclesCountThem) {
  EXPECT_TRUE(Gaps(RecordedLoop()).errors.empty());
  Record counted = LeftOut(RecordedLoop(), {3000}, 40);
  for (std::size_t n = 3000; n < counted.rows.size(); ++n) counted.rows[n].cycle += 40;
  EXPECT_TRUE(Gaps(counted).errors.empty());
}

TEST(Gaps, AWrongReadingOfOneProbeIsNone) {
  Record record = RecordedLoop();
  for (const std::size_t n : {1000U, 2000U}) record.rows[n].sample.position_m[1] += 50e-6;
  EXPECT_TRUE(Gaps(record).errors.empty());
}

TEST(Gaps, ShocksThatTheLawAnswersAreNone) {
  // The rotor is pushed: positions jump, and the currents follow by the law.
  Record record = RecordedLoop();
  for (std::size_t n = 3000; n < record.rows.size(); ++n) {
    auto& row = record.rows[n];
    for (std::size_t a = 0; a < 4; ++a) {
      const double push_m = 20e-6;
      row.sample.position_m[a] += push_m;
      // The answer of 0.4 i(n-1) - 8e3 y - 6e3 (y - y before) to a step of y.
      const auto since = static_cast<double>(n - 3000);
      const double at_last_a = -8e3 * push_m / 0.6;
      const double first_a = -14e3 * push_m;
      Current(row, a) += at_last_a + (first_a - at_last_a) * std::pow(0.4, since);
    }
  }
  EXPECT_TRUE(Gaps(record).errors.empty());
}

TEST(Mended, LeavesGapsFromWhichEveryModelStartsAnew) {
  const Record record = LeftOut(RecordedLoop(), {1000, 2500}, 40);
  const Record mended = Mended(RotorView(), record, Gaps(record));
  ASSERT_EQ(mended.rows.size(), record.rows.size());
  EXPECT_EQ(mended.rows[999].cycle, 999U);
  EXPECT_EQ(mended.rows[1000].cycle, 1000U + kUnknownGap);
  EXPECT_EQ(mended.rows[2460].cycle, 2460U + 2 * kUnknownGap);
}

TEST(RecordErrorSentences, ListRecordsWithTheSameErrorOnce) {
  const RecordError late{
      RecordErrorKind::kDelayed, {"speed"}, 2.0, 3.0, "it is late", "move it", false};
  RecordErrors one;
  one.record = "a.csv";
  one.errors = {late};
  RecordErrors two = one;
  two.record = "b.csv";
  RecordErrors other = one;
  other.record = "c.csv";
  other.errors[0].sentence = "it is early";
  const auto said = RecordErrorSentences({one, two, other});
  EXPECT_EQ(said, (std::vector<std::string>{
                      "Error of the record a.csv, b.csv: it is late. To mend it: move it.",
                      "Error of the record c.csv: it is early. To mend it: move it."}));
  EXPECT_TRUE(RecordErrorSentences({}).empty());
}

}  // namespace
}  // namespace levitas::diagnosis
