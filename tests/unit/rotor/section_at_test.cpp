#include "plant_sim/rotor/section_at.hpp"

#include <gtest/gtest.h>

namespace levitas::rotor {
namespace {

/// Pieces of 0.1, 0.2 and 0.3 m, told apart by their diameters.
RotorConfig ThreePieces() {
  RotorConfig config;
  config.sections = {{0.1, 1.0, 0.0}, {0.2, 2.0, 0.0}, {0.3, 3.0, 0.0}};
  return config;
}
double Diameter(double z_m) { return SectionAt(ThreePieces(), z_m).outer_diameter_m; }

TEST(SectionAt, IsThePieceAroundThePlace) {
  EXPECT_EQ(Diameter(0.05), 1.0);
  EXPECT_EQ(Diameter(0.15), 2.0);
  EXPECT_EQ(Diameter(0.5), 3.0);
}

TEST(SectionAt, TheDriveEndIsTheFirstPieceAndAnEdgeTheLaterOne) {
  EXPECT_EQ(Diameter(0.0), 1.0);
  EXPECT_EQ(Diameter(0.1), 2.0);
}

TEST(SectionAt, BeyondTheEndIsTheLastPiece) {
  EXPECT_EQ(Diameter(0.7), 3.0);
  EXPECT_EQ(Diameter(100.0), 3.0);
}

}  // namespace
}  // namespace levitas::rotor
