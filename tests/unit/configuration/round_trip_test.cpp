// What is written reads back to the same bits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "common/problem.hpp"
#include "common/rotational_speed.hpp"
#include "configuration/schema/schema.hpp"
#include "tests/unit/configuration/field_list.hpp"
#include "tests/unit/configuration/full_samples.hpp"
#include "tests/unit/configuration/samples.hpp"

namespace levitas::configuration::test {
namespace {

template <class... Context, class File>
std::vector<std::uint64_t> BitsOf(File file, const Context&... context) {
  Bits bits;
  Describe(bits, file, context...);
  return bits.all;
}

constexpr int kRounds = 100;

TEST(RoundTrip, OfARigKeepsEveryBit) {
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    RigFile rig = FullRig();
    Jitter jitter(seed);
    Describe(jitter, rig);
    const std::string text = WriteRig(rig);
    const RigFile back = ParseRig(text, "written.yaml");
    ASSERT_EQ(BitsOf(back), BitsOf(rig)) << "seed " << seed;
    ASSERT_EQ(WriteRig(back), text);
  }
}

TEST(RoundTrip, OfAControllerKeepsEveryBit) {
  const RigNumbers rig = FullRig().numbers;
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    ControllerFile controller = FullController(rig);
    Jitter jitter(seed);
    Describe(jitter, controller, rig);
    const std::string text = WriteController(controller, rig);
    ASSERT_EQ(BitsOf(ParseController(text, "written.yaml", rig), rig), BitsOf(controller, rig))
        << "seed " << seed;
  }
}

TEST(RoundTrip, OfAScenarioKeepsEveryBit) {
  const RigNumbers rig = FullRig().numbers;
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    scenario::ScenarioConfig scenario = FullScenario(rig);
    Jitter jitter(seed);
    Describe(jitter, scenario, rig);
    const std::string text = WriteScenario(scenario);
    ASSERT_EQ(BitsOf(ParseScenario(text, "written.yaml", rig), rig), BitsOf(scenario, rig))
        << "seed " << seed;
  }
}

TEST(RoundTrip, OfARotorOfGivenModesKeepsEveryBit) {
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    RigFile rig = ModalRig();
    Jitter jitter(seed);
    Describe(jitter, rig);
    const RigFile back = ParseRig(WriteRig(rig), "written.yaml");
    ASSERT_EQ(BitsOf(back), BitsOf(rig)) << "seed " << seed;
    ASSERT_EQ(back.numbers.channels, rig.numbers.channels);
  }
}

TEST(RoundTrip, OfAStateSpaceLawKeepsEveryBit) {
  const RigNumbers rig = ModalRig().numbers;
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    ControllerFile controller = StateSpaceController(rig);
    Jitter jitter(seed);
    Describe(jitter, controller, rig);
    const std::string text = WriteController(controller, rig);
    const ControllerFile back = ParseController(text, "written.yaml", rig);
    ASSERT_EQ(BitsOf(back, rig), BitsOf(controller, rig)) << "seed " << seed;
    ASSERT_EQ(WriteController(back, rig), text);
  }
}

TEST(RoundTrip, OfEverySignalAndEventKeepsEveryBit) {
  const RigNumbers rig = FullRig().numbers;
  for (std::uint64_t seed = 1; seed <= kRounds; ++seed) {
    scenario::ScenarioConfig scenario = EventfulScenario(rig);
    Jitter jitter(seed);
    Describe(jitter, scenario, rig);
    const std::string text = WriteScenario(scenario);
    ASSERT_EQ(BitsOf(ParseScenario(text, "written.yaml", rig), rig), BitsOf(scenario, rig))
        << "seed " << seed;
  }
}

TEST(RoundTrip, KeepsNamesPolarityAndChannels) {
  RigFile rig = FullRig();
  rig.plant.sensor_polarity[3] = -1.0;
  rig.plant.actuator_polarity[0] = -1.0;
  const RigFile back = ParseRig(WriteRig(rig), "");
  EXPECT_EQ(back.numbers.name, "flexible_rotor");
  EXPECT_EQ(back.plant.sensor_polarity, rig.plant.sensor_polarity);
  EXPECT_EQ(back.plant.actuator_polarity, rig.plant.actuator_polarity);
  EXPECT_EQ(back.numbers.sensor_polarity, rig.plant.sensor_polarity);
  const scenario::ScenarioConfig scenario = FullScenario(rig.numbers);
  const auto again = ParseScenario(WriteScenario(scenario), "", rig.numbers);
  EXPECT_EQ(again.steps[1].excitation[1].channel, "nde_y");
  EXPECT_EQ(again.steps[1].excitation[1].axis, 3U);
  EXPECT_EQ(again.steps[0].wait_mode, Mode::kLevitating);
}

