#include "verdict/zones.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace levitas::verdict {
namespace {

// Borders of ISO 14839-2: 0.3, 0.4 and 0.5 of the clearance.
TEST(ClearanceZone, PutsAValueOnABorderIntoTheWorseZone) {
  EXPECT_EQ(ClearanceZone(0.0), Zone::kA);
  EXPECT_EQ(ClearanceZone(std::nextafter(0.3, 0.0)), Zone::kA);
  EXPECT_EQ(ClearanceZone(0.3), Zone::kB);
  EXPECT_EQ(ClearanceZone(std::nextafter(0.4, 0.0)), Zone::kB);
  EXPECT_EQ(ClearanceZone(0.4), Zone::kC);
  EXPECT_EQ(ClearanceZone(std::nextafter(0.5, 0.0)), Zone::kC);
  EXPECT_EQ(ClearanceZone(0.5), Zone::kD);
  EXPECT_EQ(ClearanceZone(1.0), Zone::kD);
}

TEST(ClearanceZone, GivesTheWorstZoneToWhatIsNotANumber) {
  EXPECT_EQ(ClearanceZone(std::numeric_limits<double>::quiet_NaN()), Zone::kD);
  EXPECT_EQ(ClearanceZone(std::numeric_limits<double>::infinity()), Zone::kD);
}

TEST(Zone, OnlyTheFirstTwoMayBeHandedOver) {
  EXPECT_TRUE(Acceptable(Zone::kA));
  EXPECT_TRUE(Acceptable(Zone::kB));
  EXPECT_FALSE(Acceptable(Zone::kC));
  EXPECT_FALSE(Acceptable(Zone::kD));
  EXPECT_EQ(Letter(Zone::kA), 'A');
  EXPECT_EQ(Letter(Zone::kD), 'D');
}

}  // namespace
}  // namespace levitas::verdict
