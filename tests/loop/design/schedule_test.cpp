// Laws over speed: put together, judged by the gate, run by the control cycle on the nonlinear rig.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "analysis/poles.hpp"
#include "analysis/sampled_loop.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"
#include "design/gate/gate.hpp"
#include "design/pid/align_blocks.hpp"
#include "numerics/dense/spectrum.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::design {
namespace {

law::StateSpaceConfig Drawn(Random& random) {
  law::StateSpaceConfig out;
  out.axes = 2;
  out.discrete = true;
  for (int i = 0; i < 5; ++i) {
    law::ModalBlock block;
    block.pole_real = 0.2 * i;
    block.pole_imaginary = i < 2 ? 0.0 : 0.1 * i;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      block.first_input[axis] = random.Normal();
      block.first_output[axis] = random.Normal();
      if (i < 2) continue;
      block.second_input[axis] = random.Normal();
      block.second_output[axis] = random.Normal();
    }
    out.blocks.push_back(block);
  }
  return out;
}

/// The same law in other coordinates: states turned and scaled, blocks in another order.
law::StateSpaceConfig InOtherCoordinates(law::StateSpaceConfig law, Random& random) {
  for (law::ModalBlock& block : law.blocks) {
    const double size = 0.5 + random.Uniform();
    const double angle = block.pole_imaginary == 0.0 ? 0.0 : 6.0 * random.Uniform();
    const double c = size * std::cos(angle);
    const double s = size * std::sin(angle);
    for (std::size_t i = 0; i < 2; ++i) {
      // w' = T w with T = [c s; -s c], which commutes with the block.
      const double b1 = block.first_input[i];
      const double b2 = block.second_input[i];
      block.first_input[i] = c * b1 + s * b2;
      block.second_input[i] = -s * b1 + c * b2;
      const double c1 = block.first_output[i];
      const double c2 = block.second_output[i];
      block.first_output[i] = (c * c1 + s * c2) / (size * size);
      block.second_output[i] = (-s * c1 + c * c2) / (size * size);
    }
  }
  std::ranges::reverse(law.blocks);
  return law;
}

TEST(AlignBlocks, BringsTheSameLawIntoTheSameCoordinates) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    const law::StateSpaceConfig law = Drawn(random);
    const law::StateSpaceConfig back = AlignBlocks(law, InOtherCoordinates(law, random));
    ASSERT_EQ(back.blocks.size(), law.blocks.size());
    for (std::size_t i = 0; i < law.blocks.size(); ++i) {
      EXPECT_EQ(back.blocks[i].pole_real, law.blocks[i].pole_real);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(back.blocks[i].first_input[axis], law.blocks[i].first_input[axis], 1e-12);
        EXPECT_NEAR(back.blocks[i].second_input[axis], law.blocks[i].second_input[axis], 1e-12);
        EXPECT_NEAR(back.blocks[i].first_output[axis], law.blocks[i].first_output[axis], 1e-12);
        EXPECT_NEAR(back.blocks[i].second_output[axis], law.blocks[i].second_output[axis], 1e-12);
      }
    }
  }
}

// Integrators of four channels have one pole, and the filters of x those of y.
TEST(AlignBlocks, TellsBlocksOfTheSamePoleByTheAxesThatTheyRead) {
  law::StateSpaceConfig law;
  law.axes = 2;
  law.discrete = true;
  for (const double pole : {1.0, 0.6})
    for (const std::size_t axis : {0U, 1U}) {
      law::ModalBlock block;
      block.pole_real = pole;
      block.first_input[axis] = 1.0;
      block.first_output[axis] = 5.0 + pole;
      law.blocks.push_back(block);
    }
  law::StateSpaceConfig other = law;
  std::ranges::reverse(other.blocks);
  const law::StateSpaceConfig back = AlignBlocks(law, other);
  for (std::size_t i = 0; i < law.blocks.size(); ++i) {
    EXPECT_EQ(back.blocks[i].pole_real, law.blocks[i].pole_real) << i;
    EXPECT_EQ(back.blocks[i].first_input, law.blocks[i].first_input) << i;
    EXPECT_EQ(back.blocks[i].first_output, law.blocks[i].first_output) << i;
  }
}

