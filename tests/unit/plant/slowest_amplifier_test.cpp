#include "plant_sim/plant/slowest_amplifier.hpp"

#include <gtest/gtest.h>

namespace levitas::plant {
namespace {

PlantConfig WithAmplifiers(const std::vector<double>& bandwidths_hz) {
  PlantConfig rig;
  rig.bearings.resize(bandwidths_hz.size());
  for (std::size_t b = 0; b < bandwidths_hz.size(); ++b) {
    rig.bearings[b].amplifier.bandwidth_hz = bandwidths_hz[b];
  }
  return rig;
}

TEST(SlowestAmplifier, IsTheLeastBandwidthOfThoseThatHaveALimit) {
  EXPECT_EQ(SlowestAmplifierHz(WithAmplifiers({2000.0, 1500.0})), 1500.0);
  EXPECT_EQ(SlowestAmplifierHz(WithAmplifiers({0.0, 1800.0})), 1800.0);
  EXPECT_EQ(SlowestAmplifierHz(WithAmplifiers({0.0, 0.0})), 0.0);
}

}  // namespace
}  // namespace levitas::plant
