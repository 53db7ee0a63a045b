#include "benchmark/accuracy/unmodelled_disturbance.hpp"

#include <cmath>
#include <numbers>

namespace levitas::accuracy {
namespace {
constexpr double kTurn = 2.0 * std::numbers::pi;
}

std::string Name(Unmodelled outside) {
  switch (outside) {
    case Unmodelled::kToneForce:
      return "tone_force";
    case Unmodelled::kSubsynchronous:
      return "subsynchronous_whirl";
    case Unmodelled::kTurbulence:
      return "turbulence";
    case Unmodelled::kCrosstalk:
      return "sensor_crosstalk";
    case Unmodelled::kWanderingGain:
      return "wandering_gain";
    case Unmodelled::kNothing:
      break;
  }
  return "nothing";
}

Disturbance::Disturbance(Unmodelled kind, double size, std::size_t axes, double period_s,
                         Random& random)
    : kind_(kind), size_(size), period_s_(period_s), noise_(random.Bits()) {
  axis_ = random.Bits() % axes;
  other_ = (axis_ + axes / 2) % axes;
  // Away from the mains and their harmonics.
  frequency_hz_ = 70.0 + 120.0 * random.Uniform();
  for (const double line : {100.0, 120.0, 150.0, 180.0}) {
    if (std::abs(frequency_hz_ - line) < 4.0) frequency_hz_ += 8.0;
  }
  order_ = 0.42 + 0.06 * random.Uniform();
}

void Disturbance::Read(double time_s, AxisArray& reading_m) {
  switch (kind_) {
    case Unmodelled::kCrosstalk:
      reading_m[axis_] += 0.08 * size_ * reading_m[other_];
      break;
    case Unmodelled::kWanderingGain:
      reading_m[axis_] *= 1.0 + 0.25 * size_ * std::sin(kTurn * 1.7 * time_s);
      break;
    case Unmodelled::kNothing:
    case Unmodelled::kToneForce:  // forces: Current()
    case Unmodelled::kSubsynchronous:
    case Unmodelled::kTurbulence:
      break;
  }
}

AxisArray Disturbance::Current(double time_s, double angle_rad, double speed_rad_per_s) {
  AxisArray current_a{};
  switch (kind_) {
    case Unmodelled::kToneForce:
      current_a[axis_] = 0.03 * size_ * std::sin(kTurn * frequency_hz_ * time_s);
      break;
    case Unmodelled::kSubsynchronous: {
      turned_rad_ += std::remainder(angle_rad - angle_rad_, kTurn);
      angle_rad_ = angle_rad;
      if (!(speed_rad_per_s > 0.0)) break;
      const std::size_t x = axis_ - axis_ % 2;
      current_a[x] = 0.03 * size_ * std::cos(order_ * turned_rad_);
      current_a[x + 1] = 0.03 * size_ * std::sin(order_ * turned_rad_);
      break;
    }
    case Unmodelled::kTurbulence: {
      // White noise through a resonance of 10 % damping.
      const double w = kTurn * frequency_hz_;
      resonance_rate_ +=
          period_s_ * (noise_.Normal() - w * w * resonance_ - 0.2 * w * resonance_rate_);
      resonance_ += period_s_ * resonance_rate_;
      // Variance of the resonance driven by white noise of this step: T/(4 z w^3), z = 0.1.
      current_a[axis_] = 0.03 * size_ * resonance_ / std::sqrt(period_s_ / (0.4 * w * w * w));
      break;
    }
    case Unmodelled::kNothing:
    case Unmodelled::kCrosstalk:  // readings: Read()
    case Unmodelled::kWanderingGain:
      break;
  }
  return current_a;
}

}  // namespace levitas::accuracy
