#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "plant_sim/rotor/finite_element.hpp"
#include "tests/support/reference_csv.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::rotor {
namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

FiniteElementModel Flexible() {
  const auto config = test::QuietFlexibleRotor();
  return Assemble(config.rotor, {0.1099, 0.1299, 0.3996, 0.4196});
}

TEST(FreeWhirl, AgreesWithTheIndependentCampbellDiagramAtEverySpeed) {
  const auto model = Flexible();
  for (const auto& row : test::ReadReference("flexible_rotor_campbell.csv")) {
    const auto whirl = FreeWhirl(model, row[0] * kTwoPi / 60.0, 4);
    ASSERT_EQ(whirl.backward_hz.size(), 4U);
    ASSERT_EQ(whirl.forward_hz.size(), 4U);
    for (std::size_t mode = 0; mode < 4; ++mode) {
      // 0.1 %: what two independent programs with different meshes can agree on (they differ 0.05
      // %)
      EXPECT_NEAR(whirl.backward_hz[mode] / row[1 + 2 * mode], 1.0, 1e-3) << row[0] << " rpm";
      EXPECT_NEAR(whirl.forward_hz[mode] / row[2 + 2 * mode], 1.0, 1e-3) << row[0] << " rpm";
    }
  }
}

TEST(Assemble, WeighsThePublishedRigWithItsRings) {
  const auto model = Assemble(test::UfuRig().rotor, {});
  EXPECT_NEAR(model.total_mass_kg / 5.936, 1.0, 0.01);  // published to four digits
  const auto whirl = FreeWhirl(model, 0.0, 4);
  const double published_hz[] = {104.2, 400.3, 768.2, 1117.6};
  for (std::size_t mode = 0; mode < 4; ++mode) {
    EXPECT_NEAR(whirl.forward_hz[mode] / published_hz[mode], 1.0, 0.01) << mode;
  }
}

}  // namespace
}  // namespace levitas::rotor
