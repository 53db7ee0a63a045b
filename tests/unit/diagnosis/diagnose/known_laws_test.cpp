// The speeds of the records that were made with a law.

#include "diagnosis/diagnose/known_laws.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace levitas::diagnosis {
namespace {

TEST(LawOfRecords, SpansTheSpeedsOfItsRecordsInWhateverOrderTheyCome) {
  LawOfRecords law;
  for (const double speed_rad_per_s : {300.0, 120.0, 250.0}) law.Add(speed_rad_per_s);
  EXPECT_EQ(law.slowest_rad_per_s, 120.0);
  EXPECT_EQ(law.fastest_rad_per_s, 300.0);
}

TEST(LawOfRecords, OfOneRecordIsAsSlowAsItIsFast) {
  LawOfRecords law;
  law.Add(80.0);
  EXPECT_EQ(law.slowest_rad_per_s, 80.0);
  EXPECT_EQ(law.fastest_rad_per_s, 80.0);
}

TEST(LawOfRecords, KnowsARecordAtRestFromNone) {
  LawOfRecords law;
  EXPECT_TRUE(std::isinf(law.slowest_rad_per_s));
  EXPECT_EQ(law.fastest_rad_per_s, 0.0);
  law.Add(0.0);
  EXPECT_EQ(law.slowest_rad_per_s, 0.0);
  EXPECT_EQ(law.fastest_rad_per_s, 0.0);
}

}  // namespace
}  // namespace levitas::diagnosis
