// Stretches of a record that hold its test signals where even ones would miss them.

#include "diagnosis/inference/excited_windows.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kLongRows = 1'000;
constexpr std::size_t kShortest = 50;

/// 1000 levitated rows, turning fast from 700 on; +-0.1 A on an axis where `Excite` says so.
std::vector<analysis::RecordedRow> LongRecord() {
  std::vector<analysis::RecordedRow> rows(kLongRows);
  for (std::size_t n = 0; n < kLongRows; ++n) {
    rows[n].levitated = true;
    rows[n].sample.speed_rad_per_s = n < 700 ? 10.0 : -100.0;
  }
  return rows;
}

void Excite(std::vector<analysis::RecordedRow>& rows, std::size_t axis, const Window& where) {
  for (std::size_t n = where.first; n < where.first + where.length; ++n) {
    rows[n].excitation_a[axis] = n % 2 == 0 ? 0.1 : -0.1;
  }
}

bool Holds(const std::vector<Window>& windows, const Window& signal) {
  return std::any_of(windows.begin(), windows.end(), [&signal](const Window& window) {
    return window.first <= signal.first &&
           signal.first + signal.length <= window.first + window.length;
  });
}

bool SameWindows(const std::vector<Window>& one, const std::vector<Window>& other) {
  return std::equal(
      one.begin(), one.end(), other.begin(), other.end(),
      [](const Window& a, const Window& b) { return a.first == b.first && a.length == b.length; });
}

const std::vector<Window> kEven{{0, 100}, {450, 100}, {900, 100}};

// Three stretches: one for each signal, and one where the rotor turns fast.
TEST(TellingWindows, HoldEachAxisSignalAndTheFastestRotationInOrderOfTime) {
  constexpr Window kOne{200, 60};
  constexpr Window kOther{600, 60};
  auto rows = LongRecord();
  Excite(rows, 3, kOne);
  Excite(rows, 0, kOther);
  const std::vector<Window> windows = TellingWindows(rows, kEven, kShortest);
  EXPECT_TRUE(Holds(windows, kOne));
  EXPECT_TRUE(Holds(windows, kOther));
  EXPECT_TRUE(std::any_of(windows.begin(), windows.end(), [](const Window& window) {
    return window.first + window.length / 2 >= 700;
  })) << "either sense of rotation is fast";
  std::size_t length = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    length += windows[i].length;
    EXPECT_LE(windows[i].first + windows[i].length, kLongRows);
    if (i == 0) continue;
    EXPECT_GE(windows[i].first, windows[i - 1].first + windows[i - 1].length);
  }
  EXPECT_LE(length, 300U) << "no more rows than the even ones";
}

TEST(TellingWindows, AreTheEvenOnesWithoutASignalOfALevitatedRotor) {
  auto rows = LongRecord();
  EXPECT_TRUE(SameWindows(TellingWindows(rows, kEven, kShortest), kEven));
  Excite(rows, 1, {200, 60});
  for (std::size_t n = 0; n < 300; ++n) rows[n].levitated = false;
  EXPECT_TRUE(SameWindows(TellingWindows(rows, kEven, kShortest), kEven));
}

// The even ones are 0.3 of the rows; half of that share of a signal of 200 rows is 30 rows.
TEST(TellingWindows, AreTheEvenOnesWhereTheseHoldHalfTheirShareOfTheSignal) {
  auto rows = LongRecord();
  Excite(rows, 1, {510, 200});
  EXPECT_TRUE(SameWindows(TellingWindows(rows, kEven, kShortest), kEven)) << "40 of 200 rows";
  rows = LongRecord();
  Excite(rows, 1, {530, 200});
  EXPECT_FALSE(SameWindows(TellingWindows(rows, kEven, kShortest), kEven)) << "20 of 200 rows";
}

TEST(TellingWindows, AreTheEvenOnesWhereAStretchOfEachAxisWouldOnlySettle) {
  auto rows = LongRecord();
  Excite(rows, 0, {200, 60});
  Excite(rows, 1, {600, 60});
  constexpr std::size_t kTooLong = 160;  // 300 rows hold one of them, not two
  EXPECT_TRUE(SameWindows(TellingWindows(rows, kEven, kTooLong), kEven));
}

}  // namespace
}  // namespace levitas::diagnosis
