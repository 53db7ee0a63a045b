#include "plant_sim/plant/mode_step.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace levitas::plant {
namespace {

struct Motion {
  double x;
  double v;
};

Motion Apply(const ModeStep& s, Motion m, double n0, double n1) {
  return {s.xx * m.x + s.xv * m.v + s.x0 * n0 + s.x1 * (n1 - n0),
          s.vx * m.x + s.vv * m.v + s.v0 * n0 + s.v1 * (n1 - n0)};
}

// Runge-Kutta of fourth order in 20 000 steps: an independent way to the same numbers.
Motion Integrate(double w, double z, double h, Motion m, double n0, double n1) {
  constexpr int kSteps = 20'000;
  const double d = h / kSteps;
  const auto rate = [&](double t, Motion at) {
    return Motion{at.v, n0 + (n1 - n0) * t / h - w * w * at.x - 2.0 * z * w * at.v};
  };
  for (int i = 0; i < kSteps; ++i) {
    const double t = i * d;
    const Motion a = rate(t, m);
    const Motion b = rate(t + d / 2, {m.x + d / 2 * a.x, m.v + d / 2 * a.v});
    const Motion c = rate(t + d / 2, {m.x + d / 2 * b.x, m.v + d / 2 * b.v});
    const Motion e = rate(t + d, {m.x + d * c.x, m.v + d * c.v});
    m = {m.x + d / 6 * (a.x + 2 * b.x + 2 * c.x + e.x),
         m.v + d / 6 * (a.v + 2 * b.v + 2 * c.v + e.v)};
  }
  return m;
}

TEST(ModeStep, IsExactForAForceThatRunsLinearly) {
  constexpr double kStep_s = 25e-6;
  for (const double w : {0.0, 3.0, 565.0, 19'000.0, 21'000.0, 100'000.0}) {
    for (const double z : {0.0, 0.003, 0.7}) {
      const ModeStep step = MakeModeStep(w, z, kStep_s);
      const Motion start{1e-5, 0.02};
      const Motion got = Apply(step, start, 3.0, -40.0);
      const Motion expected = Integrate(w, z, kStep_s, start, 3.0, -40.0);
      // The rounding of 20 000 steps of the comparison.
      EXPECT_NEAR(got.x, expected.x, 1e-15 + 1e-11 * std::abs(start.x)) << w << " " << z;
      EXPECT_NEAR(got.v, expected.v, 1e-11 * (1.0 + w * start.x)) << w << " " << z;
    }
  }
}

TEST(ModeStep, OfAFreeMassIsUniformAcceleration) {
  const ModeStep step = MakeModeStep(0.0, 0.0, 2.0);
  const Motion got = Apply(step, {1.0, 3.0}, 4.0, 10.0);
  EXPECT_DOUBLE_EQ(got.x, 1.0 + 6.0 + 4.0 * 2.0 + 6.0 * 4.0 / 6.0);  // h^2/2, h^2/6
  EXPECT_DOUBLE_EQ(got.v, 3.0 + 8.0 + 6.0);
}

TEST(ModeStep, KeepsTheEnergyOfAnUndampedModeForEver) {
  const double w = 10'430.0;  // 1660 Hz
  const ModeStep step = MakeModeStep(w, 0.0, 25e-6);
  Motion m{1e-6, 0.0};
  for (int i = 0; i < 1'000'000; ++i) m = Apply(step, m, 0.0, 0.0);
  const double energy = m.v * m.v + w * w * m.x * m.x;
  EXPECT_NEAR(energy / (w * w * 1e-12), 1.0, 1e-9);  // rounding of a million products
}

TEST(ModeStep, TakesOverFromTheSeriesWithoutAStep) {
  const double h = 25e-6;
  const double w = 0.5 / h;  // where the series ends
  const ModeStep below = MakeModeStep(w * (1.0 - 1e-9), 0.01, h);
  const ModeStep above = MakeModeStep(w * (1.0 + 1e-9), 0.01, h);
  EXPECT_NEAR(above.x1 / below.x1, 1.0, 1e-8);  // the change of w itself
  EXPECT_NEAR(above.x0 / below.x0, 1.0, 1e-8);
  EXPECT_NEAR(above.vx / below.vx, 1.0, 1e-8);
}

}  // namespace
}  // namespace levitas::plant
