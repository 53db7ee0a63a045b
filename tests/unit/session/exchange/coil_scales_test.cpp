#include "session/exchange/coil_scales.hpp"

#include <gtest/gtest.h>

namespace levitas::session {
namespace {

/// Bearings whose gaps are 1, 2, ... mm and whose largest currents 10, 20, ... A.
plant::PlantConfig RigOfUnlikeMagnets(std::size_t bearings) {
  plant::PlantConfig rig;
  rig.bearings.resize(bearings);
  double number = 0.0;
  for (plant::BearingConfig& bearing : rig.bearings) {
    number += 1.0;
    bearing.magnet.gap_m = number * 1e-3;
    bearing.magnet.max_coil_current_a = number * 10.0;
    bearing.magnet.bias_current_a = 3.0;  // of neither
  }
  return rig;
}

TEST(CoilScales, OfTheTwoAxesOfABearingAreThoseOfItsMagnet) {
  const std::vector<CoilScale> scales = CoilScales(RigOfUnlikeMagnets(2), 4);
  ASSERT_EQ(scales.size(), 4U);
  for (std::size_t axis = 0; axis < 4; ++axis) {
    SCOPED_TRACE(axis);
    const double number = axis < 2 ? 1.0 : 2.0;
    EXPECT_EQ(scales[axis].gap_m, number * 1e-3);
    EXPECT_EQ(scales[axis].full_current_a, number * 10.0);
  }
}

TEST(CoilScales, OfARigOfOneAxisAreOne) {
  const std::vector<CoilScale> scales = CoilScales(RigOfUnlikeMagnets(1), 1);
  ASSERT_EQ(scales.size(), 1U);
  EXPECT_EQ(scales[0].gap_m, 1e-3);
}

}  // namespace
}  // namespace levitas::session
