#include "session/trip_budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "session/trip_freezer.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::session {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TripBudgetTest : public testing::Test {
 protected:
  /// A trip file of `bytes`, so many minutes after an hour.
  std::string Trip(int minute, std::size_t bytes = 10) {
    // 1 763 700 300 s after 1970 is 2025-11-21 04:45:00 UTC (date -u -d @1763700300).
    const std::int64_t utc_ns = (1'763'700'300LL + 60 * minute) * 1'000'000'000;
    std::string name = TripFileName(utc_ns, Fault::kOverSpeed);
    Write(name, bytes);
    return name;
  }
  void Write(const std::string& name, std::size_t bytes = 10) {
    std::ofstream(scratch_ / name) << std::string(bytes, 'x');
  }
  [[nodiscard]] bool Is(const std::string& name) const {
    return std::filesystem::exists(scratch_ / name);
  }

  test::ScratchFolder scratch_;
};

TEST_F(TripBudgetTest, LeavesTheNewestOfTooMany) {
  const std::string oldest = Trip(1);
  const std::string middle = Trip(2);
  const std::string newest = Trip(3);
  EXPECT_THAT(KeepWithin({.files = 2, .bytes = 1000}, scratch_ / "", newest), ElementsAre(oldest));
  EXPECT_FALSE(Is(oldest));
  EXPECT_TRUE(Is(middle));
  EXPECT_TRUE(Is(newest));
}

TEST_F(TripBudgetTest, LeavesTheNewestWithinTheBytes) {
  const std::string small = Trip(1, 1);
  const std::string large = Trip(2, 60);
  const std::string newest = Trip(3, 50);
  // The small one would fit, but it is older than one that does not.
  EXPECT_THAT(KeepWithin({.files = 9, .bytes = 100}, scratch_ / "", newest),
              ElementsAre(large, small));
  EXPECT_TRUE(Is(newest));
}

TEST_F(TripBudgetTest, NeverRemovesTheNewest) {
  const std::string newest = Trip(3, 500);
  EXPECT_THAT(KeepWithin({.files = 1, .bytes = 100}, scratch_ / "", newest), IsEmpty());
  EXPECT_TRUE(Is(newest));
}

TEST_F(TripBudgetTest, CountsTheFilesOfOneMillisecondInTheirOrder) {
  const std::string first = Trip(1);
  std::string second = first;
  second.insert(second.rfind('.'), "-2");
  std::string tenth = first;
  tenth.insert(tenth.rfind('.'), "-10");
  Write(second);
  Write(tenth);
  EXPECT_THAT(KeepWithin({.files = 1, .bytes = 1000}, scratch_ / "", tenth),
              ElementsAre(second, first));
}

TEST_F(TripBudgetTest, TouchesNoFileOfOthers) {
  const std::string newest = Trip(9);
  const std::string linked = "trip-20251121T044501.123Z-over_speed.lcmlog";
  std::filesystem::create_symlink(scratch_ / newest, scratch_ / linked);
  const std::vector<std::string> others{
      "trip.lcmlog",
      "trip-20251121T044501.123Z-holiday.lcmlog",
      "trip-20251121T044501.123Z-over_speed.lcmlog.bak",
      "my-trip-20251121T044501.123Z-over_speed.lcmlog",
      "trip-2025-11-21-over_speed.lcmlog",
  };
  for (const std::string& name : others) Write(name);
  const std::string folder = "trip-20251121T044502.123Z-over_speed.lcmlog";
  std::filesystem::create_directory(scratch_ / folder);
  EXPECT_THAT(KeepWithin({.files = 1, .bytes = 1}, scratch_ / "", newest), IsEmpty());
  for (const std::string& name : others) EXPECT_TRUE(Is(name)) << name;
  EXPECT_TRUE(Is(folder));
  EXPECT_TRUE(Is(linked));
}

TEST_F(TripBudgetTest, KnowsTheNameOfEveryFault) {
  for (std::size_t i = 1; i < kFaultCount; ++i) {
    EXPECT_TRUE(IsTripFileName(TripFileName(1'763'700'300'000'000'000, static_cast<Fault>(i))));
  }
}

TEST_F(TripBudgetTest, SurvivesAFolderThatIsNotThere) {
  EXPECT_THAT(KeepWithin({}, scratch_ / "none", "x"), IsEmpty());
}

}  // namespace
}  // namespace levitas::session
