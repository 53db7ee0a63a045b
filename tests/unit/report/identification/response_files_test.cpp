#include "report/identification/response_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "common/problem.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/report/identification/written.hpp"

namespace levitas::report {
namespace {

using levitas::test::ScratchFolder;
using test::Cells;
using test::Content;
using test::Count;
using Index = Eigen::Index;

/// Entries that say which line, output and input they belong to.
double Entry(std::size_t line, Index to, Index from) {
  return 1e-4 * static_cast<double>(1 + static_cast<Index>(line) * 4 + to * 2 + from);
}

/// Two axes of one bearing, 24 lines from 10 Hz on.
FrequencyResponse TwoAxes() {
  FrequencyResponse response;
  response.speed_rad_per_s = 100.0 * std::numbers::pi;  // 3000 rpm
  response.period_s = 1e-4;
  response.channels = {"de_x", "de_y"};
  response.periods = 8;
  for (std::size_t line = 0; line < 24; ++line) {
    response.frequency_hz.push_back(10.0 + 5.0 * static_cast<double>(line));
    Eigen::MatrixXcd plant(2, 2);
    for (Index to = 0; to < 2; ++to) {
      for (Index from = 0; from < 2; ++from) {
        plant(to, from) = {Entry(line, to, from), -Entry(line, to, from)};
      }
    }
    response.plant.push_back(plant);
    response.currents.push_back(Eigen::MatrixXcd::Identity(2, 2));
    response.sensitivity.push_back(2.0 * Eigen::MatrixXcd::Identity(2, 2));
    response.variance.push_back(Eigen::MatrixXd::Constant(2, 2, 1e-12));
    response.coherence.push_back(Eigen::MatrixXd::Constant(2, 2, 0.99));
    response.noise.push_back(Eigen::MatrixXd::Constant(2, 2, 1e-12));
    response.own_variance.push_back(Eigen::VectorXd::Constant(2, 1e-4));
  }
  return response;
}

TEST(ResponseCsv, HasARowPerSpeedAndLineAndAColumnPerNumberOfEachPair) {
  const ScratchFolder folder;
  FrequencyResponse faster = TwoAxes();
  faster.speed_rad_per_s *= 2.0;
  WriteResponseCsv(folder / "p.csv", {TwoAxes(), faster});
  const auto rows = Cells(Content(folder / "p.csv"));
  ASSERT_EQ(rows.size(), 1U + 2U * 24U);
  for (const auto& row : rows) EXPECT_EQ(row.size(), 2U + 4U * 6U + 2U);
  EXPECT_EQ(rows[1][0], "3000.000");
  EXPECT_EQ(rows[25][0], "6000.000");
}

TEST(ResponseCsv, HoldsUnderEachNameTheEntryOfThatOutputAndInput) {
  const ScratchFolder folder;
  WriteResponseCsv(folder / "p.csv", {TwoAxes()});
  const auto rows = Cells(Content(folder / "p.csv"));
  const auto column = [&](const std::string& name) {
    const auto at = std::find(rows[0].begin(), rows[0].end(), name);
    EXPECT_NE(at, rows[0].end()) << name;
    return static_cast<std::size_t>(at - rows[0].begin());
  };
  const std::size_t line = 3;
  EXPECT_EQ(std::stod(rows[1 + line][column("frequency_hz")]), 25.0);
  // Eight digits are written behind the point.
  EXPECT_NEAR(std::stod(rows[1 + line][column("plant_re_de_y_from_de_x_m_per_a")]),
              Entry(line, 1, 0), 1e-8 * Entry(line, 1, 0));
  EXPECT_NEAR(std::stod(rows[1 + line][column("plant_im_de_x_from_de_y_m_per_a")]),
              -Entry(line, 0, 1), 1e-8 * Entry(line, 0, 1));
  // The deviation, not the variance.
  EXPECT_NEAR(std::stod(rows[1 + line][column("plant_sigma_de_x_from_de_x_m_per_a")]), 1e-6, 1e-12);
  EXPECT_NEAR(std::stod(rows[1 + line][column("sensitivity_sigma_de_y_from_de_y")]), 1e-2, 1e-8);
}

TEST(ResponseCsv, WithoutAPathOrAResponseIsNotWritten) {
  const ScratchFolder folder;
  WriteResponseCsv("", {TwoAxes()});
  WriteResponseCsv(folder / "p.csv", {});
  EXPECT_FALSE(std::filesystem::exists(folder / "p.csv"));
}

TEST(ResponseCsv, RefusesAFolderThatIsNotThere) {
  const ScratchFolder folder;
  EXPECT_THROW(WriteResponseCsv(folder / "nowhere/p.csv", {TwoAxes()}), BadInput);
}

TEST(ResponseJson, HoldsThePlantByOutputThenInput) {
  const auto json = ResponseJson(TwoAxes());
  EXPECT_NEAR(json["speed_rpm"].get<double>(), 3000.0, 1e-9);
  EXPECT_EQ(json["lines"], 24);
  EXPECT_EQ(json["line_spacing_hz"], 5.0);
  const auto& entry = json["plant"]["de_y"]["de_x"];
  ASSERT_EQ(entry["re_m_per_a"].size(), 24U);
  EXPECT_EQ(entry["re_m_per_a"][5], Entry(5, 1, 0));
  EXPECT_EQ(entry["im_m_per_a"][5], -Entry(5, 1, 0));
}

TEST(ResponseJson, SaysWhereTheSignalWasAdded) {
  FrequencyResponse response = TwoAxes();
  response.point = identification::SummingPoint::kReading;
  EXPECT_EQ(ResponseJson(response)["excited"], "measured_position");
  response.point = identification::SummingPoint::kCurrent;
  EXPECT_EQ(ResponseJson(response)["excited"], "control_current");
}

TEST(Bode, ShowsPhaseAndSensitivityWithoutAModelAndTheResidualWithOne) {
  const ScratchFolder folder;
  const FrequencyResponse response = TwoAxes();
  WriteBode(folder / "data.svg", response);
  const std::string data = Content(folder / "data.svg");
  EXPECT_EQ(Count(data, "sensitivity"), 1U);
  EXPECT_EQ(Count(data, "residual"), 0U);
  WriteBode(folder / "model.svg", response, response.plant);
  const std::string model = Content(folder / "model.svg");
  EXPECT_EQ(Count(model, "sensitivity"), 0U);
  EXPECT_GE(Count(model, "residual"), 1U);
}

TEST(Bode, WithoutAPathIsNotWritten) {
  WriteBode("", TwoAxes());
  EXPECT_FALSE(std::filesystem::exists(""));
}

}  // namespace
}  // namespace levitas::report
