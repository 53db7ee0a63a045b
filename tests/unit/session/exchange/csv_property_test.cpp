// Measured files in every order of columns, every unit and both dialects give the same numbers; the
// rotor's angle and speed follow from each other by closed forms.

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "session/exchange/csv_import.hpp"
#include "tests/unit/session/log/synthetic.hpp"

namespace levitas::session {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kPeriodS = 1e-4;

RigNumbers Bench(std::size_t bearings) {
  RigNumbers rig;
  rig.name = "bench";
  for (std::size_t b = 0; b < bearings; ++b) {
    rig.bearings.push_back(fmt::format("b{}", b));
    rig.channels.push_back(fmt::format("b{}_x", b));
    rig.channels.push_back(fmt::format("b{}_y", b));
  }
  rig.period_ns = 100'000;
  return rig;
}

class MeasuredCsv : public ::testing::Test {
 protected:
  std::vector<cycle::CycleRecord> Import(const std::string& content, std::size_t bearings = 1) {
    WriteFile(csv_, content);
    (void)ImportCsv({.data_path = csv_,
                     .out_path = out_,
                     .rig = Bench(bearings),
                     .rig_yaml = "name: bench\n",
                     .program_version = "0.1.0",
                     .start_utc_ns = 5});
    SessionReader reader(out_);
    return ReadAll(reader);
  }
  std::string Refusal(const std::string& content) {
    try {
      (void)Import(content);
    } catch (const BadInput& problem) {
      return problem.what();
    }
    return "accepted";
  }

  Folder folder_;
  std::string csv_{folder_ / "data.csv"};
  std::string out_{folder_ / "s.lcmlog"};
};

/// One column of a drawn file: its name, and where its SI value comes from.
struct Column {
  std::string name;
  double factor;
  const double* si;
};

struct Unit {
  const char* suffix;
  double factor;
};
constexpr Unit kLengths[] = {{"m", 1.0}, {"mm", 1e3}, {"um", 1e6}};
constexpr Unit kCurrents[] = {{"a", 1.0}, {"ma", 1e3}};

template <class Item>
void Shuffle(std::vector<Item>& items, Random& draw) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[draw.Bits() % i]);
}

TEST_F(MeasuredCsv, GivesTheSameNumbersInAnyOrderUnitAndDialect) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random draw{seed};
    const std::size_t bearings = 1 + seed % 4;
    const RigNumbers rig = Bench(bearings);
    const std::size_t axes = rig.axes();
    AxisArray position_m{};
    AxisArray current_a{};
    AxisArray excitation_a{};
    double time_s = 0.0;
    std::vector<Column> columns{{"time_s", 1.0, &time_s}};
    std::array<bool, kMaxAxes> excited{};
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const Unit& length = kLengths[draw.Bits() % std::size(kLengths)];
      const Unit& current = kCurrents[draw.Bits() % std::size(kCurrents)];
      const std::string& channel = rig.channels[axis];
      columns.push_back({fmt::format("position_{}_{}", channel, length.suffix), length.factor,
                         &position_m[axis]});
      columns.push_back({fmt::format("control_current_{}_{}", channel, current.suffix),
                         current.factor, &current_a[axis]});
      excited[axis] = draw.Bits() % 2 == 0;  // any of the axes may have been shaken, or none
      if (!excited[axis]) continue;
      const Unit& shaken = kCurrents[draw.Bits() % std::size(kCurrents)];
      columns.push_back({fmt::format("excitation_{}_{}", channel, shaken.suffix), shaken.factor,
                         &excitation_a[axis]});
    }
    Shuffle(columns, draw);
    const bool spreadsheet = seed % 2 == 0;  // semicolons and decimal commas
    const char* separator = spreadsheet ? ";" : ",";

    std::string text;
    for (const Column& column : columns) text += (text.empty() ? "" : separator) + column.name;
    std::vector<cycle::CycleRecord> expected(20);
    for (std::size_t row = 0; row < expected.size(); ++row) {
      time_s = static_cast<double>(row) * kPeriodS;
      position_m = DrawAxes(draw, 1e-5, axes);
      current_a = DrawAxes(draw, 0.3, axes);
      for (std::size_t axis = 0; axis < axes; ++axis) {
        excitation_a[axis] = excited[axis] ? 0.01 * draw.Normal() : 0.0;
      }
      text += "\n";
      for (std::size_t i = 0; i < columns.size(); ++i) {
        std::string cell = fmt::format("{}", *columns[i].si * columns[i].factor);
        if (spreadsheet) std::replace(cell.begin(), cell.end(), '.', ',');
        text += (i == 0 ? "" : separator) + cell;
      }
      expected[row].in.frame.position_m = position_m;
      expected[row].out.current.control_current_a = current_a;
      expected[row].in.op.excitation_a = excitation_a;
    }

    const auto records = Import(text, bearings);
    ASSERT_EQ(records.size(), expected.size()) << "seed " << seed;
    for (std::size_t row = 0; row < records.size(); ++row) {
      ASSERT_EQ(records[row].in.cycle, row);
      for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
        // Two roundings, one on the way into the unit and one out of it: within 4 ULP.
        ASSERT_DOUBLE_EQ(records[row].in.frame.position_m[axis],
                         expected[row].in.frame.position_m[axis])
            << "seed " << seed;
        ASSERT_DOUBLE_EQ(records[row].out.current.control_current_a[axis],
                         expected[row].out.current.control_current_a[axis]);
        ASSERT_DOUBLE_EQ(records[row].in.op.excitation_a[axis],
                         expected[row].in.op.excitation_a[axis]);
      }
    }
  }
}

