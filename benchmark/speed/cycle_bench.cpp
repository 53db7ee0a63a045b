// The controller's computation: whole cycle, law alone, and the same filters by hand in plain C.
// Compare rows of one run only. `cycles` feeds recorded-like inputs (levitated, noise), so that
// branches are as predictable as in use, not more.

#include <benchmark/benchmark.h>

#include <array>
#include <vector>

#include "benchmark/speed/straight_line_law.h"
#include "common/random.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "controller/law/axis_law.hpp"
#include "tests/unit/cycle/cycle_rig.hpp"

namespace levitas {
namespace {

constexpr std::size_t kInputs = 1024;

// Errors of a levitated rotor: 1 um of noise.
std::vector<AxisArray> Errors(double deviation_m = 1e-6) {
  Random random(1);
  std::vector<AxisArray> errors(kInputs);
  for (AxisArray& error_m : errors) {
    for (std::size_t i = 0; i < 4; ++i) error_m[i] = deviation_m * random.Normal();
  }
  return errors;
}

// Takes the law's own coefficients over, so that both run the very same numbers.
straight_line_law ByHand(const law::LawCoefficients& c) {
  straight_line_law hand{};
  for (std::size_t i = 0; i < 4; ++i) {
    hand.lead_b0[i] = c.lead_lags()[0].b0.at[i];
    hand.lead_b1[i] = c.lead_lags()[0].b1.at[i];
    hand.lead_a1[i] = c.lead_lags()[0].a1.at[i];
    for (std::size_t k = 0; k < 2; ++k) {
      hand.notch_b0[k][i] = c.notches()[k].b0.at[i];
      hand.notch_b1[k][i] = c.notches()[k].b1.at[i];
      hand.notch_b2[k][i] = c.notches()[k].b2.at[i];
      hand.notch_a1[k][i] = c.notches()[k].a1.at[i];
      hand.notch_a2[k][i] = c.notches()[k].a2.at[i];
    }
    hand.direct[i] = c.pid().direct.at[i];
    hand.integral_gain[i] = c.pid().integral.at[i];
    hand.derivative_gain[i] = c.pid().derivative.at[i];
    hand.derivative_pole[i] = c.pid().pole.at[i];
  }
  hand.limit = 1.0;
  return hand;
}

void StraightLineC(benchmark::State& state) {
  const law::LawCoefficients coefficients(law::FlexibleRotorLaw());
  straight_line_law hand = ByHand(coefficients);
  const std::vector<AxisArray> errors = Errors();
  const AxisArray excitation_a{};
  AxisArray current_a{};
  std::size_t n = 0;
  for (auto _ : state) {
    straight_line_step(&hand, errors[n].data(), excitation_a.data(), current_a.data());
    benchmark::DoNotOptimize(current_a);
    n = (n + 1) % kInputs;
  }
}
BENCHMARK(StraightLineC);

// Blocks of two states, each fed by all axes and feeding all.
law::LawConfig LawOfStates(std::size_t states) {
  law::LawConfig config;
  config.period_s = 1e-4;
  config.current_limit_a = 1.0;
  law::StateSpaceConfig modal;
  modal.axes = 4;
  modal.discrete = true;
  for (std::size_t i = 0; i < states / 2; ++i) {
    law::ModalBlock block;
    block.pole_real = 0.4 + 0.01 * static_cast<double>(i);
    block.pole_imaginary = 0.3;
    block.first_input.fill(1.0);
    block.second_input.fill(0.5);
    block.first_output.fill(100.0);
    block.second_output.fill(-50.0);
    modal.blocks.push_back(block);
  }
  modal.input_v_per_m.fill(1.0);
  modal.output_a_per_v.fill(1.0);
  config.state_space = modal;
  return config;
}

// A law whose states are no longer normal numbers (below 2.2e-308): where a filter's memory decays
// to when its input is exactly zero. Every product is then the processor's slow case.
constexpr double kSubnormalM = 1e-315;

void StepLaw(benchmark::State& state, const law::LawConfig& config, double deviation_m) {
  const law::LawCoefficients coefficients(config);
  law::LawState memory(coefficients);
  const std::vector<AxisArray> errors = Errors(deviation_m);
  const AxisArray excitation_a{};
  std::size_t n = 0;
  for (auto _ : state) {
    law::LawOutput out = law::Step(coefficients, memory, errors[n], excitation_a, 1.0);
    benchmark::DoNotOptimize(out);
    n = (n + 1) % kInputs;
  }
}

void AxisLaw(benchmark::State& state) { StepLaw(state, law::FlexibleRotorLaw(), 1e-6); }
BENCHMARK(AxisLaw);

void AxisLawOfSubnormals(benchmark::State& state) {
  StepLaw(state, law::FlexibleRotorLaw(), kSubnormalM);
}
BENCHMARK(AxisLawOfSubnormals);

constexpr std::size_t kMost = law::StateSpaceConfig::kMaxStates;
constexpr std::size_t kUsual = 68;  // as D-K iteration leaves them

void StateSpaceLaw(benchmark::State& state) { StepLaw(state, LawOfStates(kMost), 1e-6); }
BENCHMARK(StateSpaceLaw);

void StateSpaceLaw68(benchmark::State& state) { StepLaw(state, LawOfStates(kUsual), 1e-6); }
BENCHMARK(StateSpaceLaw68);

void StraightLineStateSpace68(benchmark::State& state) {
  static_assert(kUsual == 2 * STRAIGHT_PAIRS);
  const law::StateSpaceConfig law = *LawOfStates(kUsual).state_space;
  straight_line_modal hand{};
  hand.limit = 1.0;
  for (std::size_t i = 0; i < 4; ++i) hand.input_gain[i] = hand.output_gain[i] = 1.0;
  for (std::size_t k = 0; k < law.blocks.size(); ++k) {
    hand.real[k] = law.blocks[k].pole_real;
    hand.imaginary[k] = law.blocks[k].pole_imaginary;
    for (std::size_t i = 0; i < 4; ++i) {
      hand.input1[i][k] = law.blocks[k].first_input[i];
      hand.input2[i][k] = law.blocks[k].second_input[i];
      hand.output1[i][k] = law.blocks[k].first_output[i];
      hand.output2[i][k] = law.blocks[k].second_output[i];
    }
  }
  const std::vector<AxisArray> errors = Errors(1e-6);
  const AxisArray excitation_a{};
  AxisArray current_a{};
  std::size_t n = 0;
  for (auto _ : state) {
    straight_line_modal_step(&hand, errors[n].data(), excitation_a.data(), current_a.data());
    benchmark::DoNotOptimize(current_a);
    n = (n + 1) % kInputs;
  }
}
BENCHMARK(StraightLineStateSpace68);

void StateSpaceLawOfSubnormals(benchmark::State& state) {
  StepLaw(state, LawOfStates(kMost), kSubnormalM);
}
BENCHMARK(StateSpaceLawOfSubnormals);

// Check, supervise and law for four axes, spinning.
void WholeCycle(benchmark::State& state) {
  cycle::CycleConfig config = cycle::FlexibleRotorCycle();
  cycle::ControlCycle control(config);
  cycle::StillRig rig;
  (void)cycle::Levitate(control, rig);
  std::vector<cycle::CycleInputs> inputs(kInputs);
  for (cycle::CycleInputs& in : inputs) in = rig.Next();
  std::uint64_t cycle = inputs.front().cycle;
  std::size_t n = 0;
  for (auto _ : state) {
    inputs[n].cycle = inputs[n].frame.cycle = cycle++;
    cycle::CycleOutputs out = control.Step(inputs[n]);
    benchmark::DoNotOptimize(out);
    n = (n + 1) % kInputs;
  }
  if (control.Step(rig.Next()).mode == Mode::kOff) state.SkipWithError("not levitated");
}
BENCHMARK(WholeCycle);

}  // namespace
}  // namespace levitas
