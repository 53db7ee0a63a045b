#include "controller/law/law_schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/random.hpp"
#include "controller/law/discrete_law.hpp"
#include "tests/unit/law/flexible_rotor_law.hpp"

namespace levitas::law {
namespace {

constexpr double kTop = 600.0;  // rad/s

/// Rest and one speed, whose gains are `factor` times those at rest.
LawConfig Scheduled(double factor) {
  LawConfig config = FlexibleRotorLaw();
  LawAtSpeed fast{kTop, config.axes, {}};
  for (AxisLawConfig& axis : fast.axes) {
    axis.kp_a_per_m *= factor;
    axis.ki_a_per_m_s *= factor;
    axis.kd_a_s_per_m *= factor;
  }
  config.schedule = {fast};
  return config;
}

StateSpaceConfig DrawnBlocks(Random& random) {
  StateSpaceConfig law;
  law.axes = 4;
  law.discrete = true;
  for (int i = 0; i < 6; ++i) {
    ModalBlock block;
    const double radius = std::sqrt(random.Uniform());
    const double angle = 3.1 * random.Uniform() + 0.01;
    block.pole_real = radius * std::cos(angle);
    block.pole_imaginary = i == 0 ? 0.0 : radius * std::sin(angle);
    block.first_input.fill(1.0);
    block.first_output.fill(1.0);
    law.blocks.push_back(block);
  }
  law.input_v_per_m.fill(1e6);
  law.output_a_per_v.fill(1.0);
  return law;
}

TEST(LawSchedule, HasTheLawsOfTheTableAtItsSpeedsAndTheMeanHalfway) {
  const LawConfig config = Scheduled(3.0);
  const double slow = config.axes[1].kp_a_per_m;
  EXPECT_EQ(LawAt(config, 0.0).axes[1].kp_a_per_m, slow);
  EXPECT_EQ(LawAt(config, kTop).axes[1].kp_a_per_m, 3.0 * slow);
  EXPECT_DOUBLE_EQ(LawAt(config, 0.5 * kTop).axes[1].kp_a_per_m, 2.0 * slow);
  EXPECT_EQ(LawAt(config, -kTop).axes[1].kp_a_per_m, 3.0 * slow);       // its size counts
  EXPECT_EQ(LawAt(config, 9.0 * kTop).axes[1].kp_a_per_m, 3.0 * slow);  // it stays beyond the last
  EXPECT_EQ(LawAt(config, 0.0).axes[1].notches.size(), 2U);
  EXPECT_TRUE(LawAt(config, 0.0).schedule.empty());
  EXPECT_EQ(LawAt(FlexibleRotorLaw(), 100.0).axes.size(), 4U);  // without a schedule: itself
}

TEST(LawSchedule, OfThreeSpeedsGoesThroughTheMiddleOne) {
  LawConfig config = Scheduled(3.0);
  config.schedule.insert(config.schedule.begin(), {0.25 * kTop, config.axes, {}});
  config.schedule[0].axes[0].kp_a_per_m = 9000.0;
  EXPECT_DOUBLE_EQ(LawAt(config, 0.25 * kTop).axes[0].kp_a_per_m, 9000.0);
  EXPECT_LT(LawAt(config, 0.2 * kTop).axes[0].kp_a_per_m, 9000.0);
}

TEST(LawSchedule, StaysStableBetweenStableLawsWhateverTheyAre) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    LawConfig config;
    config.period_s = kPeriodS;
    config.state_space = DrawnBlocks(random);
    config.schedule = {{kTop, {}, DrawnBlocks(random)}};
    for (int i = 0; i <= 20; ++i) {
      const LawConfig law = LawAt(config, kTop * i / 20.0);
      for (const ModalBlock& block : law.state_space->blocks) {
        ASSERT_LT(std::hypot(block.pole_real, block.pole_imaginary), 1.0) << seed << ' ' << i;
      }
    }
  }
}

