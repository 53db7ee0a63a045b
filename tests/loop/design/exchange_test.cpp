// Laws of unlike structure change places while the nonlinear rotor is levitated.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"
#include "controller/law/running_law.hpp"
#include "design/gate/gate.hpp"
#include "design/hinf/hinf_design.hpp"
#include "tests/support/shipped_loop.hpp"

namespace levitas::design {
namespace {

const double kExchange = RpmToRadPerS(1500.0);

test::ShippedLoop Shipped() { return {"flexible_rotor", "run_up_6000"}; }

/// Made once: a fifth of a second.
const law::LawConfig& Robust() {
  static const law::LawConfig law =
      hinf::DesignHinf(Shipped().rig.plant, hinf::HinfWeights{},
                       {.current_limit_a = 1.0, .top_speed_rad_per_s = RpmToRadPerS(6000.0)})
          .law;
  return law;
}

/// One law below kExchange, the other from there on.
law::LawConfig Exchanging(const law::LawConfig& below, const law::LawConfig& above) {
  law::LawConfig table = below;
  table.period_s = 1e-4;
  table.current_limit_a = 1.0;
  table.schedule = {{kExchange, above.axes, above.state_space, true}};
  return table;
}

/// How far a rotor that does not turn moves while its law is told of another speed.
struct Moved {
  double before_m{}, after_m{};  ///< largest distance from where it rested, at any bearing
  bool contact{};
  bool other_acts{};  ///< in the end
};

/// `at_once`: without listening, and with nothing of what the law before carried.
Moved Exchange(const law::LawConfig& table, bool upward, bool at_once) {
  const test::ShippedLoop loop = Shipped();
  plant::Plant plant(loop.rig.plant, 1);
  plant.RestInTouchdown();
  const AxisArray resting_m = plant.SensorOutput();
  law::RunningLaw law(table);
  const double from = upward ? 0.0 : 1.2 * kExchange;
  const double to = upward ? 1.2 * kExchange : 0.0;
  law.Start(from);
  plant::PlantCommand command;
  command.bias_current_a = loop.rig.numbers.bias_current_a;
  AxisArray mean_m{};
  Moved out;
  constexpr int kLift = 5000;
  constexpr int kSettle = 60'000;  // the robust law creeps to its place for seconds
  constexpr int kWatch = 20'000;
  for (int n = 0; n < kSettle + 2 * kWatch; ++n) {
    const SensorFrame frame = plant.Sample();
    const double still = n < kLift ? 1.0 - static_cast<double>(n) / kLift : 0.0;
    AxisArray error_m{};
    for (std::size_t i = 0; i < 4; ++i) {
      error_m[i] =
          loop.rig.numbers.sensor_polarity[i] * (still * resting_m[i] - frame.position_m[i]);
    }
    const bool other = n >= kSettle + kWatch;
    if (at_once && n == kSettle + kWatch) law.Start(to);
    const law::LawOutput given = law.Step(other ? to : from, error_m, {}, 1.0);
    for (std::size_t i = 0; i < 4; ++i)
      command.control_current_a[i] =
          loop.rig.numbers.actuator_polarity[i] * given.control_current_a[i];
    const AxisArray y = plant.SensorOutput();
    if (n < kSettle) {
      mean_m = y;  // a resting rotor: within its noise of a micrometre
    } else {
      double& largest_m = other ? out.after_m : out.before_m;
      for (std::size_t x = 0; x < 4; x += 2)
        largest_m = std::max(largest_m, std::hypot(y[x] - mean_m[x], y[x + 1] - mean_m[x + 1]));
    }
    plant.Advance(command);
    out.contact = out.contact || (n >= kLift && plant.ContactForce() > 0.0);
  }
  const law::LawLadder ladder(table);
  out.other_acts = ladder.Stretch(law.rung()) == ladder.Stretch(ladder.Nearest(to));
  return out;
}

TEST(Exchange, FromAPidToARobustLawMovesTheRotorNoFurtherThanWhereThatHoldsIt) {
  const law::LawConfig table = Exchanging(Shipped().controller.law, Robust());
  const Moved gently = Exchange(table, true, false);
  const Moved at_once = Exchange(table, true, true);
  EXPECT_TRUE(gently.other_acts);
  EXPECT_FALSE(gently.contact);
  EXPECT_LT(gently.before_m, 4e-6);
  EXPECT_LT(gently.after_m, 8e-6);
  EXPECT_GT(at_once.after_m, 3.0 * gently.after_m);
}

TEST(Exchange, FromARobustLawToAPidMovesItNoFurtherThanBackToTheCentre) {
  const law::LawConfig table = Exchanging(Shipped().controller.law, Robust());
  const Moved gently = Exchange(table, false, false);
  const Moved at_once = Exchange(table, false, true);
  EXPECT_TRUE(gently.other_acts);
  EXPECT_FALSE(gently.contact);
  EXPECT_LT(gently.after_m, 8e-6);
  EXPECT_GT(at_once.after_m, 3.0 * gently.after_m);
}

/// A law that trusts the modes of a rotor at rest, and loses them as they split over speed.
law::LawConfig OfRestOnly() {
  hinf::HinfWeights trusting;
  trusting.mode_hz = 1e-3;
  return hinf::MakeLaw(Shipped().rig.plant, trusting,
                       {.current_limit_a = 1.0, .top_speed_rad_per_s = RpmToRadPerS(6000.0)})
      .law;
}

/// The lowest speed from which on the law does not hold the rig, to 0.01 rad/s.
double HoldsTo(const law::LawConfig& law) {
  constexpr double kStep = 3.0;
  const configuration::RigFile rig = Shipped().rig;
  double loses = 0.0;
  while (analysis::SensitivityPeaks(rig.plant, law, loses).stable) loses += kStep;
  double holds = loses - kStep;
  EXPECT_GT(holds, 0.0);
  while (loses - holds > 0.01) {
    const double middle = 0.5 * (holds + loses);
    (analysis::SensitivityPeaks(rig.plant, law, middle).stable ? holds : loses) = middle;
  }
  return holds;
}

GateResult JudgeExchangeAt(const law::LawConfig& below, double speed_rad_per_s) {
  const test::ShippedLoop loop = Shipped();
  law::LawConfig table = Exchanging(below, loop.controller.law);
  table.schedule.front().speed_rad_per_s = speed_rad_per_s;
  GateOptions options;
  options.step_rad_per_s = RpmToRadPerS(6000.0);
  options.sensitivity = 100.0;  // beside where it loses the rotor no law has a small one
  options.corners = 0;
  options.draws = 1;
  options.run_speeds_rad_per_s = {0.0};
  return Judge(loop.rig, table, uncertainty::Stated(loop.rig, {}), options,
               [](double, const std::string&) {});
}

TEST(ExchangeGate, JudgesALawAsFarBeyondTheExchangeAsItGoesOnActing) {
  const law::LawConfig below = OfRestOnly();
  const double holds_to = HoldsTo(below);
  // So far the drive takes the rotor while the other law listens.
  const double listened = Shipped().rig.plant.drive.max_acceleration_rad_per_s2 * law::kListenS;
  ASSERT_GT(holds_to, 2.0 * listened);
  const GateResult early = JudgeExchangeAt(below, holds_to - 1.2 * listened);
  // Its loops hold. The run does not: a law that grows by itself cannot listen on the way back.
  EXPECT_THAT(early.reason, ::testing::HasSubstr("lost on the way to 6000 rpm and back"));
  EXPECT_EQ(early.exchanges, 1U);
  // Each law holds at its own speeds; the lower one acts a little above them.
  const GateResult late = JudgeExchangeAt(below, holds_to - 0.5 * listened);
  EXPECT_FALSE(late.accepted);
  EXPECT_THAT(late.reason, ::testing::HasSubstr("unstable"));
}

/// Largest radius from 2900 to 3100 rpm on the way, where the robust law keeps the rotor closer.
/// `acted`: which of its laws acted one after the other.
double OrbitAround3000(test::ShippedLoop& loop, std::vector<int>& acted) {
  double largest_m = 0.0;
  EXPECT_EQ(loop.Play(1, 60.0,
                      [&](const cycle::CycleRecord& record) {
                        if (acted.empty() || acted.back() != record.out.acting_law)
                          acted.push_back(record.out.acting_law);
                        const double rpm = RadPerSToRpm(record.in.frame.speed_rad_per_s);
                        if (std::abs(rpm - 3000.0) < 100.0)
                          largest_m =
                              std::max(largest_m, test::ShippedLoop::Radius(record.in.frame));
                      }),
            "");
  return largest_m;
}

// The control cycle itself, through the exchange and back: the scenario runs up and down.
TEST(Exchange, TakesTheRotorThroughItsSpeedsAndBack) {
  test::ShippedLoop plain = Shipped();
  test::ShippedLoop loop = Shipped();
  loop.controller.law = Exchanging(loop.controller.law, Robust());
  std::vector<int> acted;
  std::vector<int> only;
  EXPECT_LT(OrbitAround3000(loop, acted), 0.85 * OrbitAround3000(plain, only));
  EXPECT_THAT(only, ::testing::ElementsAre(0));
  EXPECT_THAT(acted, ::testing::ElementsAre(0, 1, 0));
  EXPECT_GT(loop.most.speed_rad_per_s, RpmToRadPerS(5950.0));
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, loop.rig.numbers.spinning_orbit_objective_m);
}

}  // namespace
}  // namespace levitas::design
