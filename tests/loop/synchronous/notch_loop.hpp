#pragma once
// The shipped rig with a block of synchronous control, and what turns in its signals.
//
// Units SI; bearing frame.

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