TEST(RoundTrip, WritesADifferentLawUnderItsAxis) {
  const RigNumbers rig = FullRig().numbers;
  ControllerFile controller = FullController(rig);
  controller.law.axes[2].notches.pop_back();
  const std::string text = WriteController(controller, rig);
  EXPECT_NE(text.find("\n  de:"), std::string::npos);
  EXPECT_EQ(text.find("\n  nde:"), std::string::npos);
  EXPECT_NE(text.find("\n  nde_x:"), std::string::npos);
  const ControllerFile back = ParseController(text, "", rig);
  EXPECT_EQ(back.law.axes[2].notches.size(), 1U);
  EXPECT_EQ(back.law.axes[3].notches.size(), 2U);
}

TEST(RoundTrip, OfAScheduleKeepsEverySpeed) {
  const RigNumbers rig = FullRig().numbers;
  ControllerFile controller = FullController(rig);
  controller.law.schedule = {{RpmToRadPerS(3000.0), controller.law.axes, {}},
                             {RpmToRadPerS(6000.0), controller.law.axes, {}}};
  controller.law.schedule[1].axes[3].kp_a_per_m = 1234.5;
  const ControllerFile back = ParseController(WriteController(controller, rig), "", rig);
  ASSERT_EQ(back.law.schedule.size(), 2U);
  EXPECT_EQ(back.law.schedule[1].speed_rad_per_s, RpmToRadPerS(6000.0));
  EXPECT_EQ(back.law.schedule[1].axes[3].kp_a_per_m, 1234.5);
  EXPECT_EQ(back.law.schedule[0].axes[3].kp_a_per_m, controller.law.axes[3].kp_a_per_m);
  controller.law.schedule[1].axes[0].notches.pop_back();
  try {
    (void)ParseController(WriteController(controller, rig), "c.yaml", rig);
    ADD_FAILURE() << "laws with other filters were read";
  } catch (const BadInput& refused) {
    EXPECT_THAT(refused.what(), ::testing::HasSubstr("axis 1 has 2 notches before and 1 here"));
    EXPECT_THAT(refused.what(), ::testing::HasSubstr("schedule.speeds[1].speed"));
  }
}

TEST(RoundTrip, OfSynchronousControlKeepsEveryNumber) {
  const RigNumbers rig = FullRig().numbers;
  const ControllerFile controller = SynchronousController(rig);
  const std::string text = WriteController(controller, rig);
  const ControllerFile back = ParseController(text, "", rig);
  EXPECT_EQ(WriteController(back, rig), text);
  ASSERT_EQ(back.synchronous.blocks.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const synchronous::BlockConfig& read = back.synchronous.blocks[k];
    const synchronous::BlockConfig& written = controller.synchronous.blocks[k];
    EXPECT_EQ(read.name, written.name);
    EXPECT_EQ(read.order, written.order);
    EXPECT_EQ(read.target, written.target);
    EXPECT_EQ(read.time_constant_s, 0.25);
    EXPECT_EQ(read.from_rad_per_s, written.from_rad_per_s);
    EXPECT_EQ(read.to_rad_per_s, written.to_rad_per_s);
    EXPECT_EQ(read.hysteresis_rad_per_s, written.hysteresis_rad_per_s);
    EXPECT_EQ(read.adaptive, written.adaptive);
    EXPECT_EQ(read.largest_current_a, written.largest_current_a);
    EXPECT_EQ(read.least_change_m, written.least_change_m);
    ASSERT_EQ(read.inverse.size(), 2U);
    EXPECT_EQ(read.inverse[1].inverse.real, written.inverse[1].inverse.real);
    EXPECT_EQ(read.inverse[1].inverse.imaginary, written.inverse[1].inverse.imaginary);
  }
  EXPECT_EQ(back.synchronous.angle.bandwidth_hz, 7.5);
  EXPECT_EQ(back.synchronous.saturated_s, 0.03);
  ASSERT_EQ(back.synchronous.run_outs.size(), 1U);
  EXPECT_NEAR(back.synchronous.run_outs[0].real_m[1], 3e-6, 1e-20);
}

