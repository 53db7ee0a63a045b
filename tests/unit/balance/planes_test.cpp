// Planes from words and files, and what is refused.
#include "identification/balance/planes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"

namespace levitas::balancing {
namespace {

using testing::HasSubstr;

const configuration::RigFile& ShippedRig() {
  static const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  return rig;
}

template <class Do>
std::string Refused(Do act) {
  try {
    act();
  } catch (const Problem& problem) {
    return problem.what();
  }
  return "nothing was refused";
}

TEST(Planes, AWordHasPlaceRadiusHolesAndLimits) {
  const CorrectionPlane plane = PlaneOfWord("disc=299.2,30,12,45,0.05,2");
  EXPECT_EQ(plane.name, "disc");
  EXPECT_DOUBLE_EQ(plane.z_m, 0.2992);
  EXPECT_DOUBLE_EQ(plane.radius_m, 0.03);
  EXPECT_EQ(plane.holes, 12U);
  EXPECT_NEAR(plane.first_hole_rad, 0.25 * 3.14159265358979, 1e-12);
  EXPECT_DOUBLE_EQ(plane.smallest_kg, 0.05e-3);
  EXPECT_DOUBLE_EQ(plane.largest_kg, 2e-3);
  EXPECT_EQ(PlaneOfWord("a=1,2").holes, 0U);
}

TEST(Planes, AWordThatIsNoneSaysWhatIsAllowed) {
  for (const char* word : {"disc", "=1,2", "disc=1", "disc=1,x", "disc=1,0", "disc=1,2,1.5",
                           "disc=1,2,3,4,5", "disc=1,2,3,4,6,5", "disc=1,2,-1"}) {
    EXPECT_THAT(Refused([&] { static_cast<void>(PlaneOfWord(word)); }),
                HasSubstr("NAME=Z_MM,RADIUS_MM"))
        << word;
  }
}

TEST(Planes, AFileIsReadStrictly) {
  const CorrectionPlanes planes = ParsePlanes(
      "kind: balance_planes\nname: sleeves\nmethod: drill\nplanes:\n"
      "  - {name: disc, z_mm: 299.2, radius_mm: 30, holes: 12}\n"
      "  - {name: de, z_mm: 129.9, radius_mm: 20}\n",
      "planes.yaml");
  EXPECT_TRUE(planes.drill);
  ASSERT_EQ(planes.planes.size(), 2U);
  EXPECT_EQ(planes.planes[1].name, "de");
  EXPECT_DOUBLE_EQ(planes.planes[1].z_m, 0.1299);
  const std::string wrong = Refused([] {
    static_cast<void>(
        ParsePlanes("kind: balance_planes\nname: a\nplanes:\n"
                    "  - {name: disc, z_mm: 299.2, radius_m: 0.03, hole: 12}\n"
                    "  - {name: de, z_mm: 1, radius_mm: 2, smallest_g: 2, "
                    "largest_g: 1}\n",
                    "planes.yaml"));
  });
  EXPECT_THAT(wrong, HasSubstr("hole"));
  EXPECT_THAT(wrong, HasSubstr("must not be below smallest_g"));
}

TEST(Planes, OffTheShaftTwiceAtOnePlaceAndNoneAreRefused) {
  const auto check = [](std::vector<CorrectionPlane> planes) {
    return Refused([&] { CheckPlanes({false, planes}, ShippedRig()); });
  };
  EXPECT_THAT(check({}), HasSubstr("--plane"));
  EXPECT_THAT(check({PlaneOfWord("disc=500,30")}), HasSubstr("not on the shaft"));
  EXPECT_THAT(check({PlaneOfWord("a=100,30"), PlaneOfWord("a=200,30")}), HasSubstr("named a"));
  EXPECT_THAT(check({PlaneOfWord("a=100,30"), PlaneOfWord("b=100,20")}), HasSubstr("one place"));
  EXPECT_EQ(check({PlaneOfWord("a=457.2,30")}), "nothing was refused");
}

TEST(Planes, OfTheRigFileAreThoseOfItsUnbalance) {
  const CorrectionPlanes planes = PlanesOfRig(ShippedRig());
  ASSERT_EQ(planes.planes.size(), 3U);
  EXPECT_DOUBLE_EQ(planes.planes[1].z_m, 0.2992);
  EXPECT_EQ(planes.planes[1].radius_m, 0.0);
}

}  // namespace
}  // namespace levitas::balancing
