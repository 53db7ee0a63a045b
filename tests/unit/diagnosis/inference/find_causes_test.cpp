// The selection of causes on a record in which a hum of known size is all that is wrong.

#include "diagnosis/inference/find_causes.hpp"

#include <gtest/gtest.h>

#include "tests/unit/diagnosis/hum.hpp"

namespace levitas::diagnosis {
namespace {

TEST(FindCauses, NamesTheHumAloneWithItsAmplitudeAndEndsLinearisedThere) {
  constexpr double kHum = 5e-6;
  HumSearch hum(kHum);
  FindCauses(hum.landscape, hum.rules, hum.found);
  ASSERT_EQ(hum.found.causes.size(), 1U);
  EXPECT_EQ(hum.found.causes[0].effect, "mains_pickup");
  EXPECT_NEAR(hum.AmplitudeOnDeX(), kHum, HumTolerance());
  EXPECT_EQ(hum.landscape.view().theta, hum.found.theta);
}

TEST(FindCauses, OfNoiseAloneAreNoneAndTheCalibratedModelStays) {
  HumSearch quiet(0.0);
  const std::vector<double> before = quiet.found.theta;
  FindCauses(quiet.landscape, quiet.rules, quiet.found);
  EXPECT_TRUE(quiet.found.causes.empty());
  EXPECT_EQ(quiet.found.theta, before);
  EXPECT_EQ(quiet.found.calibrated_runs, quiet.landscape.view().runs);
}

TEST(FindCauses, AreNoMoreThanAskedFor) {
  HumSearch hum(5e-6);
  hum.rules.most_causes = 0;
  FindCauses(hum.landscape, hum.rules, hum.found);
  EXPECT_TRUE(hum.found.causes.empty());
  EXPECT_EQ(hum.found.theta, hum.found.calibrated);
}

}  // namespace
}  // namespace levitas::diagnosis