TEST(RoundTrip, OfBiasSaving) {
  const RigNumbers rig = FullRig().numbers;
  const ControllerFile back =
      ParseController(WriteController(FullController(rig), rig), "c.yaml", rig);
  EXPECT_EQ(back.bias.lowest_current_a, 0.25);
  EXPECT_EQ(back.bias.largest_share, 0.625);
  EXPECT_EQ(back.bias.largest_orbit_fraction, 0.125);
  EXPECT_EQ(back.bias.lowering_time_s, 4.0);
  EXPECT_EQ(back.bias.raising_time_s, 0.008);
}

TEST(RoundTrip, OfBiasSavingNamesWhatCannotBe) {
  RigNumbers rig = FullRig().numbers;
  const auto refusal = [&] {
    try {
      (void)ParseController(WriteController(FullController(FullRig().numbers), rig), "c.yaml", rig);
      return std::string("accepted");
    } catch (const BadInput& refused) {
      return std::string(refused.what());
    }
  };
  EXPECT_EQ(refusal(), "accepted");
  rig.bias_current_a = 0.25;
  rig.max_coil_current_a = 2.0;
  EXPECT_THAT(refusal(), ::testing::HasSubstr("allowed below the rig's bias current, 0.25 A"));
  rig = FullRig().numbers;
  rig.magnet_gaps_m.clear();
  EXPECT_THAT(refusal(), ::testing::HasSubstr("whose force is not that of the gap squared"));
}

TEST(RoundTrip, OfSynchronousControlNamesWhatCannotBe) {
  const RigNumbers rig = FullRig().numbers;
  const auto refusal = [&](const std::function<void(synchronous::SynchronousConfig&)>& spoil) {
    ControllerFile controller = SynchronousController(rig);
    spoil(controller.synchronous);
    try {
      (void)ParseController(WriteController(controller, rig), "c.yaml", rig);
      return std::string("accepted");
    } catch (const BadInput& refused) {
      return std::string(refused.what());
    }
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal([](auto& c) { c.blocks[0].to_rad_per_s = 1.0; }),
              HasSubstr("must be above from_rpm"));
  EXPECT_THAT(refusal([](auto& c) { c.blocks[0].order = 900.0; }),
              HasSubstr("above half the sampling frequency"));
  EXPECT_THAT(refusal([](auto& c) { std::swap(c.blocks[1].inverse[0], c.blocks[1].inverse[1]); }),
              HasSubstr("the speeds must rise"));
  EXPECT_THAT(refusal([](auto& c) { c.blocks[1].largest_current_a = 900.0; }),
              HasSubstr("the coils leave"));
  EXPECT_THAT(refusal([](auto& c) { c.angle.source = synchronous::AngleSource::kSpeed; }),
              HasSubstr("run_outs need an angle that is measured"));
  EXPECT_THAT(refusal([](auto& c) {
                c.run_outs.clear();
                c.angle.source = synchronous::AngleSource::kOrbit;
                c.blocks[0].order = 1.0;
                c.blocks[0].target = synchronous::Target::kVibration;
              }),
              HasSubstr("target current leaves it"));
  EXPECT_THAT(refusal([](auto& c) { c.blocks[1].order = 3.0; }),
              HasSubstr("act at the same speeds"));
  EXPECT_THAT(refusal([](auto& c) { c.blocks[1].name = c.blocks[0].name; }),
              HasSubstr("two blocks have the name low"));
  EXPECT_THAT(refusal([](auto& c) { c.blocks[1].order = 2.5; }), HasSubstr("a whole number"));
  EXPECT_THAT(refusal([](auto& c) { c.blocks[0].hysteresis_rad_per_s = 1e3; }),
              HasSubstr("must be above hysteresis_rpm"));
  EXPECT_THAT(refusal([](auto& c) { c.angle.bandwidth_hz = 900.0; }),
              HasSubstr("a fiftieth of the sampling frequency"));
}

TEST(RoundTrip, OfAnExcitationWithoutAChannelIsRefusedWhenRead) {
  scenario::ScenarioConfig scenario = FullScenario(FullRig().numbers);
  scenario.steps[1].excitation[0].channel.clear();
  const std::string text = WriteScenario(scenario);
  EXPECT_THROW((void)ParseScenario(text, "", FullRig().numbers), BadInput);
  EXPECT_THROW((void)ParseScenario(text, "", RigNumbers{}), BadInput);
}

TEST(RoundTrip, WritesEveryDefault) {
  const std::string text = WriteRig(ParseRig(kRig, ""));
  for (const char* line : {"delay_samples: 1\n", "substeps: 4\n", "inner_diameter_mm: 0\n",
                           "discs: []\n", "modes_per_plane: 8\n", "direction_deg: 225\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace levitas::configuration::test
