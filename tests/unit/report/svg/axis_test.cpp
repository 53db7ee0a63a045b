#include "report/svg/axis.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace levitas::svg {
namespace {

using testing::ElementsAre;

TEST(Axis, MapsItsEndsToItsPixels) {
  const Axis axis({2.0, 4.0}, Scale::kLinear, 100.0, 300.0);
  EXPECT_DOUBLE_EQ(axis.Pixel(2.0), 100.0);
  EXPECT_DOUBLE_EQ(axis.Pixel(3.0), 200.0);
  EXPECT_DOUBLE_EQ(axis.Pixel(4.0), 300.0);
}

TEST(Axis, PutsTheGeometricMeanInTheMiddleOfALogarithmicScale) {
  const Axis axis({1.0, 100.0}, Scale::kLogarithmic, 0.0, 200.0);
  EXPECT_NEAR(axis.Pixel(10.0), 100.0, 1e-9);  // rounding of the logarithm
}

TEST(Axis, HasNoPlaceForWhatCannotBeDrawn) {
  const Axis axis({1.0, 100.0}, Scale::kLogarithmic, 0.0, 200.0);
  EXPECT_TRUE(std::isnan(axis.Pixel(0.0)));
  EXPECT_TRUE(std::isnan(axis.Pixel(-3.0)));
  EXPECT_TRUE(std::isnan(axis.Pixel(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Axis, MarksDecadesAndRoundNumbers) {
  EXPECT_THAT(Axis({0.0, 1.0}, Scale::kLinear, 0, 1).Marks(),
              ElementsAre(0.0, testing::DoubleNear(0.2, 1e-12), testing::DoubleNear(0.4, 1e-12),
                          testing::DoubleNear(0.6, 1e-12), testing::DoubleNear(0.8, 1e-12),
                          testing::DoubleNear(1.0, 1e-12)));
  EXPECT_THAT(Axis({1.0, 1e5}, Scale::kLogarithmic, 0, 1).Marks(),
              ElementsAre(1.0, 10.0, 100.0, 1e3, 1e4, 1e5));
  EXPECT_THAT(Axis({1.0, 10.0}, Scale::kLogarithmic, 0, 1).Marks(),
              ElementsAre(1.0, 2.0, 5.0, 10.0));
}

TEST(Axis, WidensARangeWithoutExtent) {
  const Axis axis({3.0, 3.0}, Scale::kLinear, 0.0, 10.0);
  EXPECT_LT(axis.range().low, 3.0);
  EXPECT_GT(axis.range().high, 3.0);
}

TEST(Enclose, HoldsEveryDrawableValueAndIgnoresTheOthers) {
  const Range range = Enclose({{1.0, std::nan("")}, {5.0, -1.0}}, Scale::kLogarithmic);
  EXPECT_LE(range.low, 1.0);
  EXPECT_GE(range.high, 5.0);
  EXPECT_GT(range.low, 0.5);  // -1 has no logarithm and must not pull the axis down
}

TEST(Enclose, GivesADrawableRangeForNoDataAtAll) {
  EXPECT_LT(Enclose({}, Scale::kLinear).low, Enclose({}, Scale::kLinear).high);
  EXPECT_GT(Enclose({}, Scale::kLogarithmic).low, 0.0);
}

TEST(MarkText, HasNoNegativeZero) {
  EXPECT_EQ(MarkText(-0.0), "0");
  EXPECT_EQ(MarkText(-0.5), "-0.5");
}

}  // namespace
}  // namespace levitas::svg
