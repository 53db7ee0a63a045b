// Frames and currents that are lost or late, not in a row but by share: what the rotor does without
// the windowed protections and with the shipped ones.

#include <gtest/gtest.h>

#include <cmath>

#include "common/random.hpp"
#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

struct Loss {
  double energised_contact_s{};  ///< time in contact with the law on, above 100 rpm
  double orbit_m{};
  Fault fault{};
  bool levitated_stop{};  ///< the amplifiers stayed on in the cycle of the trip ...
  bool released{};        ///< ... and were off in the end
};

/// Spinning at 3000 rpm; `lost(n)` decides about each frame for `time_s`.
Loss Lose(const cycle::CycleConfig& config, const std::function<bool(long)>& lost, double time_s) {
  ClosedLoop loop(config, RollingTouchdownRig());
  EXPECT_TRUE(loop.Levitate());
  loop.SpinAt(3000.0);
  Loss loss;
  const long cycles = std::lround(time_s / 1e-4);
  for (long n = 0; n < cycles; ++n) {
    loop.disturb = [&](cycle::CycleInputs& in) { in.frame_present = !lost(n); };
    const Fault before = loop.out.fault;
    (void)loop.Step();
    if (before == Fault::kNone && loop.out.fault != Fault::kNone) {
      loss.levitated_stop = loop.out.current.amplifiers_enabled;
      loss.orbit_m = loop.most.orbit_m;
    }
    if (loop.out.current.amplifiers_enabled && loop.speed_rpm() > 100.0 &&
        loop.plant.ContactForce() > 0.0) {
      loss.energised_contact_s += 1e-4;
    }
  }
  loss.fault = loop.out.fault;
  loss.released = !loop.out.current.amplifiers_enabled;
  if (loss.fault == Fault::kNone) loss.orbit_m = loop.most.orbit_m;
  loop.disturb = nullptr;
  return loss;
}

TEST(FrameMissingPair, NineOfTenFramesLostInBurstsAreALineThatIsCut) {
  const auto bursts = [](long n) { return n % 10 < 9; };
  const Loss without = Lose(Only(Fault::kNone), bursts, 0.5);
  EXPECT_GT(without.energised_contact_s, 0.05);
  const Loss with = Lose(ShippedCycle(), bursts, 0.5);
  EXPECT_EQ(with.fault, Fault::kFramesLost);  // the first cause, at 30 of 100
  EXPECT_TRUE(with.released);                 // at 34 of 40, before the rotor touches
  EXPECT_EQ(with.energised_contact_s, 0.0);
}

// By half of the frames the rotor may graze its bearings during three seconds of braking; what
// outlasts 20 ms would have been a release.
TEST(FramesLostPair, SharesThatALawMayStillHoldEndInALevitatedStop) {
  for (const double share : {0.3, 0.5}) {
    Random draw(20261125);
    const auto lost = [&](long) { return draw.Uniform() < share; };
    const Loss with = Lose(ShippedCycle(), lost, 4.5);
    EXPECT_EQ(with.fault, Fault::kFramesLost) << share;
    EXPECT_TRUE(with.levitated_stop) << share;
    EXPECT_LT(with.energised_contact_s, 0.02) << share;
  }
}

TEST(FramesLostPair, NineOfTenFramesDrawnAtRandomReleaseTheRotor) {
  Random draw(20261125);
  const auto lost = [&](long) { return draw.Uniform() < 0.9; };
  const Loss with = Lose(ShippedCycle(), lost, 0.5);
  EXPECT_NE(with.fault, Fault::kNone);
  EXPECT_TRUE(with.released);
  EXPECT_EQ(with.energised_contact_s, 0.0);
}

TEST(FramesLostPair, SingleLossesTripNothing) {
  Random draw(20261126);
  const auto lost = [&](long) { return draw.Uniform() < 0.05; };
  const Loss with = Lose(ShippedCycle(), lost, 4.0);
  EXPECT_EQ(with.fault, Fault::kNone);
  EXPECT_LT(with.orbit_m, 95e-6);
}

// Each current acts a period late, and the rig says so: the rotor is stopped while the law can
// still hold it, before any watchdog of the rig.
TEST(CurrentsLatePair, EndInALevitatedStopWithinTheTwentyPeriodsOfARigsOwnWatchdog) {
  const auto run = [](const cycle::CycleConfig& config) {
    ClosedLoop loop(config, RollingTouchdownRig());
    EXPECT_TRUE(loop.Levitate());
    loop.SpinAt(3000.0);
    plant::PlantCommand late;
    bool has_late = false;
    std::uint32_t held = 0;
    loop.disturb = [&](cycle::CycleInputs& in) {
      in.frame.held_currents = ++held;
      in.frame.rig_status |= kRigCurrentHeld;
    };
    loop.overrule = [&](plant::PlantCommand& command) {
      const plant::PlantCommand now = command;
      if (has_late) command = late;
      late = now;
      has_late = true;
    };
    int periods = 0;
    while (loop.out.fault == Fault::kNone && periods < 1000) {
      (void)loop.Step();
      ++periods;
    }
    const bool levitated = loop.out.current.amplifiers_enabled;
    loop.Run(4.5);
    return std::tuple{periods, levitated, loop.out.fault, loop.most.contact_work_j,
                      loop.speed_rpm()};
  };
  const auto [endless, on, none, without_j, still_rpm] = run(Only(Fault::kNone));
  EXPECT_EQ(endless, 1000);
  EXPECT_EQ(none, Fault::kNone);
  EXPECT_GT(still_rpm, 2900.0);
  const auto [periods, levitated, fault, with_j, rpm] = run(ShippedCycle());
  EXPECT_LT(periods, 20);
  EXPECT_TRUE(levitated);
  EXPECT_EQ(fault, Fault::kCurrentsLate);
  EXPECT_EQ(with_j, 0.0);
  EXPECT_LT(rpm, 5.0);
}

}  // namespace
}  // namespace levitas::test
