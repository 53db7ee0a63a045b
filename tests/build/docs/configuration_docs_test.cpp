// The committed documentation of the files is the generated one.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "configuration/rig_file.hpp"
#include "configuration/text/documenter.hpp"
#include "tests/support/paths.hpp"

namespace levitas::configuration {
namespace {

std::string Committed() {
  std::ifstream file(levitas::test::SourceFolder() + "/docs/configuration.md", std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ConfigurationDocument, IsTheCommittedOne) {
  std::istringstream expected(ConfigurationDocument());
  std::istringstream found(Committed());
  std::string expected_line;
  std::string found_line;
  for (int line = 1; std::getline(expected, expected_line); ++line) {
    ASSERT_TRUE(std::getline(found, found_line)) << "docs/configuration.md ends at line " << line;
    ASSERT_EQ(found_line, expected_line)
        << "docs/configuration.md:" << line << ": not current; run `ninja generate_docs`";
  }
  EXPECT_FALSE(std::getline(found, found_line)) << "docs/configuration.md is too long";
}

TEST(ConfigurationDocument, TellsUnitRangeDefaultAndMeaningOfAKey) {
  const std::string text = ConfigurationDocument();
  EXPECT_NE(text.find("| `gap_mm` | mm | 0.02 to 10 | required | radial air gap"),
            std::string::npos);
  EXPECT_NE(text.find("| `orbit_fraction` |  | 0.05 to 0.99 | 0.5 | of the clearance"),
            std::string::npos);
}

/// The text between the n-th pair of code fences.
std::string Example(const std::string& document, int n) {
  std::size_t at = 0;
  for (int i = 0; i <= n; ++i) at = document.find("```yaml\n", at + 1);
  at += 8;
  return document.substr(at, document.find("```", at) - at);
}

std::string Text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(ConfigurationDocument, ShowsAMagnetAndASensorThatARigTakes) {
  std::string rig = Text(FindConfig("flexible_rotor", "rigs"));
  const std::size_t magnet = rig.find("    magnet:");
  const std::size_t amplifier = rig.find("    amplifier:");
  const std::size_t sensor = rig.find("    sensor:");
  const std::size_t touchdown = rig.find("    touchdown:");
  rig = rig.substr(0, magnet) + rig.substr(amplifier, sensor - amplifier) +
        Example(ConfigurationDocument(), 0) + rig.substr(touchdown);
  const RigFile file = ParseRig(rig, "example");
  // The gap of 0.381 mm is that at the pole; along the axis it is longer.
  EXPECT_NEAR(file.plant.bearings[0].magnet.gap_m * std::cos(22.5 * std::numbers::pi / 180.0),
              0.381e-3, 1e-12);  // rounding
  EXPECT_EQ(file.plant.bearings[0].sensor.bandwidth_hz, 5000.0);
  EXPECT_EQ(file.numbers.sensor_polarity[1], -1.0);
}

TEST(ConfigurationDocument, ShowsAnExcitationThatAScenarioTakes) {
  const RigNumbers rig = LoadRig(FindConfig("flexible_rotor", "rigs")).numbers;
  const std::string text =
      "kind: scenario\nname: example\nsteps:\n" + Example(ConfigurationDocument(), 1);
  const scenario::ScenarioConfig file = ParseScenario(text, "example", rig);
  ASSERT_EQ(file.steps.at(0).excitation.size(), 2U);
  EXPECT_EQ(file.steps[0].excitation[1].axis, 1U);
  EXPECT_EQ(file.steps[0].excitation[1].start, 0.25);
}

TEST(ConfigurationDocument, HasNoEmptyMeaning) {
  EXPECT_EQ(ConfigurationDocument().find("|  |\n"), std::string::npos);
}

}  // namespace
}  // namespace levitas::configuration
