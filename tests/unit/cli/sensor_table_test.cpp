// --sensor-table: characteristics from tables of a positioning platform, instead of as numbers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "cli/study/identify/sensor_options.hpp"
#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"

namespace levitas::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SensorTable : public testing::Test {
 protected:
  /// Of a probe with offset and gain, and the curve that is to be found.
  std::string Table(const std::string& name, double a2, double a3) {
    std::ofstream file(tables_ / name);
    file.precision(17);
    file << "displacement_um,reading_um\n";
    for (int um = -50; um <= 50; um += 5) {
      const double x = 1e-6 * um;
      file << um << "," << 1e6 * (3e-6 + 1.1 * x * (1.0 + x * (a2 + x * a3))) << "\n";
    }
    return tables_ / name;
  }

  static SensorOptions Given(std::vector<std::string> words) {
    CLI::App app;
    SensorOptions options;
    AddSensorOptions(app, options);
    std::ranges::reverse(words);  // as CLI11 takes a vector
    app.parse(words);
    return options;
  }

  test::ScratchFolder tables_;
};

TEST_F(SensorTable, GivesTheCurveOfEachOutputWithoutOffsetAndGain) {
  const std::string both = Table("ux.csv", 1000.0, -2e7) + "," + Table("uy.csv", -500.0, 1e7);
  const auto sensors = SensorsOf(Given({"--sensor-table", both}), 2);
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_NEAR(sensors[0].a2, 1000.0, 1e-3);
  EXPECT_NEAR(sensors[0].a3, -2e7, 1e2);
  EXPECT_NEAR(sensors[1].a2, -500.0, 1e-3);
  EXPECT_NEAR(sensors[1].a3, 1e7, 1e2);
}

TEST_F(SensorTable, OfOneProbeIsThatOfAllOutputs) {
  const auto sensors = SensorsOf(Given({"--sensor-table", Table("ux.csv", 1000.0, -2e7)}), 4);
  ASSERT_EQ(sensors.size(), 4U);
  for (const auto& sensor : sensors) EXPECT_NEAR(sensor.a2, 1000.0, 1e-3);
}

TEST_F(SensorTable, IsRefusedTogetherWithNumbers) {
  const std::string table = Table("ux.csv", 1000.0, -2e7);
  for (const char* numbers : {"--sensor-a2", "--sensor-a3"}) {
    EXPECT_THROW((void)Given({"--sensor-table", table, numbers, "1000"}), CLI::ExcludesError);
    EXPECT_THROW((void)Given({numbers, "1000", "--sensor-table", table}), CLI::ExcludesError);
  }
}

TEST_F(SensorTable, OfAnotherNumberThanTheOutputsIsAUsageProblem) {
  const std::string table = Table("ux.csv", 1000.0, -2e7);
  const SensorOptions options = Given({"--sensor-table", table + "," + table});
  try {
    (void)SensorsOf(options, 3);
    FAIL() << "taken";
  } catch (const Problem& refused) {
    EXPECT_EQ(refused.status(), ExitStatus::kUsage);
    EXPECT_THAT(refused.what(), AllOf(HasSubstr("--sensor-table"), HasSubstr("2 files for 3")));
  }
}

TEST_F(SensorTable, ThatCannotBeReadIsBadInputWithItsName) {
  const std::string none = tables_ / "none.csv";
  try {
    (void)SensorsOf(Given({"--sensor-table", none}), 1);
    FAIL() << "taken";
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr(none));
  }
}

}  // namespace
}  // namespace levitas::cli
