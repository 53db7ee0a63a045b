// Cost of synchronous control per cycle and per order, beside the notch alone in straight C.
#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "benchmark/speed/straight_line_notch.h"
#include "controller/synchronous/synchronous_control.hpp"

namespace levitas::synchronous {
namespace {

constexpr double kSpeedRadPerS = 300.0;

RigNumbers FourAxes() {
  RigNumbers rig;
  rig.channels = {"de_x", "de_y", "nde_x", "nde_y"};
  rig.bearings = {"de", "nde"};
  rig.clearance_m = 190e-6;
  return rig;
}

SynchronousConfig Orders(std::size_t count) {
  SynchronousConfig config;
  for (std::size_t k = 0; k < count; ++k) {
    BlockConfig& block = config.blocks.emplace_back();
    block.order = static_cast<double>(k + 1);
    block.from_rad_per_s = 100.0;
    block.to_rad_per_s = 600.0;
    InverseAtSpeed at;
    for (std::size_t to = 0; to < 4; ++to) {
      for (std::size_t from = 0; from < 4; ++from) {
        at.inverse.real[to][from] = to == from ? 1.0 : 0.1;
        at.inverse.imaginary[to][from] = 0.05;
      }
    }
    block.inverse.push_back(at);
  }
  return config;
}

AxisArray Error(double angle_rad) {
  AxisArray error{};
  for (std::size_t i = 0; i < 4; ++i) {
    error[i] = 1e-5 * std::cos(angle_rad + static_cast<double>(i));
  }
  return error;
}

void BM_SynchronousControl(benchmark::State& state) {
  SynchronousControl control(Orders(static_cast<std::size_t>(state.range(0))), FourAxes());
  Conditions seen;
  seen.levitated = true;
  seen.believed_speed_rad_per_s = kSpeedRadPerS;
  double angle_rad = 0.0;
  const AxisArray error = Error(0.3);
  const auto step = [&] {
    angle_rad += kSpeedRadPerS * 1e-4;
    if (angle_rad >= 2.0 * std::numbers::pi) angle_rad -= 2.0 * std::numbers::pi;
    seen.angle = {true, false, angle_rad, kSpeedRadPerS, 1};
    AxisArray read = error;
    AxisArray added{};
    control.Step(seen, read, added);
    benchmark::DoNotOptimize(read);
    benchmark::DoNotOptimize(added);
  };
  constexpr int kUntilItActs = 5000;  // ten good turns come first
  for (int n = 0; n < kUntilItActs; ++n) step();
  for (auto _ : state) step();
  if (state.range(0) > 0 && control.status(0).state != BlockState::kActing) {
    state.SkipWithError("the block does not act: nothing was measured");
  }
}
BENCHMARK(BM_SynchronousControl)->Arg(0)->Arg(1)->Arg(2)->Arg(4)->Arg(8);

void BM_NotchOfOneOrder(benchmark::State& state) {
  const SynchronousConfig config = Orders(1);
  const InverseLadder ladder(config.blocks.front());
  NotchState notch;
  double turns = 0.0;
  const AxisArray error = Error(0.3);
  for (auto _ : state) {
    turns += kSpeedRadPerS * 1e-4 / (2.0 * std::numbers::pi);
    if (turns >= 1.0) turns -= 1.0;
    const UnitPhasor phasor = PhasorOfTurns(turns);
    AxisArray read = error;
    AddTurning(notch.real, notch.imaginary, phasor, -1.0, read);
    Adapt(ladder.At(kSpeedRadPerS), phasor, 1e-3, 4, read, notch);
    benchmark::DoNotOptimize(read);
  }
}
BENCHMARK(BM_NotchOfOneOrder);

void BM_NotchInStraightC(benchmark::State& state) {
  straight_line_notch notch{};
  notch.rate = 1e-3;
  for (int to = 0; to < 4; ++to) {
    for (int from = 0; from < 4; ++from) {
      notch.inverse_real[to][from] = to == from ? 1.0 : 0.1;
      notch.inverse_imaginary[to][from] = 0.05;
    }
  }
  double angle_rad = 0.0;
  const AxisArray error = Error(0.3);
  for (auto _ : state) {
    angle_rad += kSpeedRadPerS * 1e-4;
    if (angle_rad >= 2.0 * std::numbers::pi) angle_rad -= 2.0 * std::numbers::pi;
    AxisArray read = error;
    straight_line_notch_step(&notch, angle_rad, read.data());
    benchmark::DoNotOptimize(read);
  }
}
BENCHMARK(BM_NotchInStraightC);

}  // namespace
}  // namespace levitas::synchronous
