#pragma once
// The shipped rig with a block of synchronous control, and what turns in its signals.
//
// Units SI; bearing frame.

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "common/rotational_speed.hpp"
#include "design/notch/notch_design.hpp"
#include "tests/loop/levitation/closed_loop.hpp"

namespace levitas::test {

inline design::NotchRequest Asked(synchronous::Target target, double from_rpm, double to_rpm,
                                  double time_constant_s = 0.3, double order = 1.0) {
  design::NotchRequest request;
  request.block.name = "unbalance";
  request.block.order = order;
  request.block.target = target;
  request.block.time_constant_s = time_constant_s;
  request.block.from_rad_per_s = RpmToRadPerS(from_rpm);
  request.block.to_rad_per_s = RpmToRadPerS(to_rpm);
  request.block.hysteresis_rad_per_s = RpmToRadPerS(30.0);
  request.block.largest_current_a = 0.8;
  return request;
}

/// The commissioned cycle with this block, its T from the rig's file.
inline cycle::CycleConfig WithBlock(const design::NotchRequest& request) {
  cycle::CycleConfig config = CommissionedCycle();
  config.synchronous.blocks.push_back(design::WithInverse(ShippedRig(), config.law, request));
  return config;
}

/// T = 1 at every speed: the notch filter of textbooks.
inline synchronous::BlockConfig PlainNotch(double from_rpm, double to_rpm) {
  synchronous::BlockConfig block = Asked(synchronous::Target::kCurrent, from_rpm, to_rpm).block;
  synchronous::InverseAtSpeed at;
  at.speed_rad_per_s = block.from_rad_per_s;
  for (std::size_t i = 0; i < ShippedRig().numbers.axes(); ++i) at.inverse.real[i][i] = 1.0;
  block.inverse.push_back(at);
  return block;
}

/// Nobody watches the orbit, so that what a block does to it is seen.
inline cycle::CycleConfig Unwatched(cycle::CycleConfig config) {
  config.synchronous.orbit_growth = 1000.0;
  config.supervisor.protection.orbit_fraction = 100.0;
  return config;
}

/// Lifted and turning for so long; false where it cannot be lifted.
[[nodiscard]] inline bool TurnsAt(ClosedLoop& loop, double rpm, double seconds) {
  if (!loop.Levitate()) return false;
  loop.SpinAt(rpm);
  loop.Run(seconds);
  return true;
}

/// Lifted, and within a minute at this speed in contact.
[[nodiscard]] inline bool TouchesAt(ClosedLoop& loop, double rpm) {
  if (!loop.Levitate()) return false;
  loop.SpinAt(rpm);
  return loop.RunUntil(60.0, [&loop] { return loop.most.contact_n > 0.0; });
}

inline double Decibel(double now, double before) { return 20.0 * std::log10(now / before); }

/// Amplitude of order `order` of currents and of positions over whole turns, largest axis.
struct Turning {
  double current_a{};
  double position_m{};
};

inline Turning Measure(ClosedLoop& loop, int turns, double order = 1.0) {
  const std::size_t axes = ShippedRig().numbers.axes();
  std::vector<std::complex<double>> current(axes), position(axes);
  double samples = 0.0;
  const double start_rad = loop.plant.angle_rad();
  double turned_rad = 0.0, last_rad = start_rad;
  constexpr double kMost = 200'000.0;  // a rotor that stands would turn for ever
  while (turned_rad < 2.0 * std::numbers::pi * turns && samples < kMost) {
    const double angle_rad = start_rad + turned_rad;  // no wrap: orders need not be whole
    const AxisArray seen_m = loop.plant.SensorOutput();
    (void)loop.Step();
    const auto phasor = std::polar(1.0, -order * angle_rad);
    for (std::size_t i = 0; i < axes; ++i) {
      current[i] += loop.out.current.control_current_a[i] * phasor;
      position[i] += seen_m[i] * phasor;
    }
    samples += 1.0;
    turned_rad += std::remainder(loop.plant.angle_rad() - last_rad, 2.0 * std::numbers::pi);
    last_rad = loop.plant.angle_rad();
  }
  Turning found;
  for (std::size_t i = 0; i < axes; ++i) {
    found.current_a = std::max(found.current_a, 2.0 * std::abs(current[i]) / samples);
    found.position_m = std::max(found.position_m, 2.0 * std::abs(position[i]) / samples);
  }
  return found;
}

}  // namespace levitas::test
