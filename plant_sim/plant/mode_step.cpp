#include "plant_sim/plant/mode_step.hpp"

#include <cmath>

namespace levitas::plant {
namespace {

// For w h <= kSeries the closed form loses digits to cancellation; 18 terms of the power series
// leave less than 1e-16.
constexpr double kSeries = 0.5;

struct Motion {
  double x;
  double v;
};

// Power series of the solution from (x, v) under n = n0 + slope t, (33).
Motion Series(double w, double sigma, double h, Motion start, double n0, double slope) {
  double a = start.x;
  double b = start.v;
  Motion sum{a + b * h, b};
  double power = h;  // h^(k+1)
  for (int k = 0; k < 18; ++k) {
    const double forcing = k == 0 ? n0 : (k == 1 ? slope : 0.0);
    const double next = (forcing - w * w * a - 2.0 * sigma * (k + 1) * b) / ((k + 1) * (k + 2.0));
    sum.v += (k + 2.0) * next * power;
    power *= h;
    sum.x += next * power;
    a = b;
    b = next;
  }
  return sum;
}

}  // namespace

ModeStep MakeModeStep(double w, double damping_ratio, double h) {
  const double sigma = damping_ratio * w;
  if (w * h <= kSeries) {
    const Motion x = Series(w, sigma, h, {1.0, 0.0}, 0.0, 0.0);
    const Motion v = Series(w, sigma, h, {0.0, 1.0}, 0.0, 0.0);
    const Motion constant = Series(w, sigma, h, {0.0, 0.0}, 1.0, 0.0);
    const Motion ramp = Series(w, sigma, h, {0.0, 0.0}, 0.0, 1.0 / h);
    return {x.x, v.x, x.v, v.v, constant.x, constant.v, ramp.x, ramp.v};
  }
  const double damped = w * std::sqrt(1.0 - damping_ratio * damping_ratio);
  const double decay = std::exp(-sigma * h);
  const double g = decay * std::sin(damped * h) / damped;  // impulse response, (30)
  const double e = decay * std::cos(damped * h) + sigma * g;
  ModeStep step;
  step.xx = e;
  step.xv = g;
  step.vx = -w * w * g;
  step.vv = e - 2.0 * sigma * g;
  step.x0 = (1.0 - e) / (w * w);  // (31)
  step.v0 = g;
  step.x1 = (h - g - 2.0 * sigma * step.x0) / (w * w * h);  // (32)
  step.v1 = step.x0 / h;
  return step;
}

}  // namespace levitas::plant
