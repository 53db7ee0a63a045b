#include "analysis/free_modes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/rotational_speed.hpp"
#include "tests/support/reference_csv.hpp"
#include "tests/support/test_rigs.hpp"
#include "tests/unit/analysis/laws.hpp"

namespace levitas::analysis {
namespace {

TEST(FreeModes, AgreeWithAnIndependentProgramAtEverySpeedOfTheCampbellDiagram) {
  const auto table = test::ReadReference("flexible_rotor_campbell.csv");
  ASSERT_EQ(table.size(), 13U);
  std::vector<double> speeds;
  for (const auto& row : table) speeds.push_back(RpmToRadPerS(row[0]));
  const FreeModes modes = ComputeFreeModes(test::QuietFlexibleRotor(), speeds, 4);
  ASSERT_EQ(modes.whirl.size(), table.size());
  for (std::size_t i = 0; i < table.size(); ++i) {
    for (std::size_t mode = 0; mode < 4; ++mode) {
      const double backward_hz = table[i][1 + 2 * mode];
      const double forward_hz = table[i][2 + 2 * mode];
      // 0.1 %: what two correct programs with different meshes agree to.
      EXPECT_NEAR(modes.whirl[i].backward_hz[mode], backward_hz, 1e-3 * backward_hz)
          << table[i][0] << " rpm, mode " << mode + 1;
      EXPECT_NEAR(modes.whirl[i].forward_hz[mode], forward_hz, 1e-3 * forward_hz)
          << table[i][0] << " rpm, mode " << mode + 1;
    }
  }
}

TEST(FreeModes, GiveMassAndMagnetConstantsOfTheFlexibleRotor) {
  const FreeModes modes = ComputeFreeModes(test::QuietFlexibleRotor(), {0.0}, 1);
  // Shaft and three discs: pi/4 d^2 L rho + 0.6363 + 0.8021 + 0.6363 kg.
  const double shaft_kg = 0.25 * 3.14159265358979 * 9.525e-3 * 9.525e-3 * 0.4572 * 7930.0;
  EXPECT_NEAR(modes.rotor_mass_kg, shaft_kg + 2.0747, 1e-9);
  ASSERT_EQ(modes.bearings.size(), 2U);
  EXPECT_NEAR(modes.bearings[0].ki_n_per_a, 40.0, 1e-9);
  // ks = ki i0 / s0
  EXPECT_NEAR(modes.bearings[1].ks_n_per_m, 40.0 / 0.381e-3, 1e-3);
}

TEST(FreeModes, AgreeWithTheProgramPublishedForTheUfuRig) {
  const FreeModes modes = ComputeFreeModes(test::UfuRig(), {0.0}, 4);
  // 1 %: the thesis prints three to four digits and its program condenses differently.
  EXPECT_NEAR(modes.rotor_mass_kg, 5.936, 0.05936);
  ASSERT_EQ(modes.whirl.size(), 1U);
  const double published_hz[] = {104.2, 400.3, 768.2, 1117.6};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(modes.whirl[0].forward_hz[i], published_hz[i], 0.01 * published_hz[i]);
    EXPECT_NEAR(modes.whirl[0].backward_hz[i], published_hz[i], 0.01 * published_hz[i]);
  }
  for (const auto& bearing : modes.bearings) {
    EXPECT_NEAR(bearing.ki_n_per_a, 55.73, 0.5573);
    EXPECT_NEAR(bearing.ks_n_per_m, 1.290e5, 1290.0);
  }
}

TEST(FreeModes, SplitFurtherApartTheFasterTheRotorTurns) {
  const FreeModes modes = ComputeFreeModes(test::QuietFlexibleRotor(),
                                           {0.0, RpmToRadPerS(3000.0), RpmToRadPerS(6000.0)}, 1);
  std::vector<double> split_hz;
  for (const auto& at : modes.whirl) split_hz.push_back(at.forward_hz[0] - at.backward_hz[0]);
  EXPECT_LT(split_hz[0], 1e-3);  // no rotation, no split: rounding only
  EXPECT_GT(split_hz[1], 1.0);
  EXPECT_GT(split_hz[2], 1.9 * split_hz[1]);  // nearly linear in speed
}

}  // namespace
}  // namespace levitas::analysis
