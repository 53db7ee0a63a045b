// Corrections on holes: closed forms, limits, drilling.
#include "identification/balance/hole_split.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/random.hpp"
#include "common/two_pi.hpp"

namespace levitas::balancing {
namespace {

using Complex = std::complex<double>;

CorrectionPlane Holes(std::size_t holes) { return {"disc", 0.3, 0.03, holes, 0.0, 0.0, 0.0}; }

Complex MomentOf(const PlacedWeights& placed, double radius_m) {
  Complex sum = 0.0;
  for (const Weight& weight : placed.weights) {
    sum += std::polar(weight.mass_kg * radius_m, weight.angle_rad);
  }
  return sum;
}

TEST(HoleSplit, HalfwayBetweenTwoHolesBothTakeTheSame) {
  // m/(2 cos(15 deg)) each of twelve holes' neighbours.
  const Complex wanted = std::polar(6e-6, 15.0 * std::numbers::pi / 180.0);
  const PlacedWeights placed = PlaceWeights(wanted, Holes(12), false);
  ASSERT_EQ(placed.weights.size(), 2U);
  EXPECT_EQ(placed.weights[0].hole, 1U);
  EXPECT_EQ(placed.weights[1].hole, 2U);
  const double each_kg = 0.5 * 6e-6 / 0.03 / std::cos(std::numbers::pi / 12.0);
  EXPECT_NEAR(placed.weights[0].mass_kg, each_kg, 1e-15);
  EXPECT_NEAR(placed.weights[1].mass_kg, each_kg, 1e-15);
}

TEST(HoleSplit, OnAHoleThatHoleTakesAll) {
  CorrectionPlane plane = Holes(8);
  plane.first_hole_rad = 0.3;
  const PlacedWeights placed =
      PlaceWeights(std::polar(4e-6, 0.3 + 3.0 * kTwoPi / 8.0), plane, false);
  ASSERT_EQ(placed.weights.size(), 1U);
  EXPECT_EQ(placed.weights[0].hole, 4U);
  EXPECT_NEAR(placed.weights[0].mass_kg, 4e-6 / 0.03, 1e-12);
}

TEST(HoleSplit, AnyDirectionIsMetExactlyWithoutNegativeMass) {
  Random draw(7);
  for (int i = 0; i < 1000; ++i) {
    const Complex wanted = std::polar(1e-5 * draw.Uniform(), kTwoPi * (draw.Uniform() - 0.5));
    const auto holes = static_cast<std::size_t>(3 + 20 * draw.Uniform());
    const PlacedWeights placed = PlaceWeights(wanted, Holes(holes), false);
    EXPECT_LT(std::abs(placed.moment_kg_m - wanted), 1e-9 * std::abs(wanted) + 1e-18);
    EXPECT_LE(placed.weights.size(), 2U);
    for (const Weight& weight : placed.weights) EXPECT_GT(weight.mass_kg, 0.0);
  }
}

TEST(HoleSplit, AFullHolePassesTheRestToItsNeighbours) {
  CorrectionPlane plane = Holes(12);
  plane.largest_kg = 1e-4;
  const Complex wanted(0.03 * 2.2e-4, 0.0);  // 0.22 g where a hole takes 0.1 g
  const PlacedWeights placed = PlaceWeights(wanted, plane, false);
  EXPECT_LT(std::abs(placed.moment_kg_m - wanted), 1e-6 * std::abs(wanted));
  EXPECT_GE(placed.weights.size(), 3U);
  for (const Weight& weight : placed.weights) EXPECT_LE(weight.mass_kg, plane.largest_kg);
}

TEST(HoleSplit, WhatAllHolesTogetherCannotTakeIsLeft) {
  CorrectionPlane plane = Holes(4);
  plane.largest_kg = 1e-4;
  const Complex wanted(0.03 * 5e-4, 0.0);
  const PlacedWeights placed = PlaceWeights(wanted, plane, false);
  EXPECT_NEAR(placed.moment_kg_m.real(), 0.03 * 1e-4, 1e-12);
  EXPECT_NEAR(std::abs(placed.moment_kg_m - MomentOf(placed, 0.03)), 0.0, 1e-18);
}

TEST(HoleSplit, AWeightBelowTheSmallestIsLeftOutOrRaisedWhicheverIsCloser) {
  CorrectionPlane plane = Holes(4);
  plane.smallest_kg = 1e-4;
  EXPECT_TRUE(PlaceWeights({0.03 * 0.4e-4, 0.0}, plane, false).weights.empty());
  const PlacedWeights raised = PlaceWeights({0.03 * 0.7e-4, 0.0}, plane, false);
  ASSERT_EQ(raised.weights.size(), 1U);
  EXPECT_DOUBLE_EQ(raised.weights[0].mass_kg, 1e-4);
}

TEST(HoleSplit, WhatAHoleLeftOutWouldHaveTakenGoesToItsNeighbours) {
  CorrectionPlane plane = Holes(12);
  plane.smallest_kg = 5e-5;
  // 1 degree before the first hole: the one behind would take 0.02 g of 0.587 g.
  const Complex wanted = 0.03 * std::polar(5.87e-4, -kTwoPi / 360.0);
  const PlacedWeights placed = PlaceWeights(wanted, plane, false);
  ASSERT_EQ(placed.weights.size(), 1U);
  EXPECT_EQ(placed.weights[0].hole, 1U);
  EXPECT_NEAR(placed.weights[0].mass_kg, 5.87e-4 * std::cos(kTwoPi / 360.0), 1e-12);
}

TEST(HoleSplit, DrillingTakesMassOnTheOtherSide) {
  const Complex wanted = std::polar(6e-6, 0.0);
  const PlacedWeights drilled = PlaceWeights(wanted, Holes(12), true);
  ASSERT_EQ(drilled.weights.size(), 1U);
  EXPECT_EQ(drilled.weights[0].hole, 7U);  // half a turn on
  EXPECT_LT(std::abs(drilled.moment_kg_m - wanted), 1e-15);
  EXPECT_LT(std::abs(MomentOf(drilled, 0.03) + wanted), 1e-15);
}

TEST(HoleSplit, WithoutHolesTheWeightStandsAtItsAngle) {
  CorrectionPlane plane = Holes(0);
  const PlacedWeights placed = PlaceWeights(std::polar(6e-6, 1.0), plane, false);
  ASSERT_EQ(placed.weights.size(), 1U);
  EXPECT_EQ(placed.weights[0].hole, 0U);
  EXPECT_NEAR(placed.weights[0].angle_rad, 1.0, 1e-12);
  EXPECT_NEAR(placed.weights[0].mass_kg, 2e-4, 1e-12);
}

}  // namespace
}  // namespace levitas::balancing
