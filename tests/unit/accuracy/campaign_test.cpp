// Recorded campaigns: same seed, same data; files say what memory says; lost frames are lost; a
// record is what a session of the cycle would hold, and a trip ends it.

#include "benchmark/accuracy/campaign.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "benchmark/accuracy/trial.hpp"
#include "common/rotational_speed.hpp"
#include "diagnosis/records/load.hpp"
#include "plant_sim/plant/plant_model.hpp"

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

Campaign Record(const plant::PlantParameters& truth, const CampaignPlan& plan) {
  return Record(truth, CampaignBench().Cycle(0), plan, Unmodelled::kNothing, 0.0, 1);
}

Campaign WithLosses(bool missing) {
  CampaignPlan plan;
  plan.bits_per_axis = kBits;
  plan.runup_s = 1.05;
  plan.loss = {.probability = 0.004, .burst = 1, .missing = missing, .seed = 5};
  return Record(plant::Reduce(CampaignBench().rig.plant), plan);
}

std::size_t Repeated(const std::vector<analysis::RecordedRow>& rows, bool same_frame) {
  std::size_t count = 0;
  for (std::size_t n = 1; n < rows.size(); ++n) {
    if (rows[n].sample.position_m != rows[n - 1].sample.position_m) continue;
    EXPECT_EQ(rows[n].sample.command.control_current_a,
              rows[n - 1].sample.command.control_current_a);
    count += (rows[n].cycle == rows[n - 1].cycle) == same_frame ? 1U : 0U;
  }
  return count;
}

// 10 500 rows, four of a thousand: 42 expected, 15 is four standard deviations below.
constexpr std::size_t kFewestLost = 15;

TEST(Campaign, WithoutAFrameHoldsItsCurrentsAndTheRowIsThatOfASession) {
  const Campaign campaign = WithLosses(true);
  ASSERT_TRUE(campaign.stable);
  const auto& rows = campaign.records[0].rows;
  EXPECT_GT(Repeated(rows, true), kFewestLost);
  EXPECT_EQ(Repeated(rows, false), 0U);
  for (std::size_t n = 1; n < rows.size(); ++n) {
    ASSERT_EQ(rows[n].levitated, rows[n].cycle != rows[n - 1].cycle) << n;
  }
}

TEST(Campaign, OfALogWithOneRowAPeriodRepeatsTheRowBeforeALostFrame) {
  const Campaign campaign = WithLosses(false);
  ASSERT_TRUE(campaign.stable);
  const auto& rows = campaign.records[0].rows;
  EXPECT_GT(Repeated(rows, false), kFewestLost);
  EXPECT_EQ(rows.back().cycle - rows.front().cycle, rows.size() - 1);
}

TEST(Campaign, RunsUpByTheDriveToTheSpeedItsPlanNames) {
  CampaignPlan plan;
  plan.bits_per_axis = kBits;
  plan.runup_s = 1.05;
  const Campaign campaign = Record(plant::Reduce(CampaignBench().rig.plant), plan);
  ASSERT_EQ(campaign.records.size(), 3U);
  const auto& spinning = campaign.records[1].rows;
  const auto& runup = campaign.records[2].rows;
  EXPECT_DOUBLE_EQ(spinning.front().sample.speed_rad_per_s, RpmToRadPerS(plan.spinning_rpm));
  EXPECT_DOUBLE_EQ(runup.front().sample.speed_rad_per_s, RpmToRadPerS(plan.runup_from_rpm));
  // The last row is a period before the end.
  EXPECT_NEAR(runup.back().sample.speed_rad_per_s, RpmToRadPerS(plan.runup_to_rpm), 0.1);
}

TEST(Campaign, IsNotStableWhenTheSupervisorTrips) {
  plant::PlantParameters truth = plant::Reduce(CampaignBench().rig.plant);
  // The whole rig beyond what its own limit of the orbit allows: the plan's is not met.
  for (auto& mass : truth.config.unbalance) mass.moment_kg_m *= 12.0;
  CampaignPlan plan;
  plan.bits_per_axis = kBits;
  plan.limit_m = 1.0;
  const Campaign campaign = Record(truth, plan);
  EXPECT_FALSE(campaign.stable);
  // It stands still, and is lost on its way to the speed or at it.
  EXPECT_EQ(campaign.records.size(), 2U);
}

// Derivative action takes the noise of the probes to the limit, the more often the more there is.
TEST(Campaign, IsNotStableWhereAnAxisIsAtItsLimitInMoreThanATenthOfTheRows) {
  const plant::PlantParameters truth = plant::Reduce(CampaignBench().rig.plant);
  CampaignPlan plan;
  plan.bits_per_axis = kBits;
  bool stable = true;
  for (const double gain : {1.0, 1.15, 1.3, 1.45}) {
    cycle::CycleConfig controller = CampaignBench().Cycle(0);
    const double limit_a = controller.law.current_limit_a;
    for (law::AxisLawConfig& axis : controller.law.axes) axis.kd_a_s_per_m *= gain;
    const Campaign campaign = Record(truth, controller, plan, Unmodelled::kNothing, 0.0, 1);
    double most = 0.0;
    for (const diagnosis::Record& record : campaign.records) {
      for (std::size_t a = 0; a < controller.rig.axes(); ++a) {
        const auto at_limit = std::ranges::count_if(record.rows, [&](const auto& row) {
          return std::abs(row.sample.command.control_current_a[a]) >= limit_a;
        });
        most =
            std::max(most, static_cast<double>(at_limit) / static_cast<double>(record.rows.size()));
      }
    }
    EXPECT_EQ(campaign.stable, most <= 0.1) << gain << ": " << most;
    stable = campaign.stable;
  }
  EXPECT_FALSE(stable) << "no gain of these is large enough to say anything";
}

TEST(Campaign, KnowsWhetherARigIsLifted) {
  const plant::PlantParameters truth = plant::Reduce(CampaignBench().rig.plant);
  cycle::CycleConfig controller = CampaignBench().Cycle(0);
  EXPECT_TRUE(Lifts(truth, controller, 1));
  for (law::AxisLawConfig& axis : controller.law.axes) axis.kp_a_per_m *= 0.1;
  EXPECT_FALSE(Lifts(truth, controller, 1));
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
