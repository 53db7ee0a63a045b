// Numbers that a rig cannot have: told at import, refused where nothing of a column can be true.

#include "session/exchange/plausible_values.hpp"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/problem.hpp"
#include "session/exchange/csv_import.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// Probe of +-0.4 mm, clearance 0.2 mm, amplifier of 4 A.
RigNumbers OneAxis() {
  RigNumbers rig;
  rig.name = "bench";
  rig.channels = {"x"};
  rig.bearings = {"b"};
  rig.period_ns = 100'000;
  rig.bias_current_a = 2.0;
  rig.max_coil_current_a = 4.0;
  rig.sensor_range_m = 400e-6;
  rig.clearance_m = 200e-6;
  return rig;
}

class Plausible : public ::testing::Test {
 protected:
  /// A whirl of `orbit` about `middle`, and a current of `current`, in the numbers of the file.
  ImportReport Import(const std::string& map, double orbit, double middle, double current,
                      double outlier = 0.0) {
    std::string text = "X\tI\n";
    for (int n = 0; n < 1000; ++n) {
      const double turn = std::sin(0.1 * n);
      text += fmt::format("{}\t{}\n", n == 500 ? middle + outlier : middle + orbit * turn,
                          current * turn);
    }
    WriteFile(folder_ / "d.txt", text);
    const ColumnMap columns =
        ParseColumnMap("kind: import_map\nrate_hz: 10000\ncolumns:\n" + map, "map.yaml");
    ImportOptions options;
    options.data_path = folder_ / "d.txt";
    options.out_path = folder_ / "s.lcmlog";
    options.rig = OneAxis();
    options.rig_yaml = "name: bench\n";
    options.map = &columns;
    return ImportCsv(options);
  }
  std::string Refusal(const std::string& map, double orbit, double current) {
    try {
      Import(map, orbit, 0.0, current);
    } catch (const BadInput& problem) {
      EXPECT_FALSE(std::filesystem::exists(folder_ / "s.lcmlog"));
      return problem.what();
    }
    return "accepted";
  }
  static std::string Map(const std::string& position, const std::string& current) {
    return "  - {column: X, is: position_x, unit: " + position +
           "}\n  - {column: I, is: control_current_x, unit: " + current + "}\n";
  }
  Folder folder_;
};

TEST_F(Plausible, NumbersAreTakenWithoutAWord) {
  EXPECT_THAT(Import(Map("um", "ma"), 20.0, 0.0, 500.0).implausible, IsEmpty());
  std::filesystem::remove(folder_ / "s.lcmlog");
  // All of the clearance, and a command beyond what the amplifier gives, as laws ask for.
  EXPECT_THAT(Import(Map("um", "a"), 200.0, 0.0, 7.9).implausible, IsEmpty());
}

TEST_F(Plausible, PositionsThatAreAThousandTimesTooLargeAreRefusedWithTheUnitTheyFit) {
  EXPECT_THAT(Refusal(Map("mm", "ma"), 20.0, 500.0),
              AllOf(HasSubstr("column \"X\" (position of x) reaches 20 mm"),
                    HasSubstr("its probe reads to 0.4 mm, the rotor moves by 0.2 mm (rig bench)"),
                    HasSubstr("likely its numbers are in um, not in mm"), HasSubstr("--map"),
                    Not(HasSubstr("\"I\""))));
  EXPECT_THAT(Refusal(Map("m", "ma"), 20.0, 500.0),
              HasSubstr("likely its numbers are in um, not in m\n"));
  EXPECT_THAT(Refusal("  - {column: X, is: position_x, unit: mm, scale: 125}\n"
                      "  - {column: I, is: control_current_x, unit: ma}\n",
                      0.16, 500.0),
              HasSubstr("its scale is 1000 times too large"));
}

TEST_F(Plausible, PositionsThatAreAThousandTimesTooSmallAreDoubted) {
  const auto small = Import(Map("um", "ma"), 0.02, 0.0, 500.0);
  ASSERT_THAT(small.implausible, SizeIs(1));
  EXPECT_FALSE(small.implausible[0].impossible);
  EXPECT_THAT(small.implausible[0].sentence,
              AllOf(HasSubstr("column \"X\" scatters by 0.0142 um only"),
                    HasSubstr("likely its numbers are in mm, not in um")));
}

TEST_F(Plausible, CurrentsThatAreAThousandTimesTooLargeAreRefused) {
  EXPECT_THAT(Refusal(Map("um", "a"), 20.0, 500.0),
              AllOf(HasSubstr("column \"I\" (current of x) reaches 500 A"),
                    HasSubstr("the amplifiers give 4 A"),
                    HasSubstr("likely its numbers are in ma, not in a")));
}

TEST_F(Plausible, WhatMayBeTrueIsDoubtedAndTaken) {
  for (const double middle_um : {300.0, 600.0}) {  // beyond the clearance, and beyond the range
    const auto offset = Import(Map("um", "ma"), 20.0, middle_um, 500.0);
    ASSERT_THAT(offset.implausible, SizeIs(1));
    EXPECT_FALSE(offset.implausible[0].impossible);
    EXPECT_THAT(offset.implausible[0].sentence,
                HasSubstr(fmt::format("about {:g} mm away from zero: is that its offset?",
                                      1e-3 * middle_um)));
    std::filesystem::remove(folder_ / "s.lcmlog");
  }
  const auto glitch = Import(Map("um", "ma"), 20.0, 0.0, 500.0, 1e6);
  ASSERT_THAT(glitch.implausible, SizeIs(1));
  EXPECT_FALSE(glitch.implausible[0].impossible);
  EXPECT_THAT(glitch.implausible[0].sentence,
              AllOf(HasSubstr("and 0.1 % of its numbers are beyond"), Not(HasSubstr("likely"))));
  std::filesystem::remove(folder_ / "s.lcmlog");
  const auto current = Import(Map("um", "a"), 20.0, 0.0, 9.0);
  ASSERT_THAT(current.implausible, SizeIs(1));
  EXPECT_THAT(current.implausible[0].sentence, HasSubstr("reaches 9 A"));
}

}  // namespace
}  // namespace levitas::session