TEST(LawSchedule, SaysWhyLawsAreNone) {
  EXPECT_EQ(WhyNoSchedule(FlexibleRotorLaw()), "");
  EXPECT_EQ(WhyNoSchedule(Scheduled(2.0)), "");
  LawConfig falling = Scheduled(2.0);
  falling.schedule.push_back(falling.schedule[0]);
  EXPECT_EQ(WhyNoSchedule(falling), "entry 2: its speed is not above that of the entry before");
  LawConfig resting = Scheduled(2.0);
  resting.schedule[0].speed_rad_per_s = 0.0;
  EXPECT_EQ(WhyNoSchedule(resting),
            "entry 1: its speed is not above rest, where the law of the file holds");
  LawConfig shorter = Scheduled(2.0);
  shorter.schedule[0].axes[2].notches.pop_back();
  const std::string remedy = "; `exchange: true` lets it take over all the same";
  EXPECT_EQ(WhyNoSchedule(shorter), "entry 1: axis 3 has 2 notches before and 1 here" + remedy);
  shorter.schedule[0].exchange = true;
  EXPECT_EQ(WhyNoSchedule(shorter), "");
  shorter.schedule[0].axes.pop_back();
  EXPECT_EQ(WhyNoSchedule(shorter), "entry 1: it has laws for other axes than the one before");
  LawConfig mixed = Scheduled(2.0);
  Random random(1);
  mixed.schedule[0] = {kTop, {}, DrawnBlocks(random)};
  EXPECT_EQ(WhyNoSchedule(mixed),
            "entry 1: one has a state-space law, the other laws of axes" + remedy);
  LawConfig blocks;
  blocks.state_space = DrawnBlocks(random);
  blocks.schedule = {{kTop, {}, DrawnBlocks(random)}};
  blocks.schedule[0].state_space->blocks[1].pole_imaginary = 0.0;
  EXPECT_EQ(WhyNoSchedule(blocks),
            "entry 1: its block 2 is not of the kind of the one before: one state or two, one sign "
            "of im" +
                remedy);
  EXPECT_THROW((void)LawAt(falling, 0.0), std::invalid_argument);
  EXPECT_THROW(LawLadder{falling}, std::invalid_argument);
  EXPECT_THROW(LawCoefficients{Scheduled(2.0)}, std::invalid_argument);
}

TEST(LawLadder, IsOneLawWithoutASchedule) {
  const LawLadder ladder(FlexibleRotorLaw());
  EXPECT_EQ(ladder.size(), 1U);
  EXPECT_EQ(ladder.Nearest(500.0), 0U);
  EXPECT_EQ(ladder.Next(0, 500.0), 0U);
}

TEST(LawLadder, RunsTheLawThatAnalysesTake) {
  const LawConfig config = Scheduled(3.0);
  const LawLadder ladder(config);
  ASSERT_EQ(ladder.size(), kRungs);
  for (const double speed : {0.0, 1.0, 77.7, 300.0, 599.0, kTop, 2.0 * kTop}) {
    const LawCoefficients law(LawAt(config, speed));
    EXPECT_EQ(ladder[ladder.Nearest(speed)].pid().direct.at[2], law.pid().direct.at[2]) << speed;
  }
}

TEST(LawLadder, TakesOneRungAPeriodAndIgnoresNoise) {
  const LawLadder ladder(Scheduled(3.0));
  const double width = kTop / static_cast<double>(kRungs - 1);
  EXPECT_EQ(ladder.Next(10, kTop), 11U);
  EXPECT_EQ(ladder.Next(10, 0.0), 9U);
  EXPECT_EQ(ladder.Next(0, 0.0), 0U);
  EXPECT_EQ(ladder.Next(kRungs - 1, 9.0 * kTop), kRungs - 1);
  EXPECT_EQ(ladder.Next(10, std::numeric_limits<double>::quiet_NaN()), 10U);
  EXPECT_EQ(ladder.Nearest(std::numeric_limits<double>::quiet_NaN()), 0U);
  // Between two rungs, with noise of a fifth of their distance, the law changes once at most.
  std::size_t rung = 10;
  int changes = 0;
  Random random(5);
  for (int n = 0; n < 10'000; ++n) {
    const double noise = 0.2 * (2.0 * random.Uniform() - 1.0);
    const std::size_t next = ladder.Next(rung, (10.5 + noise) * width);
    changes += next != rung ? 1 : 0;
    rung = next;
  }
  EXPECT_LE(changes, 1);
}

