// The shipped pump with a bias that falls while little is asked for: what it saves, that nobody
// notices, and what a blow would do if the bias were not raised in time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

const configuration::RigFile& Pump() {
  static const configuration::RigFile rig =
      configuration::LoadRig(SourceFolder() + "/config/rigs/turbomolecular_pump.yaml");
  return rig;
}

cycle::CycleConfig Plain() {
  const configuration::ControllerFile controller = configuration::LoadController(
      SourceFolder() + "/config/controllers/turbomolecular_pump.yaml", Pump().numbers);
  return {Pump().numbers, controller.law, controller.supervisor};
}

cycle::CycleConfig Saving() {
  cycle::CycleConfig config = Plain();
  config.bias.lowest_current_a = 0.2;
  return config;
}

/// [A] of the rig; never lowered.
double Whole() { return Pump().numbers.bias_current_a; }

struct Seen {
  double copper{};  ///< mean of b^2 + ic^2 over that of the rig's bias alone
  double orbit_m{};
  double lowest_a{1e9};
};

Seen Watch(ClosedLoop& loop, double seconds) {
  Seen run;
  loop.Reset();
  const auto periods = std::lround(seconds / Pump().numbers.period_s());
  for (long n = 0; n < periods; ++n) {
    (void)loop.Step();
    const double bias_a = loop.out.current.bias_current_a;
    run.lowest_a = std::min(run.lowest_a, bias_a);
    for (std::size_t i = 0; i < 4; ++i) {
      run.copper += bias_a * bias_a + std::pow(loop.out.current.control_current_a[i], 2);
    }
  }
  run.copper /= 4.0 * static_cast<double>(periods) * Whole() * Whole();
  run.orbit_m = loop.most.orbit_m;
  return run;
}

TEST(BiasSavingPair, HeatsTheCoilsLessAtTheSameOrbit) {
  ClosedLoop plain(Plain(), Pump().plant);
  ClosedLoop saving(Saving(), Pump().plant);
  for (ClosedLoop* loop : {&plain, &saving}) {
    ASSERT_TRUE(loop->Levitate());
    loop->SpinAt(3000.0);
    loop->Run(5.0);
  }
  const Seen before = Watch(plain, 1.0);
  const Seen after = Watch(saving, 1.0);
  EXPECT_EQ(before.lowest_a, Whole());
  EXPECT_GT(before.copper, 0.99);
  EXPECT_LT(after.copper, 0.1) << after.lowest_a << " A";
  EXPECT_LT(after.orbit_m, 1.1 * before.orbit_m);
}

// Falling and rising is no step: what moves is a current, not the force.
TEST(BiasSavingPair, ChangesTheBiasWithoutMovingTheRotor) {
  ClosedLoop plain(Plain(), Pump().plant);
  ClosedLoop saving(Saving(), Pump().plant);
  Seen moved[2];
  std::size_t k = 0;
  for (ClosedLoop* loop : {&plain, &saving}) {
    ASSERT_TRUE(loop->Levitate());
    moved[k++] = Watch(*loop, 5.0);
    loop->Command(OperatorCommand::kSpin, 600.0, 800.0);  // the whole bias, in milliseconds
    loop->Run(0.02);
    EXPECT_EQ(loop->out.current.bias_current_a, Whole());
    moved[k - 1].orbit_m = std::max(moved[k - 1].orbit_m, loop->most.orbit_m);
  }
  EXPECT_LT(moved[1].lowest_a, 0.3);
  EXPECT_LT(moved[1].orbit_m, 1.1 * moved[0].orbit_m);
}

/// Blows of the law's current, 0.3 A to and fro each 2 ms, on a rotor at the lowest bias.
struct Blows {
  int limited{};  ///< cycles with an axis at its limit, after the first two blows
  double orbit_m{};
  Fault fault{};
};

Blows Struck(const cycle::CycleConfig& config) {
  ClosedLoop loop(config, Pump().plant);
  EXPECT_TRUE(loop.Levitate());
  loop.Run(6.0);
  loop.Reset();
  Blows blows;
  for (int n = 0; n < 2000; ++n) {
    cycle::OperatorInput op;
    op.excitation_a[2] = (n / 20) % 2 == 0 ? 0.3 : -0.3;
    const bool limited = loop.Step(op).saturated_axes != 0;
    if (limited && n >= 200) ++blows.limited;
  }
  blows.orbit_m = loop.most.orbit_m;
  blows.fault = loop.out.fault;
  return blows;
}

TEST(BiasSavingPair, IsRaisedInTimeForABlow) {
  const Blows plain = Struck(Plain());
  const Blows raised = Struck(Saving());
  cycle::CycleConfig never = Saving();
  never.bias.raising_time_s = 1e6;
  const Blows without = Struck(never);
  EXPECT_EQ(plain.fault, Fault::kNone);
  EXPECT_EQ(raised.fault, Fault::kNone);
  EXPECT_EQ(plain.limited, 0);
  EXPECT_EQ(raised.limited, 0);
  EXPECT_LT(raised.orbit_m, 1.2 * plain.orbit_m);
  EXPECT_NE(without.fault, Fault::kNone) << "the harm: a law that has no current left";
  EXPECT_GT(without.orbit_m, 2.0 * plain.orbit_m);
}

}  // namespace
}  // namespace levitas::test