/// A file of one bearing with one more column; `value(row)` is what it holds.
template <class Value>
std::string WithColumn(const char* name, std::size_t rows, Value value) {
  std::string text = fmt::format(
      "time_s,position_b0_x_um,position_b0_y_um,control_current_b0_x_ma,control_current_b0_y_ma,"
      "{}\n",
      name);
  for (std::size_t row = 0; row < rows; ++row) {
    text += fmt::format("{},1,2,3,4,{}\n", static_cast<double>(row) * kPeriodS, value(row));
  }
  return text;
}

TEST_F(MeasuredCsv, AnglesOfASteadilyGrowingSpeedAreHalfTheRateTimesTimeSquared) {
  for (const double rate_rpm_per_s : {60'000.0, -60'000.0}) {  // both directions of rotation
    const auto records = Import(WithColumn("speed_rpm", 5000, [&](std::size_t row) {
      return rate_rpm_per_s * static_cast<double>(row) * kPeriodS;
    }));
    ASSERT_EQ(records.size(), 5000U);
    const double rate = RpmToRadPerS(rate_rpm_per_s);
    for (std::size_t row = 0; row < records.size(); ++row) {
      const double time_s = static_cast<double>(row) * kPeriodS;
      const double angle_rad = records[row].in.frame.angle_rad;
      ASSERT_GE(angle_rad, 0.0);
      ASSERT_LT(angle_rad, kTurn);
      // The trapezoidal rule is exact for a line; 1e-9 rad holds 5000 roundings of up to 800 rad.
      const double off = std::remainder(angle_rad - 0.5 * rate * time_s * time_s, kTurn);
      ASSERT_NEAR(off, 0.0, 1e-9) << row;
      ASSERT_NEAR(records[row].in.frame.speed_rad_per_s, rate * time_s, 1e-9);
      ASSERT_EQ(records[row].out.mode, row == 0 ? Mode::kLevitating : Mode::kSpinning);
    }
  }
}

TEST_F(MeasuredCsv, SpeedsOfASteadilyTurningAngleAreItsSlopeFromTheFirstRowOn) {
  for (const double speed_rad_per_s : {628.0, -628.0, 0.5}) {
    for (const bool wrapped : {false, true}) {
      const auto records = Import(WithColumn("rotor_angle_rad", 300, [&](std::size_t row) {
        const double angle_rad = 1.0 + speed_rad_per_s * static_cast<double>(row) * kPeriodS;
        return wrapped ? angle_rad - kTurn * std::floor(angle_rad / kTurn) : angle_rad;
      }));
      for (const auto& record : records) {
        // Over one period the roundings of 20 rad are 4e-15 rad: 1e-10 rad/s.
        ASSERT_NEAR(record.in.frame.speed_rad_per_s, speed_rad_per_s, 1e-9);
        ASSERT_GE(record.in.frame.angle_rad, 0.0);
        ASSERT_LT(record.in.frame.angle_rad, kTurn);
      }
    }
  }
}

