#include "plant_sim/rotor/torsion_springs.hpp"

#include <gtest/gtest.h>

#include "plant_sim/rotor/torsion_line.hpp"

namespace levitas::rotor {
namespace {

/// Three inertias, a shaft without torsion, two inertias with gauges.
std::vector<Shaft> ThreeShafts() {
  std::vector<Shaft> shafts(3);
  shafts[0].torsion.kind = shafts[2].torsion.kind = TorsionKind::kInertias;
  shafts[0].torsion.inertias = {{"motor", 1.0, 100.0, 0.0, 0.0},
                                {"flange", 1.0, 200.0, 0.0, 0.0},
                                {"pinion", 1.0, 0.0, 0.0, 0.0}};
  shafts[2].torsion.inertias = {{"gear", 1.0, 300.0, 0.0, 0.0}, {"brake", 1.0, 0.0, 0.0, 0.0}};
  shafts[2].torsion.gauges.fitted = true;
  return shafts;
}

TEST(TorsionSprings, StandBetweenNeighboursOfOneShaftAndCountInertiasOverAll) {
  const auto springs = TorsionSprings(ThreeShafts());
  ASSERT_EQ(springs.size(), 3U);
  EXPECT_EQ(springs[0].name, "motor to flange");
  EXPECT_EQ(springs[1].name, "flange to pinion");
  EXPECT_EQ(springs[1].inertia, 1U);
  EXPECT_EQ(springs[1].stiffness_n_m_per_rad, 200.0);
  EXPECT_EQ(springs[2].name, "gear to brake");
  EXPECT_EQ(springs[2].shaft, 2U);
  EXPECT_EQ(springs[2].inertia, 3U);
}

TEST(TorsionSprings, ThatAreGaugedAreThoseOfShaftsWithGauges) {
  const auto springs = GaugedSprings(ThreeShafts());
  ASSERT_EQ(springs.size(), 1U);
  EXPECT_EQ(springs[0].name, "gear to brake");
  EXPECT_EQ(GaugedCouplings(ThreeShafts()), std::vector<std::string>{"gear to brake"});
}

}  // namespace
}  // namespace levitas::rotor
