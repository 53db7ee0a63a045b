// The other half of a protection: what does no harm must not stop the machine. Shipped limits, all
// of them, on the nonlinear plant.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {
namespace {

struct Nuisance {
  const char* name;
  double speed_rpm;
  void (*disturb)(long cycle, cycle::CycleInputs& in);
};

class Harmless : public testing::TestWithParam<Nuisance> {};

TEST_P(Harmless, NeitherTripsNorTouches) {
  ClosedLoop loop;
  ASSERT_TRUE(loop.Levitate());
  loop.SpinAt(GetParam().speed_rpm);
  long n = 0;
  loop.disturb = [&](cycle::CycleInputs& in) { GetParam().disturb(n++, in); };
  loop.Run(2.0);
  EXPECT_EQ(loop.out.fault, Fault::kNone) << Name(loop.out.fault);
  EXPECT_EQ(loop.out.mode, Mode::kSpinning);
  EXPECT_EQ(loop.most.contact_n, 0.0);
  EXPECT_LT(loop.most.orbit_m, 95e-6);  // half the clearance: where the orbit protection begins
}

INSTANTIATE_TEST_SUITE_P(
    OfEveryKind, Harmless,
    testing::Values(
        Nuisance{"OneFrameInAHundredLost", 3000.0,
                 [](long n, cycle::CycleInputs& in) { in.frame_present = n % 100 != 0; }},
        Nuisance{"ThreeFramesInARowLostTenTimesASecond", 3000.0,
                 [](long n, cycle::CycleInputs& in) { in.frame_present = n % 1000 >= 3; }},
        Nuisance{"AReadingRepeatedSomeTimes", 3000.0,
                 [](long n, cycle::CycleInputs& in) {
                   static double held_m = 0.0;
                   if (n % 1000 == 0) held_m = in.frame.position_m[1];
                   if (n % 1000 < 5) in.frame.position_m[1] = held_m;
                 }},
        Nuisance{"OneFullScaleReadingASecond", 3000.0,
                 [](long n, cycle::CycleInputs& in) {
                   if (n % 10'000 == 5'000) in.frame.position_m[2] = 400e-6;
                 }},
        Nuisance{
            "TenDeadlinesMissedASecond", 6000.0,
            [](long n, cycle::CycleInputs& in) { in.missed_deadlines = n % 1'000 == 0 ? 1U : 0U; }},
        Nuisance{"SpeedJustAboveTheRatedOne", 6000.0,
                 [](long n, cycle::CycleInputs& in) {
                   // Within a second: a drive that overshoots, not one that jumps.
                   in.frame.speed_rad_per_s *=
                       1.0 + 0.05 * std::min(1.0, static_cast<double>(n) / 10'000.0);
                 }},
        Nuisance{"ASpeedReadAsZeroTenTimesASecond", 3000.0,
                 [](long n, cycle::CycleInputs& in) {
                   if (n % 1'000 == 500) in.frame.speed_rad_per_s = 0.0;
                 }},
        Nuisance{"ASpeedThatIsNoNumberTenTimesASecond", 3000.0,
                 [](long n, cycle::CycleInputs& in) {
                   if (n % 1'000 == 500) in.frame.speed_rad_per_s = std::nan("");
                 }},
        Nuisance{"OneCurrentInTenHeldByTheRig", 3000.0,
                 [](long n, cycle::CycleInputs& in) {
                   in.frame.held_currents = static_cast<std::uint32_t>(n / 10);
                 }},
        Nuisance{"ExcitationOfEveryAxis", 3000.0,
                 [](long n, cycle::CycleInputs& in) {
                   for (std::size_t i = 0; i < 4; ++i) {
                     in.op.excitation_a[i] = (n / 7 + static_cast<long>(i)) % 2 == 0 ? 0.05 : -0.05;
                   }
                 }}),
    [](const auto& test) { return test.param.name; });

// The same nuisances carried over the limit do trip: the limit is what tells them apart.
TEST(Limit, IsTheOnlyDifferenceBetweenANuisanceAndAFault) {
  struct Step {
    const char* name;
    int harmless;
    int harmful;
    Fault fault;
    void (*disturb)(cycle::CycleInputs& in);
  };
  // From the shipped controller: ten cycles without a frame, three at the end of the range.
  const Step steps[] = {
      {"frames", 9, 10, Fault::kFrameMissing,
       [](cycle::CycleInputs& in) { in.frame_present = false; }},
      {"range", 2, 3, Fault::kSensorOutOfRange,
       [](cycle::CycleInputs& in) { in.frame.position_m[0] = -390e-6; }},
  };
  for (const Step& step : steps) {
    for (const int cycles : {step.harmless, step.harmful}) {
      ClosedLoop loop;
      ASSERT_TRUE(loop.Levitate());
      loop.Run(0.5);
      loop.disturb = step.disturb;
      for (int n = 0; n < cycles; ++n) (void)loop.Step();
      loop.disturb = nullptr;
      loop.Run(0.5);
      EXPECT_EQ(loop.out.fault, cycles == step.harmful ? step.fault : Fault::kNone)
          << step.name << ' ' << cycles;
    }
  }
}

}  // namespace
}  // namespace levitas::test
