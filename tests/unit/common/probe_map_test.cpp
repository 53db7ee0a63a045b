#include "common/probe_map.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace levitas {
namespace {

RigNumbers Wired(AxisArray sensor, AxisArray actuator) {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.sensor_polarity = sensor;
  rig.actuator_polarity = actuator;
  return rig;
}

TEST(ProbeMap, FlipsOnlyTheInvertedProbe) {
  const ProbeMap map(Wired({1, -1, 1, 1}, {1, 1, 1, 1}));
  const AxisArray read_m{1e-6, 2e-6, 3e-6, 4e-6};
  EXPECT_EQ(map.Positions({read_m}).at, (AxisArray{1e-6, -2e-6, 3e-6, 4e-6}));
  EXPECT_EQ(map.Currents({read_m}).at, read_m);
}

TEST(ProbeMap, FlipsOnlyTheInvertedCoil) {
  const ProbeMap map(Wired({1, 1, 1, 1}, {1, 1, 1, -1}));
  EXPECT_EQ(map.Currents({{0.1, 0.2, 0.3, 0.4}}).at, (AxisArray{0.1, 0.2, 0.3, -0.4}));
}

TEST(ProbeMap, LeavesNothingBeyondTheRigsAxes) {
  const ProbeMap map(Wired({1, 1, 1, 1}, {1, 1, 1, 1}));
  EXPECT_EQ(map.Positions({{0, 0, 0, 0, 5.0, 6.0, 7.0, 8.0}}).at, AxisArray{});
}

TEST(ProbeMap, GivesBackTheReadingsOfThePositionsThatItMade) {
  const ProbeMap map(Wired({1, -1, -1, 1}, {-1, 1, 1, 1}));
  const RigFrame read_m{{1e-6, -2e-6, 3e-6, -4e-6}};
  EXPECT_EQ(map.Readings(map.Positions(read_m)).at, read_m.at);
}

TEST(ProbeMap, RefusesAPolarityThatIsNotASign) {
  for (const double bad : {0.0, 2.0, -0.5, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(ProbeMap(Wired({1, 1, bad, 1}, {1, 1, 1, 1})), std::invalid_argument);
    EXPECT_THROW(ProbeMap(Wired({1, 1, 1, 1}, {bad, 1, 1, 1})), std::invalid_argument);
  }
}

}  // namespace
}  // namespace levitas
