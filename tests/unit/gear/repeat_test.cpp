#include "plant_sim/gear/repeat.hpp"

#include <gtest/gtest.h>

#include <utility>

namespace levitas::gear {
namespace {

GearPair Pair(int driving, int driven) {
  GearPair pair;
  pair.driving.teeth = driving;
  pair.driven.teeth = driven;
  return pair;
}

TEST(TurnsPerRepeat, AreThoseAfterWhichBothWheelsStandAlike) {
  for (const auto& [driving, driven] :
       {std::pair{20, 40}, {40, 20}, {23, 37}, {24, 36}, {17, 17}}) {
    const int turns = TurnsPerRepeat(Pair(driving, driven));
    EXPECT_EQ(turns * driving % driven, 0) << driving << " " << driven;
    for (int fewer = 1; fewer < turns; ++fewer) {
      ASSERT_NE(fewer * driving % driven, 0) << driving << " " << driven << " " << fewer;
    }
  }
}

}  // namespace
}  // namespace levitas::gear
