// Options of the nonlinear fits: ranges, rows left out, files, characteristics of sensors.

#include "cli/study/identify/series_options.hpp"

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

class SeriesOptionsTest : public testing::Test {
 protected:
  SeriesOptionsTest() {
    std::ofstream file(folder_ / "data.csv");
    file << "u,y\n";
    for (int row = 0; row < kRows; ++row) file << row % 7 << "," << row % 11 << "\n";
  }

  SeriesOptions Parsed(const std::vector<std::string>& words) {
    CLI::App app;
    SeriesOptions options;
    AddSeriesOptions(app, options);
    std::vector<std::string> line{folder_ / "data.csv", "--input", "u", "--output", "y",
                                  "--rate-hz",          "1000"};
    line.insert(line.end(), words.begin(), words.end());
    std::reverse(line.begin(), line.end());  // as CLI11 takes a vector
    app.parse(line);
    return options;
  }

  /// What loading refuses with; empty when it loads.
  std::string Refusal(const std::vector<std::string>& words) {
    const SeriesOptions options = Parsed(words);
    try {
      (void)LoadSeries(options);
      return {};
    } catch (const std::exception& refused) {
      return refused.what();
    }
  }

  static constexpr int kRows = 100;
  test::ScratchFolder folder_;
};

TEST_F(SeriesOptionsTest, LoadsTheNamedColumnsAtTheGivenRate) {
  const identification::Series series = LoadSeries(Parsed({"--skip", "10"}));
  EXPECT_EQ(series.rows(), kRows);
  EXPECT_EQ(series.period_s, 1e-3);
  EXPECT_EQ(series.output(12, 0), 1.0);
}

TEST_F(SeriesOptionsTest, ARangeNeedsTwoRowsMoreThanAreLeftOut) {
  EXPECT_EQ(Refusal({"--train", "0:12", "--skip", "10"}), "");
  EXPECT_THAT(Refusal({"--train", "0:11", "--skip", "10"}),
              AllOf(HasSubstr("--train '0:11'"), HasSubstr("11 rows"), HasSubstr("leaves out 10")));
  EXPECT_THAT(Refusal({"--train", "0:50", "--test", "50:60", "--skip", "10"}),
              HasSubstr("--test '50:60'"));
}

TEST_F(SeriesOptionsTest, ANumberOfRowsThatOnlyWrapsAroundIsRefused) {
  EXPECT_THROW(Parsed({"--skip=-1"}), CLI::ParseError);
  EXPECT_THROW(Parsed({"--skip=18446744073709551615"}), CLI::ParseError);
  EXPECT_THROW(Parsed({"--skip=10.5"}), CLI::ParseError);
}

TEST_F(SeriesOptionsTest, ARangeBeyondTheDataIsRefusedBeforeAnythingIsFitted) {
  EXPECT_THAT(Refusal({"--train", "0:101"}), HasSubstr("rows 0 to 100"));
  EXPECT_THAT(Refusal({"--train", "0:60", "--test", "90:80"}), HasSubstr("rows 0 to 100"));
}

TEST_F(SeriesOptionsTest, TwoOutputsInOneFileAreRefused) {
  const std::string path = folder_ / "same";
  EXPECT_THAT(Refusal({"--skip", "10", "--svg", path, "--json", path}),
              AllOf(HasSubstr("--svg and --json"), HasSubstr("give each a file")));
  EXPECT_EQ(Refusal({"--skip", "10", "--svg", path, "--json", path + ".json"}), "");
}

TEST_F(SeriesOptionsTest, AnOutputOverTheDataIsRefused) {
  EXPECT_NE(Refusal({"--skip", "10", "--json", folder_ / "data.csv"}), "");
}

TEST(SensorOptions, GiveOneCharacteristicPerOutput) {
  const auto sensors = SensorsOf({.a2 = {0.1, 0.2}, .a3 = {}, .tables = {}}, 2);
  ASSERT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors[1].a2, 0.2);
  EXPECT_EQ(sensors[1].a3, 0.0);
  EXPECT_TRUE(SensorsOf({}, 2).empty());
}

TEST(SensorOptions, NameTheOptionWhoseNumbersDoNotFit) {
  const auto refusal = [](const SensorOptions& given) -> std::string {
    try {
      (void)SensorsOf(given, 2);
      return {};
    } catch (const Problem& refused) {
      EXPECT_EQ(refused.status(), ExitStatus::kUsage);
      return refused.what();
    }
  };
  EXPECT_THAT(refusal({.a2 = {0.1}, .a3 = {}, .tables = {}}),
              AllOf(HasSubstr("--sensor-a2"), HasSubstr("1 numbers for 2 outputs")));
  EXPECT_THAT(refusal({.a2 = {0.1, 0.2}, .a3 = {1.0, 2.0, 3.0}, .tables = {}}),
              HasSubstr("--sensor-a3"));
}

}  // namespace
}  // namespace levitas::cli
