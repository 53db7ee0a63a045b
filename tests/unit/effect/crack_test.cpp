#include "plant_sim/effect/crack.hpp"

#include <gtest/gtest.h>

namespace levitas::effect {
namespace {

TEST(CrackCompliance, GrowsWithTheSquareOfASmallDepth) {
  // Leading term 6 pi (1 - nu^2) 0.6272 depth^2; the next is 1.67 depth of it.
  const double depth = 1e-3;
  const double leading = 6.0 * std::numbers::pi * (1.0 - 0.3 * 0.3) * 0.6272 * depth * depth;
  EXPECT_NEAR(CrackCompliance(depth, 0.3) / leading, 1.0, 2.0 * depth);
  EXPECT_EQ(CrackCompliance(0.0, 0.3), 0.0);
}

TEST(CrackCompliance, NeverFallsWithDepth) {
  for (double depth = 0.0; depth < 0.49; depth += 0.01) {
    EXPECT_LT(CrackCompliance(depth, 0.3), CrackCompliance(depth + 0.01, 0.3)) << depth;
  }
}

TEST(Opening, IsFullAlongGravityNoneAgainstItAndHalfAcross) {
  const double gx = std::cos(3.9);
  const double gy = std::sin(3.9);
  EXPECT_NEAR(Opening(gx, gy, gx, gy), 1.0, 1e-15);
  EXPECT_NEAR(Opening(-gx, -gy, gx, gy), 0.0, 1e-15);
  EXPECT_NEAR(Opening(-gy, gx, gx, gy), 0.5, 1e-15);
}

}  // namespace
}  // namespace levitas::effect