TEST(AlignBlocks, LeavesALawOfAnotherKindToBeRefused) {
  Random random(1);
  const law::StateSpaceConfig law = Drawn(random);
  law::StateSpaceConfig other = law;
  other.blocks[0].pole_imaginary = 0.3;  // two states where the reference has one
  law::LawConfig table;
  table.state_space = law;
  table.schedule = {{1.0, {}, AlignBlocks(law, other)}};
  EXPECT_NE(law::WhyNoSchedule(table), "");
}

/// The commissioned law of the flexible rotor at rest; at these speeds its gains times the factors.
law::LawConfig Table(const law::LawConfig& law,
                     const std::vector<std::pair<double, double>>& factor_at_rpm) {
  law::LawConfig table = law;
  for (const auto& [rpm, factor] : factor_at_rpm) {
    law::LawAtSpeed at{RpmToRadPerS(rpm), law.axes, {}};
    for (law::AxisLawConfig& axis : at.axes) {
      axis.kp_a_per_m *= factor;
      axis.kd_a_s_per_m *= factor;
    }
    table.schedule.push_back(at);
  }
  return table;
}

GateResult JudgeQuietly(const test::ShippedLoop& loop, const law::LawConfig& law) {
  GateOptions options;
  options.step_rad_per_s = RpmToRadPerS(6000.0);  // five times as dense: every 1200 rpm
  options.corners = 1;
  options.draws = 1;
  options.run_speeds_rad_per_s = {0.0, RpmToRadPerS(6000.0)};
  return Judge(loop.rig, law, uncertainty::Stated(loop.rig, {}), options,
               [](double, const std::string&) {});
}

TEST(ScheduleGate, LooksAtEveryLawBetweenTheSpeedsOfTheTable) {
  const test::ShippedLoop loop("flexible_rotor", "run_up_6000");
  const law::LawConfig& law = loop.controller.law;
  const GateResult good = JudgeQuietly(loop, Table(law, {{6000.0, 1.1}}));
  EXPECT_TRUE(good.accepted) << good.reason;
  EXPECT_EQ(good.rungs, law::kRungs);
  ASSERT_TRUE(good.run_up.has_value());
  EXPECT_FALSE(good.run_up->lost);
  // Too weak to hold the rotor between 2650 and 2750 rpm, where no other check looks.
  const GateResult gap =
      JudgeQuietly(loop, Table(law, {{2650.0, 1.0}, {2700.0, 0.3}, {2750.0, 1.0}, {6000.0, 1.0}}));
  EXPECT_FALSE(gap.accepted);
  EXPECT_THAT(gap.reason, ::testing::HasSubstr("the loop with the schedule's law of 26"));
}

// The QR iteration of Eigen gives up on some of these loops once they are balanced, and its poles
// are then whatever stood in memory. Another matrix of the same poles, not balanced, is the judge.
TEST(ScheduleGate, JudgesPolesThatAnIterationHasFound) {
  const test::ShippedLoop loop("flexible_rotor", "run_up_6000");
  const law::LawConfig table = Table(loop.controller.law, {{6000.0, 1.1}});
  for (std::size_t rung = 0; rung < law::kRungs; ++rung) {
    const double speed = RpmToRadPerS(6000.0) * static_cast<double>(rung) / (law::kRungs - 1);
    const auto found = analysis::ClosedLoopPoles(loop.rig.plant, table, speed);
    const auto judge = numerics::EigenvaluesOf(
        analysis::ClosedLoopMatrix(analysis::CloseLoop(loop.rig.plant, table, speed)));
    ASSERT_NEAR(found.largest_pole_modulus, judge.cwiseAbs().maxCoeff(), 1e-6) << rung;
    ASSERT_TRUE(found.stable) << rung;
  }
}

// The control cycle itself on the nonlinear rig, through every speed and law.
TEST(ScheduledLaw, TakesTheRotorThroughItsSpeedsWithoutABump) {
  test::ShippedLoop loop("flexible_rotor", "run_up_6000");
  loop.controller.law = Table(loop.controller.law, {{3000.0, 1.15}, {6000.0, 0.95}});
  EXPECT_EQ(loop.Play(1, 60.0), "");
  EXPECT_GT(loop.most.speed_rad_per_s, RpmToRadPerS(5950.0));
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, loop.rig.numbers.spinning_orbit_objective_m);
}

}  // namespace
}  // namespace levitas::design
