#include "common/unit_phasor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/random.hpp"

namespace levitas {
namespace {

TEST(UnitPhasor, IsCosineAndSineToTheLastBits) {
  Random draw(1);
  for (int n = 0; n < 100'000; ++n) {
    const double turns = 4.0 * draw.Uniform() - 2.0;
    const UnitPhasor found = PhasorOfTurns(turns);
    const long double angle = 2.0L * std::numbers::pi_v<long double> * turns;
    EXPECT_NEAR(found.cosine, static_cast<double>(std::cos(angle)), 4e-16) << turns;
    EXPECT_NEAR(found.sine, static_cast<double>(std::sin(angle)), 4e-16) << turns;
  }
}

TEST(UnitPhasor, QuartersAreExact) {
  const auto expect = [](double turns, double cosine, double sine) {
    const UnitPhasor found = PhasorOfTurns(turns);
    EXPECT_EQ(found.cosine, cosine) << turns;
    EXPECT_EQ(found.sine, sine) << turns;
  };
  expect(0.0, 1.0, 0.0);
  expect(0.25, 0.0, 1.0);
  expect(0.5, -1.0, 0.0);
  expect(0.75, 0.0, -1.0);
  expect(-0.25, 0.0, -1.0);
  expect(1e6, 1.0, 0.0);
}

TEST(UnitPhasor, OfWhatIsNoNumberIsNoNumber) {
  EXPECT_TRUE(std::isnan(PhasorOfTurns(std::numeric_limits<double>::quiet_NaN()).cosine));
  EXPECT_TRUE(std::isnan(PhasorOfTurns(std::numeric_limits<double>::infinity()).sine));
}

}  // namespace
}  // namespace levitas
