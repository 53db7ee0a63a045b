// Recorded campaigns: same seed, same data; files say what memory says; lost frames are lost.

#include "benchmark/accuracy/campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "benchmark/accuracy/trial.hpp"
#include "diagnosis/records/load.hpp"

namespace levitas::accuracy {
namespace {

constexpr int kBits = 1275;  // 1.02 s: the shortest record that a diagnosis takes

const TestRig& CampaignBench() {
  static const TestRig bench = LoadTestRig("flexible_rotor", {"flexible_rotor"});
  return bench;
}

TrialPlan Short(std::uint64_t seed, std::vector<effect::Id> hidden) {
  TrialPlan plan;
  plan.seed = seed;
  plan.hidden = std::move(hidden);
  plan.bits_per_axis = kBits;
  plan.runup_s = 1.05;
  return plan;
}

double Rms(const diagnosis::Record& measured, std::size_t axis) {
  double sum = 0.0;
  for (const auto& row : measured.rows) sum += std::pow(row.sample.position_m[axis], 2);
  return std::sqrt(sum / static_cast<double>(measured.rows.size()));
}

TEST(Campaign, RepeatsWithItsSeedAndDiffersWithAnother) {
  const auto first = MakeTrial(CampaignBench(), Short(3, {}));
  const auto again = MakeTrial(CampaignBench(), Short(3, {}));
  const auto other = MakeTrial(CampaignBench(), Short(4, {}));
  ASSERT_EQ(first.records.size(), 3U);
  const auto& rows = first.records[1].rows;
  EXPECT_EQ(rows.back().sample.position_m, again.records[1].rows.back().sample.position_m);
  EXPECT_NE(rows.back().sample.position_m, other.records[1].rows.back().sample.position_m);
}

TEST(Campaign, ExcitesOneAxisAfterTheOtherAndNoneInTheRunUp) {
  const auto trial = MakeTrial(CampaignBench(), Short(3, {}));
  const auto& standing = trial.records[0].rows;
  constexpr std::size_t kQuiet = 3000;  // 0.3 s
  ASSERT_GT(standing.size(), kQuiet);
  EXPECT_EQ(standing[kQuiet - 1].excitation_a[0], 0.0);
  const std::size_t per_axis = (standing.size() - kQuiet) / 4;
  for (std::size_t a = 0; a < 4; ++a) {
    const auto& row = standing[kQuiet + a * per_axis + per_axis / 2];
    for (std::size_t other = 0; other < 4; ++other) {
      EXPECT_EQ(std::abs(row.excitation_a[other]), other == a ? 0.08 : 0.0);
    }
  }
  for (const auto& row : trial.records[2].rows) ASSERT_EQ(row.excitation_a[0], 0.0);
}

/// Cells of the last line of a CSV file: time, angle, then four each of positions and currents.
std::vector<double> LastLine(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::string last;
  while (std::getline(file, line)) last = line;
  std::vector<double> cells;
  std::istringstream text(last);
  while (std::getline(text, line, ',')) cells.push_back(std::stod(line));
  return cells;
}

TEST(Campaign, OfReversedProbesAndCoilsIsTheSameRunAndItsFilesHaveTheSignsOfTheWires) {
  TestRig reversed = LoadTestRig("flexible_rotor", {"flexible_rotor"});
  for (auto* polarity :
       {&reversed.rig.plant.actuator_polarity, &reversed.rig.numbers.actuator_polarity}) {
    (*polarity)[0] = -1.0;
  }
  for (auto* polarity :
       {&reversed.rig.plant.sensor_polarity, &reversed.rig.numbers.sensor_polarity}) {
    (*polarity)[1] = -1.0;
  }
  const Trial built = MakeTrial(CampaignBench(), Short(3, {}));
  const Trial other = MakeTrial(reversed, Short(3, {}));
  const auto& as_built = built.records[0].rows;
  const auto& rows = other.records[0].rows;
  ASSERT_EQ(rows.size(), as_built.size());
  EXPECT_EQ(rows.back().sample.position_m, as_built.back().sample.position_m);
  EXPECT_EQ(rows.back().sample.command.control_current_a,
            as_built.back().sample.command.control_current_a);
  const auto folder = std::filesystem::temp_directory_path() / "levitas_reversed_campaign_test";
  std::filesystem::create_directories(folder);
  WriteCsv(built.records, CampaignBench().rig.numbers, folder.string());
  const std::vector<double> straight = LastLine((folder / "standing.csv").string());
  WriteCsv(other.records, reversed.rig.numbers, folder.string());
  const std::vector<double> wired = LastLine((folder / "standing.csv").string());
  std::filesystem::remove_all(folder);
  ASSERT_EQ(straight.size(), 14U);
  ASSERT_EQ(wired.size(), 14U);
  EXPECT_NE(wired[3], 0.0);
  EXPECT_NE(wired[6], 0.0);
  for (std::size_t i = 0; i < wired.size(); ++i) {
    const bool reverse = i == 3 || i == 6;  // position of de_y, control current of de_x
    EXPECT_EQ(wired[i], reverse ? -straight[i] : straight[i]) << "column " << i;
  }
}

TEST(Campaign, ShowsUnbalanceOnlyWhenItTurns) {
  const auto healthy = MakeTrial(CampaignBench(), Short(3, {}));
  const auto heavy = MakeTrial(CampaignBench(), Short(3, {effect::Id::kUnbalance}));
  EXPECT_EQ(Rms(heavy.records[0], 0), Rms(healthy.records[0], 0));
  EXPECT_NE(Rms(heavy.records[1], 0), Rms(healthy.records[1], 0));
}

TEST(Campaign, WrittenAsCsvIsReadBackAsTheSameRows) {
  const auto trial = MakeTrial(CampaignBench(), Short(3, {}));
  const auto folder = std::filesystem::temp_directory_path() / "levitas_campaign_test";
  std::filesystem::create_directories(folder);
  WriteCsv(trial.records, CampaignBench().rig.numbers, folder.string());
  const auto read = diagnosis::LoadRecord((folder / "spinning.csv").string(), CampaignBench().rig);
  std::filesystem::remove_all(folder);
  const auto& rows = trial.records[1].rows;
  ASSERT_EQ(read.rows.size(), rows.size());
  for (const std::size_t n : {std::size_t{100}, rows.size() / 2, rows.size() - 1}) {
    for (std::size_t a = 0; a < 4; ++a) {
      // Half a unit of the eighth digit: 5e-13 m up to 100 um, 5e-9 A below 1 A. The speed comes
      // from the slope of angles with eight digits.
      EXPECT_NEAR(read.rows[n].sample.position_m[a], rows[n].sample.position_m[a], 1e-12);
      EXPECT_NEAR(read.rows[n].sample.command.control_current_a[a],
                  rows[n].sample.command.control_current_a[a], 1e-8);
    }
    EXPECT_NEAR(read.rows[n].sample.speed_rad_per_s, rows[n].sample.speed_rad_per_s, 0.1);
  }
}

TEST(Campaign, WithLostFramesHasMissingOrRepeatedRows) {
  const auto trial = MakeTrial(CampaignBench(), Short(5, {effect::Id::kDroppedSamples}));
  std::size_t lost = 0;
  const auto& rows = trial.records[0].rows;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const bool gap = rows[n].cycle > rows[n - 1].cycle + 1;
    lost += gap || rows[n].sample.position_m == rows[n - 1].sample.position_m ? 1U : 0U;
  }
  // 10 200 rows, four of a thousand: 41 expected, 15 is four standard deviations below.
  EXPECT_GT(lost, 15U);
}

// What the plant itself held back would stand in no record, and a diagnosis could not know of it.
TEST(Campaign, WithLostFramesLosesNoneBesideTheRecord) {
  const auto trial = MakeTrial(CampaignBench(), Short(5, {effect::Id::kDroppedSamples}));
  for (const auto& entry : trial.ground_truth.truth.config.effects) {
    EXPECT_NE(entry.id, effect::Id::kDroppedSamples);
  }
}

}  // namespace
}  // namespace levitas::accuracy
