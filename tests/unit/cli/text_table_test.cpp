// Tables for people: columns never run together, whatever stands in them.

#include "report/text/text_table.hpp"

#include <gtest/gtest.h>

namespace levitas::cli {
namespace {

TEST(TextTable, IsAsWideAsItsWidestCellsAndKeepsTwoBlanksBetween) {
  report::TextTable table;
  table.Add({"Hz", "0-10", "10-30"});
  table.Add({"de_x", "123456.78 (100 %)", "0.20"});
  EXPECT_EQ(table.Text(),
            "Hz                 0-10  10-30\n"
            "de_x  123456.78 (100 %)   0.20\n");
}

TEST(TextTable, TakesRowsOfDifferentLengthsAndLeavesNoBlanksAtTheirEnds) {
  report::TextTable table;
  table.Add({"a"});
  table.Add({"bb", "1", "2"});
  table.Add({"c", "", ""});
  EXPECT_EQ(table.Text(), "a\nbb  1  2\nc\n");
}

TEST(TextTable, OfNothingIsNothing) { EXPECT_EQ(report::TextTable().Text(), ""); }

}  // namespace
}  // namespace levitas::cli
