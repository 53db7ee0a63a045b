// What stands above the rows of a file, by the sentences of the header.

#include "session/exchange/csv_head.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

class HeadOfCsv : public ::testing::Test {
 protected:
  /// Known is "time_s" alone.
  CsvHead HeadOf(const std::string& content) {
    testing::WriteFile(path_, content);
    LineSource lines(path_);
    CsvHead head =
        ReadCsvHead(lines, path_, [](const std::string& name) { return name == "time_s"; });
    first_row_ = NumberedLine{};
    std::string_view line;
    if (!head.ahead.empty()) {
      first_row_ = head.ahead.front();
    } else if (lines.Next(line)) {
      first_row_ = NumberedLine{lines.line_number(), line};
    }
    return head;
  }
  NumberedLine first_row_;  ///< that a reader of the head's file gets, read ahead or not
  testing::Folder folder_;
  std::string path_{folder_ / "head.csv"};
};

TEST_F(HeadOfCsv, IsTheLineWithAKnownNameEvenBehindACommentSign) {
  const CsvHead head = HeadOf("sep=;\nTest bench 3; run 7\n# time_s; x\n\n# begins\n0;1\n1;2\n");
  EXPECT_EQ(head.line, 3U);
  EXPECT_EQ(head.separator, ';');
  EXPECT_THAT(head.names, ::testing::ElementsAre("time_s", "x"));
  EXPECT_TRUE(head.units.empty());
  EXPECT_EQ(first_row_, NumberedLine(6, "0;1"));
}

TEST_F(HeadOfCsv, TakesARowForUnitsOnlyWhereEveryCellIsOne) {
  const CsvHead with = HeadOf("time_s,x,y\n[s],(\xC2\xB5m),V\n0,1,2\n");
  EXPECT_THAT(with.units, ::testing::ElementsAre("s", "um", "")) << "no column of ours is in volts";
  EXPECT_EQ(first_row_, NumberedLine(3, "0,1,2"));

  const CsvHead without = HeadOf("time_s,x,y\ns,um,ready\n0,1,2\n");
  EXPECT_TRUE(without.units.empty());
  EXPECT_EQ(first_row_, NumberedLine(2, "s,um,ready"));
}

TEST_F(HeadOfCsv, OfUnknownNamesIsTheLineAboveTheNumbersThatHasAsManyCells) {
  const CsvHead named = HeadOf("one,two,three\np,q\n0,1\n");
  EXPECT_EQ(named.line, 2U);
  EXPECT_THAT(named.names, ::testing::ElementsAre("p", "q"));

  const CsvHead bare = HeadOf("one,two,three\n0,1\n");
  EXPECT_EQ(bare.line, 0U);
  EXPECT_THAT(bare.names, ::testing::ElementsAre("#1", "#2"));
  EXPECT_EQ(first_row_, NumberedLine(2, "0,1"));
}

TEST_F(HeadOfCsv, OfCommentsAloneIsRefused) {
  EXPECT_THROW(static_cast<void>(HeadOf("# nothing\n\n% at all\n")), BadInput);
}

TEST(CsvCell, HasADecimalCommaOnlyWhereNoCommaPartsTheCells) {
  double value = 0.0;
  EXPECT_TRUE(ParseCell("-1,5", ';', value));
  EXPECT_EQ(value, -1.5);
  EXPECT_FALSE(ParseCell("-1,5", ',', value));
  EXPECT_TRUE(ParseCell("+2.5e-1", ',', value));
  EXPECT_EQ(value, 0.25);
  for (const char* none : {"", "+-1", "1.5x", "1,000,5"}) {
    EXPECT_FALSE(ParseCell(none, ';', value)) << none;
  }
}

}  // namespace
}  // namespace levitas::session