TEST(LawLadder, CountsTheStretchesBetweenExchanges) {
  LawConfig config = Scheduled(2.0);
  LawAtSpeed plain{2.0 * kTop, {FlexibleRotorLaw().axes}, {}, true};
  for (AxisLawConfig& axis : plain.axes) axis.notches.clear();
  config.schedule.push_back(plain);
  const LawLadder ladder(config);
  const std::size_t middle = ladder.Nearest(kTop);
  EXPECT_EQ(ladder.Stretch(0), 0U);
  EXPECT_EQ(ladder.Stretch(middle), 0U);
  EXPECT_EQ(ladder.Stretch(kRungs - 2), 0U) << "below its speed the law before stays";
  EXPECT_EQ(ladder.Stretch(kRungs - 1), 1U);
  EXPECT_EQ(LawAt(config, 1.9 * kTop).axes[0].kp_a_per_m, config.schedule[0].axes[0].kp_a_per_m);
  EXPECT_TRUE(LawAt(config, 2.0 * kTop).axes[0].notches.empty());
  // Back across the exchange 3 % lower only; elsewhere three quarters of a rung do.
  const double width = 2.0 * kTop / static_cast<double>(kRungs - 1);
  EXPECT_EQ(ladder.Next(kRungs - 1, 2.0 * kTop - 7.0 * width), kRungs - 1);
  EXPECT_EQ(ladder.Next(kRungs - 1, 2.0 * kTop - 8.0 * width), kRungs - 2);
  EXPECT_EQ(ladder.Next(100, 99.0 * width), 99U);
}

/// Where the ladder, taken from one speed to another, comes to another stretch.
std::vector<double> SpeedsOfExchange(const LawLadder& ladder, double from, double to) {
  constexpr int kSteps = 200'000;
  std::vector<double> out;
  std::size_t rung = ladder.Nearest(from);
  for (int i = 0; i <= kSteps; ++i) {
    const double speed = std::lerp(from, to, static_cast<double>(i) / kSteps);
    const std::size_t next = ladder.Next(rung, speed);
    if (ladder.Stretch(next) != ladder.Stretch(rung)) out.push_back(speed);
    rung = next;
  }
  return out;
}

TEST(Exchanges, SayHowFarEachLawMayAct) {
  LawConfig config = FlexibleRotorLaw();
  for (const double speed : {0.13 * kTop, 0.6 * kTop, kTop}) {
    LawAtSpeed at{speed, config.axes, {}, true};
    if (config.schedule.size() != 1) at.axes[0].notches.clear();
    config.schedule.push_back(at);
  }
  const std::vector<Exchange> exchanges = Exchanges(config);
  const LawLadder ladder(config);
  ASSERT_EQ(exchanges.size(), 3U);
  const auto up = SpeedsOfExchange(ladder, 0.0, 1.1 * kTop);
  auto down = SpeedsOfExchange(ladder, 1.1 * kTop, 0.0);
  std::ranges::reverse(down);
  ASSERT_EQ(up.size(), 3U);
  ASSERT_EQ(down.size(), 3U);
  const double width = kTop / static_cast<double>(kRungs - 1);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(exchanges[i].at_rad_per_s, config.schedule[i].speed_rad_per_s, width) << i;
    EXPECT_LE(up[i], exchanges[i].at_rad_per_s + 0.01) << i;
    EXPECT_GE(down[i], exchanges[i].upper_from_rad_per_s - 0.01) << i;
    EXPECT_NEAR(down[i], exchanges[i].upper_from_rad_per_s, 0.02) << i;
    EXPECT_EQ(exchanges[i].lower.axes[0].notches.empty(), i == 1) << i;
    EXPECT_EQ(exchanges[i].upper.axes[0].notches.empty(), i != 1) << i;
  }
  EXPECT_TRUE(Exchanges(Scheduled(2.0)).empty());
  EXPECT_TRUE(Exchanges(FlexibleRotorLaw()).empty());
}

}  // namespace
}  // namespace levitas::law
