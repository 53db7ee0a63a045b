#include "plant_sim/plant/parameter_access.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/problem.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

TEST(Parameters, AreNamedOnceEachAndReadBackWhatWasSet) {
  PlantParameters p = Reduce(test::FlexibleRotor());
  const auto names = ParameterNames(p);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  double value = 0.1;
  for (const auto& name : names) {
    SetParameter(p, name, value);
    // Stored in another unit: one product and one quotient of rounding.
    EXPECT_NEAR(GetParameter(p, name) / value, 1.0, 1e-15) << name;
    value += 0.1;
  }
  value = 0.1;
  for (const auto& name : names) {  // and none of them stands for the same number as another
    EXPECT_NEAR(GetParameter(p, name) / value, 1.0, 1e-15) << name;
    value += 0.1;
  }
}

TEST(Parameters, CarryTheUnitOfTheirName) {
  const PlantParameters p = Reduce(test::FlexibleRotor());
  EXPECT_NEAR(GetParameter(p, "rotor.modes[2].frequency_hz"), 90.0, 0.1);  // published: 90 Hz
  EXPECT_DOUBLE_EQ(GetParameter(p, "bearings[0].magnet.gap_m"), 0.381e-3);
  EXPECT_DOUBLE_EQ(GetParameter(p, "bearings[1].sensor.gain"), 1.0);
  EXPECT_DOUBLE_EQ(GetParameter(p, "unbalance[1].moment_kg_m"), 18e-6);
  EXPECT_DOUBLE_EQ(GetParameter(p, "delay_samples"), 1.0);
}

TEST(Parameters, AnUnknownNameIsToldWithTheNearestOne) {
  PlantParameters p = Reduce(test::FlexibleRotor());
  try {
    SetParameter(p, "bearings[0].magnet.gap", 1e-3);
    FAIL() << "there is no such parameter";
  } catch (const BadInput& problem) {
    const std::string text = problem.what();
    EXPECT_NE(text.find("'bearings[0].magnet.gap'"), std::string::npos) << text;
    EXPECT_NE(text.find("'bearings[0].magnet.gap_m'"), std::string::npos) << text;
  }
  EXPECT_THROW((void)GetParameter(p, "rotor.modes[0].frequency_hz"), BadInput);  // rigid
  EXPECT_THROW((void)GetParameter(p, ""), BadInput);
}

TEST(Parameters, ChangeTheModelBuiltFromThemAndNotTheOneTheyCameFrom) {
  const PlantModel model(test::QuietFlexibleRotor());
  PlantParameters changed = model.parameters();
  SetParameter(changed, "bearings[0].sensor.gain", 1.1);
  const auto run = [](std::shared_ptr<const PlantModel> with) {
    Plant plant(std::move(with), 1);
    plant.PlaceAtRest({10e-6, 0.0, 10e-6, 0.0});
    return plant.SensorOutput();
  };
  const auto before = run(std::make_shared<const PlantModel>(model.parameters()));
  const auto after = run(std::make_shared<const PlantModel>(changed));
  EXPECT_NEAR(after[0] / before[0], 1.1, 1e-12);
  EXPECT_EQ(after[2], before[2]);
  EXPECT_EQ(GetParameter(model.parameters(), "bearings[0].sensor.gain"), 1.0);
}

TEST(Parameters, ImpossibleValuesAreRefusedByTheModel) {
  PlantParameters p = Reduce(test::QuietFlexibleRotor());
  SetParameter(p, "bearings[0].magnet.gap_m", -1e-3);
  EXPECT_THROW(PlantModel{p}, std::invalid_argument);
  p = Reduce(test::QuietFlexibleRotor());
  SetParameter(p, "rotor.modes[3].damping_ratio", 1.5);
  EXPECT_THROW(PlantModel{p}, std::invalid_argument);
  p = Reduce(test::QuietFlexibleRotor());
  SetParameter(p, "rotor.modes[3].frequency_hz", -1.0);
  EXPECT_THROW(PlantModel{p}, std::invalid_argument);
}

}  // namespace
}  // namespace levitas::plant
