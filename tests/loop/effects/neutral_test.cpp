// Every effect of the catalogue on one rig: without strength the plant is the nominal one bit for
// bit; with it, it is another.
#include <gtest/gtest.h>

#include <cmath>

#include "plant_sim/plant/linear_model.hpp"
#include "plant_sim/plant/parameter_access.hpp"
#include "tests/loop/effects/effect_rig.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant::test {
namespace {

constexpr double kSpeed_rad_per_s = 180.0;
constexpr int kPeriods = 400;

/// Gravity, noise and converters, no contact: the levitated rig.
PlantConfig Rig() { return levitas::test::FlexibleRotor(); }

const std::shared_ptr<const PlantModel>& Nominal() {
  static const auto model = std::make_shared<const PlantModel>(Rig());
  return model;
}

/// The model with one entry, without redoing the finite elements.
std::shared_ptr<const PlantModel> With(const effect::EffectConfig& entry) {
  PlantParameters parameters = Nominal()->parameters();
  parameters.config.effects.push_back(entry);
  return std::make_shared<const PlantModel>(std::move(parameters));
}

std::vector<SensorFrame> RunOf(const std::shared_ptr<const PlantModel>& model) {
  Plant plant(model, 3);
  return RunLevitated(plant, kSpeed_rad_per_s, kPeriods);
}

class EveryEffect : public testing::TestWithParam<effect::Id> {
 protected:
  [[nodiscard]] static effect::EffectConfig Clear() { return ClearOn(Rig(), GetParam()); }
};

TEST_P(EveryEffect, OfNoStrengthLeavesEveryBitOfTheRun) {
  static const auto nominal = RunOf(Nominal());
  effect::EffectConfig entry = Clear();
  entry.strength = 0.0;
  const auto run = RunOf(With(entry));
  for (std::size_t i = 0; i < run.size(); ++i) {
    ASSERT_EQ(run[i].position_m, nominal[i].position_m) << "period " << i;
  }
}

TEST_P(EveryEffect, OfClearSizeChangesTheRunAndKeepsItFinite) {
  static const auto nominal = RunOf(Nominal());
  const auto run = RunOf(With(Clear()));
  std::size_t different = 0;
  for (std::size_t i = 0; i < run.size(); ++i) {
    different += run[i].position_m != nominal[i].position_m;
    for (std::size_t axis = 0; axis < 4; ++axis) {
      ASSERT_TRUE(std::isfinite(run[i].position_m[axis]));
    }
  }
  EXPECT_GT(different, run.size() / 20);
}

TEST_P(EveryEffect, HasItsParametersAmongThoseOfTheRigAndTheyCanBeSet) {
  PlantParameters parameters = Nominal()->parameters();
  parameters.config.effects.push_back(Clear());
  const auto table = effect::At(GetParam()).parameters;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto& p = table[k];
    std::string name = "effects[0]." + std::string(p.stem);
    if (!p.si_suffix.empty()) name.append("_").append(p.si_suffix);
    EXPECT_EQ(GetParameter(parameters, name), parameters.config.effects[0].values[k]) << name;
    SetParameter(parameters, name, p.low);
    EXPECT_EQ(parameters.config.effects[0].values[k], p.low) << name;
  }
  SetParameter(parameters, "effects[0].strength", 0.5);
  EXPECT_EQ(parameters.config.effects[0].strength, 0.5);
}

TEST_P(EveryEffect, BeyondItsRangeIsRefused) {
  const auto table = effect::At(GetParam()).parameters;
  for (std::size_t k = 0; k < table.size(); ++k) {
    for (const double beyond :
         {std::nextafter(table[k].low, -1e300) - 1e-12 * std::abs(table[k].low),
          table[k].high * (1.0 + 1e-9) + 1e-9, std::nan("")}) {
      effect::EffectConfig entry = Clear();
      entry.values[k] = beyond;
      EXPECT_THROW((void)With(entry), std::invalid_argument) << table[k].stem << " " << beyond;
    }
  }
  effect::EffectConfig entry = Clear();
  entry.strength = 1.01;
  EXPECT_THROW((void)With(entry), std::invalid_argument);
}

TEST_P(EveryEffect, LeavesAStableLinearModelOfTheStatesItAdds) {
  const auto model = With(Clear());
  const LinearModel linear = Linearise(*model, kSpeed_rad_per_s);
  ASSERT_EQ(static_cast<std::size_t>(linear.a.rows()), model->layout().size);
  EXPECT_TRUE(linear.a.allFinite());
  for (std::size_t i = model->layout().effects; i < model->layout().size; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_GT(linear.a.row(row).cwiseAbs().maxCoeff(), 0.0) << "state " << i << " stands still";
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheCatalogue, EveryEffect, testing::ValuesIn(AllIds()),
                         [](const auto& test_info) {
                           return std::string(effect::At(test_info.param).name);
                         });

}  // namespace
}  // namespace levitas::plant::test