// fmod of a tiny negative angle plus a turn rounds to the turn itself, which no frame may hold.
TEST_F(MeasuredCsv, AnAngleJustBelowZeroStaysBelowAWholeTurn) {
  for (const double angle_rad : {-1e-20, -1e-16, -5e-324, -0.0, kTurn, -kTurn, 1e15}) {
    const auto records =
        Import(WithColumn("rotor_angle_rad", 2, [&](std::size_t) { return angle_rad; }));
    ASSERT_EQ(records.size(), 2U);
    EXPECT_GE(records[0].in.frame.angle_rad, 0.0) << angle_rad;
    EXPECT_LT(records[0].in.frame.angle_rad, kTurn) << angle_rad;
  }
}

TEST_F(MeasuredCsv, TakesNumbersAsPeopleWriteThemAndRefusesWhatIsNone) {
  const auto speed = [](const char* cell) {
    return WithColumn("speed_rpm", 1, [&](std::size_t) { return cell; });
  };
  const std::pair<const char*, double> good[] = {
      {"3000", 3000.0},     {"+3000", 3000.0},   {"3e3", 3000.0}, {"-3.0E+3", -3000.0},
      {"\"3000\"", 3000.0}, {" 3000\t", 3000.0}, {".5", 0.5},     {"3000.", 3000.0}};
  for (const auto& [cell, rpm] : good) {
    const auto records = Import(speed(cell));
    ASSERT_EQ(records.size(), 1U) << cell;
    EXPECT_DOUBLE_EQ(records[0].in.frame.speed_rad_per_s, RpmToRadPerS(rpm)) << cell;
  }
  for (const char* cell : {"+-3000", "++3000", "--3000", "3000 rpm", "0x10", "1e", "1e999", "nan",
                           "-inf", "", "-", "\"\"", "3 000", "3.000.000"}) {
    EXPECT_THAT(Refusal(speed(cell)), HasSubstr("line 2: column 6 (speed_rpm)")) << cell;
  }
}

TEST_F(MeasuredCsv, RefusesAChannelGivenInTwoUnits) {
  EXPECT_THAT(Refusal(WithColumn("position_b0_x_mm", 1, [](std::size_t) { return 1; })),
              HasSubstr("column 6 \"position_b0_x_mm\" is given twice"));
}

TEST_F(MeasuredCsv, OffersTheRightNameForEveryUnitThatIsNone) {
  for (const char* name : {"position_b0_x_km", "position_b0_x", "excitation_b0_y_v",
                           "excitation_b1_y_a", "control_current_b0_x_A", "speed_rmp"}) {
    const std::string text = Refusal(WithColumn(name, 1, [](std::size_t) { return 1; }));
    EXPECT_THAT(text, HasSubstr(fmt::format("column 6 \"{}\" is not known", name)));
    EXPECT_THAT(text, HasSubstr("did you mean \""));
  }
}

TEST_F(MeasuredCsv, CountsEveryPeriodOfRandomDropOuts) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random draw{seed};
    std::vector<std::uint64_t> cycles{0};
    std::uint64_t gaps = 0;
    for (int i = 0; i < 200; ++i) {
      const std::uint64_t step = draw.Bits() % 10 == 0 ? 2 + draw.Bits() % 5000 : 1;
      gaps += step > 1 ? 1 : 0;
      cycles.push_back(cycles.back() + step);
    }
    std::string text =
        "time_s,position_b0_x_m,position_b0_y_m,control_current_b0_x_a,control_current_b0_y_a\n";
    for (const std::uint64_t cycle : cycles) {
      // A clock that wanders by a fifth of a period is still on the grid.
      const double jitter = 0.1 * (2.0 * draw.Uniform() - 1.0);
      text += fmt::format("{},0,0,0,0\n", (static_cast<double>(cycle) + jitter) * kPeriodS);
    }
    WriteFile(csv_, text);
    const ImportReport report = ImportCsv({.data_path = csv_,
                                           .out_path = out_,
                                           .rig = Bench(1),
                                           .rig_yaml = "name: bench\n",
                                           .program_version = "0.1.0",
                                           .start_utc_ns = 0});
    EXPECT_EQ(report.rows, cycles.size()) << "seed " << seed;
    EXPECT_EQ(report.drop_outs, gaps);
    EXPECT_EQ(report.missing_cycles, cycles.back() + 1 - cycles.size());
    SessionReader reader(out_);
    const auto records = ReadAll(reader);
    ASSERT_EQ(records.size(), cycles.size());
    for (std::size_t i = 0; i < cycles.size(); ++i) ASSERT_EQ(records[i].in.cycle, cycles[i]);
    EXPECT_EQ(reader.damage().missing_cycles, report.missing_cycles);
  }
}

}  // namespace
}  // namespace levitas::session
