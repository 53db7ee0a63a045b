// The plant as a value: same seed same bits, copies independent, no allocation while it runs.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "plant_sim/plant/plant.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

// A proportional and derivative law: keeps the rotor in use of every part of the plant.
class SimpleLaw {
 public:
  PlantCommand operator()(const SensorFrame& frame) noexcept {
    PlantCommand command;
    command.bias_current_a = 1.0;
    command.drive_enabled = true;
    command.speed_set_point_rad_per_s = 200.0;
    command.acceleration_limit_rad_per_s2 = 500.0;
    for (std::size_t a = 0; a < 4; ++a) {
      const double y_m = frame.position_m[a];
      command.control_current_a[a] = -4000.0 * y_m - 3.0 * (y_m - last_m_[a]) * 1e4;
      last_m_[a] = y_m;
    }
    return command;
  }

 private:
  AxisArray last_m_{};
};

std::vector<double> FinalState(Plant plant, int periods) {
  SimpleLaw law;
  for (int i = 0; i < periods; ++i) plant.Advance(law(plant.Sample()));
  return {plant.state().begin(), plant.state().end()};
}

TEST(Seed, DecidesEveryBit) {
  const auto config = test::FlexibleRotor();
  EXPECT_EQ(FinalState(Plant(config, 7), 2000), FinalState(Plant(config, 7), 2000));
  EXPECT_NE(FinalState(Plant(config, 7), 2000), FinalState(Plant(config, 8), 2000));
}

TEST(Copy, GoesOnExactlyLikeItsOriginalAndLeavesItAlone) {
  Plant original(test::FlexibleRotor(), 7);
  SimpleLaw law;
  for (int i = 0; i < 100; ++i) original.Advance(law(original.Sample()));
  const std::vector<double> before(original.state().begin(), original.state().end());
  Plant copy(original);
  EXPECT_EQ(FinalState(copy, 500),
            FinalState(original, 500));  // noise and pending commands included
  copy.mutable_state()[0] = 1.0;
  copy.SetSpeed(1.0, 1.0);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), original.state().begin()));
  EXPECT_NE(original.speed_rad_per_s(), 1.0);
  EXPECT_EQ(&copy.model(), &original.model());  // the model is shared, not copied
}

TEST(Copy, AssignedOverAPlantOfAnotherRigTakesItsPlace) {
  const Plant flexible(test::FlexibleRotor(), 7);
  Plant plant(test::RigidRotor(2.0), 1);
  plant = flexible;
  EXPECT_EQ(FinalState(plant, 100), FinalState(flexible, 100));
  Plant moved(std::move(plant));
  EXPECT_EQ(FinalState(moved, 100), FinalState(flexible, 100));
}

TEST(Allocation, DoesNotHappenInTenThousandPeriodsOfAnyState) {
  auto slewing = test::FlexibleRotor();
  slewing.delay_samples = 1.3;
  for (auto& b : slewing.bearings) b.amplifier.slew_a_per_s = 5000.0;
  for (const auto& config : {test::FlexibleRotor(), slewing}) {
    for (const bool lying : {false, true}) {
      Plant plant(config, 1);
      if (lying) plant.RestInTouchdown();
      SimpleLaw law;
      const test::AllocationGuard guard;
      for (int i = 0; i < 10'000; ++i) {
        PlantCommand command = law(plant.Sample());
        if (lying) command.amplifiers_enabled = false;
        plant.Advance(command);
      }
      EXPECT_EQ(guard.count(), 0U) << (lying ? "lying" : "levitated");
      EXPECT_TRUE(plant.finite());
    }
  }
}

TEST(Allocation, IsSeenByItsGuard) {
  const test::AllocationGuard guard;
  const std::vector<double> memory(1000);
  EXPECT_EQ(guard.count(), 1U) << memory.size();
}

TEST(Finite, TellsOfAStateThatIsNoMore) {
  Plant plant(test::FlexibleRotor(), 1);
  EXPECT_TRUE(plant.finite());
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.control_current_a[0] = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3; ++i) plant.Advance(command);
  EXPECT_FALSE(plant.finite());
}

TEST(Correction, AddedToTheStateIsWhatThePlantGoesOnFrom) {
  // An observer adds to the state between Sample and Advance.
  Plant plant(test::QuietFlexibleRotor(), 1);
  const auto& at = plant.layout();
  EXPECT_EQ(at.size, plant.state().size());
  plant.mutable_state()[at.sensor + 2] += 5e-6;
  EXPECT_EQ(plant.SensorOutput()[2], 5e-6);
}

}  // namespace
}  // namespace levitas::plant
