// Design files: defaults of keys left out, the written file read back, and the errors reported.
#include "design/file/design_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/problem.hpp"

namespace levitas::design {
namespace {

using testing::HasSubstr;

void ExpectSame(const hinf::HinfWeights& a, const hinf::HinfWeights& b) {
  EXPECT_EQ(a.disturbance_a, b.disturbance_a);
  EXPECT_EQ(a.disturbance_hz, b.disturbance_hz);
  EXPECT_EQ(a.disturbance_floor, b.disturbance_floor);
  EXPECT_EQ(a.disc_ratio, b.disc_ratio);
  EXPECT_EQ(a.disc_hz, b.disc_hz);
  EXPECT_EQ(a.noise_m, b.noise_m);
  EXPECT_EQ(a.control_a, b.control_a);
  EXPECT_EQ(a.control_hz, b.control_hz);
  EXPECT_EQ(a.position_rest_m, b.position_rest_m);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.position_hz, b.position_hz);
  EXPECT_EQ(a.mode_hz, b.mode_hz);
  EXPECT_EQ(a.speed_ratio, b.speed_ratio);
  EXPECT_EQ(a.speed_unit, b.speed_unit);
  EXPECT_EQ(a.model_hz, b.model_hz);
  EXPECT_EQ(a.bearing_disturbance, b.bearing_disturbance);
  EXPECT_EQ(a.bearing_position, b.bearing_position);
  EXPECT_EQ(a.mode_share, b.mode_share);
}

void ExpectSame(const uncertainty::AnalysisWeights& a, const uncertainty::AnalysisWeights& b) {
  EXPECT_EQ(a.disturbance_a, b.disturbance_a);
  EXPECT_EQ(a.disturbance_order, b.disturbance_order);
  EXPECT_EQ(a.disturbance_attenuation_db, b.disturbance_attenuation_db);
  EXPECT_EQ(a.disturbance_edge_hz, b.disturbance_edge_hz);
  EXPECT_EQ(a.noise_m, b.noise_m);
  EXPECT_EQ(a.control_a, b.control_a);
  EXPECT_EQ(a.control_hz, b.control_hz);
  EXPECT_EQ(a.position_rest_m, b.position_rest_m);
  EXPECT_EQ(a.position_m, b.position_m);
  EXPECT_EQ(a.position_hz, b.position_hz);
  EXPECT_EQ(a.first_hz, b.first_hz);
  EXPECT_EQ(a.last_hz, b.last_hz);
}

TEST(DesignFile, WhatIsLeftOutIsTheDefault) {
  const DesignFile usual;
  for (const char* text : {"kind: design\n", "kind: design\nsynthesis:\n  disc_hz: 52.4\n",
                           "kind: design\nanalysis:\n  control_a: 1\n"}) {
    SCOPED_TRACE(text);
    const DesignFile read = ParseDesign(text, "d.yaml");
    ExpectSame(read.synthesis, usual.synthesis);
    ExpectSame(read.analysis, usual.analysis);
  }
}

TEST(DesignFile, WhatIsWrittenReadsBackBitForBit) {
  DesignFile file;
  file.synthesis.disturbance_a = 0.1 + 0.2;
  file.synthesis.noise_m = 1.0 / 3.0 * 1e-6;
  file.synthesis.bearing_disturbance = {1.0};
  file.synthesis.bearing_position = {0.9, 1.1, 1.0 / 7.0};
  file.synthesis.mode_share = {0.3};
  file.synthesis.speed_ratio = 1.1;
  file.synthesis.speed_unit = 1.0 / 7.0;
  file.analysis.disturbance_a = {0.25, 0.75, 0.5};
  file.analysis.disturbance_order = 4;
  file.analysis.position_m = 50e-6 / 3.0;
  const DesignFile read = ParseDesign(WriteDesign(file), "d.yaml");
  file.synthesis.bearing_disturbance = {1.0, 1.0, 1.0};  // what is beyond the list counts as 1
  ExpectSame(read.synthesis, file.synthesis);
  ExpectSame(read.analysis, file.analysis);
}

TEST(DesignFile, KeysStandInTheirUnits) {
  const DesignFile read = ParseDesign(
      "kind: design\n"
      "synthesis:\n  position_um: 30\n  control_ma: 1500\n  bearings:\n    - position: 0.5\n"
      "  modes:\n    - share: 0.25\n    - share: 4\n"
      "analysis:\n  bearings:\n    - disturbance_a: 0.4\n",
      "d.yaml");
  EXPECT_DOUBLE_EQ(read.synthesis.position_m, 30e-6);
  EXPECT_DOUBLE_EQ(read.synthesis.control_a, 1.5);
  EXPECT_THAT(read.synthesis.bearing_position, testing::ElementsAre(0.5));
  EXPECT_THAT(read.synthesis.mode_share, testing::ElementsAre(0.25, 4.0));
  EXPECT_THAT(read.analysis.disturbance_a, testing::ElementsAre(0.4));
}

TEST(DesignFile, EveryProblemIsNamedWithItsLineAndKey) {
  try {
    static_cast<void>(
        ParseDesign("kind: design\n"
                    "synthesis:\n"
                    "  position_um: 0.1\n"
                    "  disturbance_a: -1\n"
                    "  noise_hz: 3\n"
                    "analysis:\n"
                    "  first_hz: 5000\n",
                    "d.yaml"));
    FAIL() << "accepted";
  } catch (const BadInput& problem) {
    const std::string said = problem.what();
    EXPECT_THAT(said, HasSubstr("synthesis.position_rest_um: must not be above position_um"));
    EXPECT_THAT(said, HasSubstr("d.yaml:4:18: synthesis.disturbance_a: found -1 A"));
    EXPECT_THAT(said, HasSubstr("d.yaml:5:3: synthesis.noise_hz: unknown key"));
    EXPECT_THAT(said, HasSubstr("analysis.first_hz: must be below last_hz"));
  }
}

TEST(DesignFile, AnotherKindIsRefused) {
  EXPECT_THROW(static_cast<void>(ParseDesign("kind: controller\nname: x\n", "c.yaml")), BadInput);
}

}  // namespace
}  // namespace levitas::design
