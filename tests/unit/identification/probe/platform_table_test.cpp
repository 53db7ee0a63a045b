// Tables of a positioning platform: what is read of them, and that each kind of bad table is
// refused in one line that names the file and where in it.

#include "identification/probe/platform_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::identification {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;
using testing::StartsWith;

/// Eight rows, the fewest that are a table.
constexpr const char* kEightRows = "-4,-4\n-3,-3\n-2,-2\n-1,-1\n0,0\n1,1\n2,2\n3,3\n";

class PlatformTableFile : public testing::Test {
 protected:
  PlatformTable Read(const std::string& text) {
    std::ofstream(path_) << text;
    return ReadPlatformTable(path_);
  }

  /// Taken is a failure of the test.
  std::string RefusalOf(const std::string& text) {
    try {
      (void)Read(text);
    } catch (const BadInput& refused) {
      return refused.what();
    }
    ADD_FAILURE() << "taken: " << text;
    return {};
  }

  test::ScratchFolder platform_folder_;
  std::string path_ = platform_folder_ / "ux.csv";
};

TEST_F(PlatformTableFile, HasItsUnitsInTheNames) {
  const std::vector<std::pair<std::string, double>> lengths{
      {"m", 1.0}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}};
  for (const auto& [unit, si] : lengths) {
    const auto table = Read("displacement_" + unit + ",reading_" + unit + "\n" + kEightRows);
    EXPECT_DOUBLE_EQ(table.displacement_m.front(), -4.0 * si) << unit;
    EXPECT_DOUBLE_EQ(table.reading.back(), 3.0 * si) << unit;
    EXPECT_FALSE(table.volts) << unit;
  }
  const auto table = Read(std::string("displacement_um,reading_v\n") + kEightRows);
  EXPECT_TRUE(table.volts);
  EXPECT_DOUBLE_EQ(table.reading.back(), 3.0);
}

TEST_F(PlatformTableFile, MayHaveARowOfUnitsOtherColumnsAndAnotherOrderOfThem) {
  const auto table = Read(
      "# platform 3, ux\ntime;reading;displacement\ns;nm;um\n"
      "0;-400,5;-4\n1;-300;-3\n2;-200;-2\n3;-100;-1\n# a "
      "pause\n\n4;0;0\n5;100;1\n6;200;2\n7;300;3\n");
  ASSERT_EQ(table.rows(), 8U);
  EXPECT_DOUBLE_EQ(table.displacement_m.front(), -4e-6);
  EXPECT_DOUBLE_EQ(table.reading.front(), -400.5e-9);
  EXPECT_DOUBLE_EQ(table.reading.back(), 300e-9);
}

// The order tells which way the platform went, a repeat how well the probe repeats: neither is
// sorted nor averaged away.
TEST_F(PlatformTableFile, KeepsOrderAndRepeatsOfBothDirections) {
  const auto table = Read(
      "displacement_m,reading_m\n-1,-1\n0,0\n0,0.1\n1,1\n2,2\n1,0.9\n0,-0.1\n0,-0.2\n-1,-1.1\n");
  const std::vector<double> places{-1, 0, 0, 1, 2, 1, 0, 0, -1};
  const std::vector<double> readings{-1, 0, 0.1, 1, 2, 0.9, -0.1, -0.2, -1.1};
  EXPECT_THAT(table.displacement_m, ElementsAreArray(places));
  EXPECT_THAT(table.reading, Pointwise(testing::DoubleEq(), readings));
}

struct BadTable {
  const char* text;
  const char* where;  ///< behind the file's name
  const char* what;
};

const BadTable kBadTables[] = {
    {"reading_um,time_s\n1,1\n", ": line 1: ", "no column 'displacement_<m|mm|um|nm>'"},
    {"# a\ndisplacement_um,time_s\n1,1\n", ": line 2: ", "there are: displacement_um, time_s"},
    {"displacement_um,reading\n1,1\n", ": line 1: ", "column 'reading' has no unit"},
    {"displacement_v,reading_v\n1,1\n", ": line 1: ", "the unit 'v'; allowed: displacement_<m"},
    {"displacement_um,reading_a\n1,1\n", ": line 1: ", "the unit 'a'; allowed: reading_<m|mm"},
    {"displacement_um,displacement_mm,reading_v\n1,1,1\n",
     ": line 1: ", "'displacement_um' and 'displacement_mm'; allowed: one"},
    {"displacement_um,reading_um\n1,1\n2,two\n", ": line 3: ", "'two' is no finite number"},
    {"displacement_um,reading_um\n1,1\n,2\n", ": line 3: ", "'' is no finite number"},
    {"displacement_um,reading_um\n1,inf\n", ": line 2: ", "'inf' is no finite number"},
    {"displacement_um,reading_um\n1,1\n# b\n2\n", ": line 4: ", "'reading_um' is number 2"},
    {"displacement_um,reading_um\n1,1\n2,2\n", ": 2 rows", "needs 8 at least"},
    {"1,1\n2,2\n3,3\n", ": no line of names: ", "displacement_<unit> and reading_<unit>"},
};

TEST_F(PlatformTableFile, ThatIsBadIsRefusedInOneLineWithFileLineAndReason) {
  for (const BadTable& bad : kBadTables) {
    const std::string refusal = RefusalOf(bad.text);
    EXPECT_THAT(refusal, StartsWith(path_ + bad.where)) << bad.text;
    EXPECT_THAT(refusal, HasSubstr(bad.what)) << bad.text;
    EXPECT_THAT(refusal, Not(HasSubstr("\n"))) << bad.text;
    EXPECT_THAT(refusal, Not(HasSubstr("line 0"))) << bad.text;  // there is none
  }
}

TEST_F(PlatformTableFile, ThatIsNotThereIsRefusedByItsName) {
  EXPECT_THROW((void)ReadPlatformTable(platform_folder_ / "none.csv"), BadInput);
}

}  // namespace
}  // namespace levitas::identification
