// An excitation never drives the rotor into its touchdown bearings: the harm without the limit of
// the orbit, none with it. And what the law is fed, the protections are not.

#include <gtest/gtest.h>

#include "tests/support/shipped_loop.hpp"

namespace levitas::test {
namespace {

/// Lifts, then a slow sweep through the rigid modes, far too strong.
ShippedLoop Sweep(double orbit_limit_m) {
  ShippedLoop loop("flexible_rotor", "levitate");
  scenario::Step excite;
  excite.hold_s = 3.0;
  excite.orbit_limit_m = orbit_limit_m;
  scenario::Excitation sweep;
  sweep.channel = "de_x";
  sweep.kind = scenario::SignalKind::kChirp;
  sweep.amplitude_a = 0.6;
  sweep.from_hz = 5.0;
  sweep.to_hz = 120.0;
  sweep.repeat_s = 3.0;
  excite.excitation = {sweep};
  loop.scenario.steps = {loop.scenario.steps.front(), excite};
  loop.scenario.steps.front().hold_s = 0.2;
  // The trip would end the run before the rotor touches.
  loop.controller.supervisor.protection.orbit_fraction = 0.99;
  loop.controller.supervisor.protection.orbit_cycles = 100'000;
  loop.controller.supervisor.protection.coil_saturated_s = 10.0;
  return loop;
}

TEST(ExcitationPair, RotorTouchesWithoutTheOrbitLimit) {
  ShippedLoop loop = Sweep(0.0);
  (void)loop.Play(20261121, 10.0);
  EXPECT_GT(loop.most.contact_n, 0.0);
}

TEST(ExcitationPair, RotorNeverTouchesWithTheOrbitLimit) {
  ShippedLoop loop = Sweep(57e-6);  // 30 % of the clearance, what a scenario gets by itself
  EXPECT_EQ(loop.Play(20261121, 10.0), "");
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, 0.75 * 190e-6);
  EXPECT_GT(loop.most.excitation_a, 0.1);  // and it is excited all the same
}

// The paper's own excitation of the pump, all four axes at once, with its bits and its quarter
// starts.
TEST(Excitation, OfThePumpForIdentificationMovesAllAxesAndTouchesNothing) {
  ShippedLoop loop("turbomolecular_pump", "turbomolecular_pump_identify");
  AxisArray square_m2{};
  std::array<int, kMaxAxes> changes{};
  AxisArray last_m{};
  std::uint64_t excited = 0;
  const std::string problem = loop.Play(20261121, 10.0, [&](const cycle::CycleRecord& record) {
    if (record.in.op.excitation_m[0] == 0.0) return;
    ++excited;
    for (std::size_t i = 0; i < 4; ++i) {
      square_m2[i] += record.in.frame.position_m[i] * record.in.frame.position_m[i];
      if (record.in.op.excitation_m[i] != last_m[i]) ++changes[i];
    }
    last_m = record.in.op.excitation_m;
  });
  EXPECT_EQ(problem, "");
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_EQ(excited, 80'000U);  // 4 s at 20 kHz
  for (std::size_t i = 0; i < 4; ++i) {
    // Every one of the 8000 bits has an amplitude of its own.
    EXPECT_EQ(changes[i], 8000) << i;
    EXPECT_GT(std::sqrt(square_m2[i] / static_cast<double>(excited)), 1e-6) << i;
  }
}

// What is added to the measured position is for the law alone: the record shows the true reading,
// and a shift of the law's input beyond the orbit limit trips nothing by itself.
TEST(Excitation, OfTheMeasuredPositionIsSeenByTheLawAndByNoProtection) {
  const ShippedLoop loop("flexible_rotor", "levitate");
  cycle::ControlCycle cycle({loop.rig.numbers, loop.controller.law, loop.controller.supervisor});
  plant::Plant plant(loop.rig.plant, 1);
  plant.RestInTouchdown();
  cycle::CycleRecord record;
  const auto step = [&](double excitation_m, OperatorCommand command) {
    ++record.in.cycle;
    record.in.frame = plant.Sample();
    record.in.frame_present = true;
    record.in.op = {};
    record.in.op.command = command;
    record.in.op.excitation_m[0] = excitation_m;
    record.out = cycle.Step(record.in);
    plant.Advance(plant::CommandOf(record.out.current));
  };
  step(0.0, OperatorCommand::kLift);
  for (int n = 0; n < 15'000; ++n) step(0.0, OperatorCommand::kNone);
  ASSERT_EQ(record.out.mode, Mode::kLevitating);
  const double before_a = record.out.current.control_current_a[0];
  step(500e-6, OperatorCommand::kNone);  // beyond the clearance and the sensor's range
  EXPECT_LT(record.out.current.control_current_a[0], before_a - 0.5);
  for (int n = 0; n < 3; ++n) step(0.0, OperatorCommand::kNone);
  EXPECT_EQ(record.out.fault, Fault::kNone);
}

}  // namespace
}  // namespace levitas::test
