#include "session/log/trip_budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "session/log/trip_freezer.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::session {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class TripBudgetTest : public ::testing::Test {
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
  std::vector<std::string> written{oldest, middle, newest};
  EXPECT_THAT(KeepWithin({.files = 2, .bytes = 1000}, scratch_ / "", written), ElementsAre(oldest));
  EXPECT_THAT(written, ElementsAre(middle, newest));
  EXPECT_FALSE(Is(oldest));
  EXPECT_TRUE(Is(middle));
  EXPECT_TRUE(Is(newest));
}

TEST_F(TripBudgetTest, LeavesTheNewestWithinTheBytes) {
  std::vector<std::string> written{Trip(1, 1), Trip(2, 60), Trip(3, 50)};
  const std::vector<std::string> all = written;
  // The small one would fit, but it is older than one that does not.
  EXPECT_THAT(KeepWithin({.files = 9, .bytes = 100}, scratch_ / "", written),
              ElementsAre(all[1], all[0]));
  EXPECT_TRUE(Is(all[2]));
}

TEST_F(TripBudgetTest, NeverRemovesTheNewest) {
  std::vector<std::string> written{Trip(3, 500)};
  EXPECT_THAT(KeepWithin({.files = 1, .bytes = 100}, scratch_ / "", written), IsEmpty());
  EXPECT_TRUE(Is(written[0]));
}

TEST_F(TripBudgetTest, NeitherCountsNorRemovesWhatThisRunHasNotWritten) {
  std::vector<std::string> earlier;
  for (int minute = 1; minute <= 31; ++minute) earlier.push_back(Trip(minute, 60));
  std::vector<std::string> written{Trip(40, 60)};
  EXPECT_THAT(KeepWithin({.files = 1, .bytes = 100}, scratch_ / "", written), IsEmpty());
  for (const std::string& name : earlier) EXPECT_TRUE(Is(name)) << name;
  const OlderTrips older = OlderTripFiles(scratch_ / "", written);
  EXPECT_EQ(older.files, 31U);
  EXPECT_EQ(older.bytes, 31U * 60U);
}

TEST_F(TripBudgetTest, LeavesALinkAloneThatOthersHavePutInThePlaceOfAFile) {
  std::vector<std::string> written{Trip(1), Trip(2)};
  Write("precious");
  const std::string linked = written[0];
  std::filesystem::remove(scratch_ / linked);
  std::filesystem::create_symlink(scratch_ / "precious", scratch_ / linked);
  EXPECT_THAT(KeepWithin({.files = 1, .bytes = 1}, scratch_ / "", written), IsEmpty());
  EXPECT_TRUE(std::filesystem::is_symlink(scratch_ / linked));
  EXPECT_TRUE(Is("precious"));
}

TEST_F(TripBudgetTest, KnowsNoFileOfOthersAsATripFile) {
  const std::vector<std::string> others{
      "trip.lcmlog",
      "trip-20251121T044501.123Z-holiday.lcmlog",
      "trip-20251121T044501.123Z-over_speed.lcmlog.bak",
      "my-trip-20251121T044501.123Z-over_speed.lcmlog",
      "trip-2025-11-21-over_speed.lcmlog",
  };
  for (const std::string& name : others) Write(name);
  std::filesystem::create_directory(scratch_ / "trip-20251121T044502.123Z-over_speed.lcmlog");
  EXPECT_EQ(OlderTripFiles(scratch_ / "", {}).files, 0U);
}

TEST_F(TripBudgetTest, KnowsTheNameOfEveryFault) {
  for (std::size_t i = 1; i < kFaultCount; ++i) {
    EXPECT_TRUE(IsTripFileName(TripFileName(1'763'700'300'000'000'000, static_cast<Fault>(i))));
  }
}

TEST_F(TripBudgetTest, SurvivesAFolderThatIsNotThere) {
  std::vector<std::string> written{"x"};
  EXPECT_THAT(KeepWithin({}, scratch_ / "none", written), IsEmpty());
  EXPECT_EQ(OlderTripFiles(scratch_ / "none", {}).files, 0U);
}

}  // namespace
}  // namespace levitas::session
