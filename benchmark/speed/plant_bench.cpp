// Cost of one sampling period of the plant, and how many times faster than real time that is.

#include <benchmark/benchmark.h>

#include "common/rotational_speed.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"
#include "tests/support/test_rigs.hpp"

namespace levitas::plant {
namespace {

void ReportRatio(benchmark::State& state, const PlantConfig& config) {
  state.counters["x_real_time"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(config.period_ns) * 1e-9,
      benchmark::Counter::kIsRate);
}

// Levitated by a stiff spring-damper of bearing coordinates (the cheapest stable law), so that
// what is timed is the plant in normal use: all magnets, never in contact.
void Run(benchmark::State& state, const PlantConfig& config, double speed_rpm) {
  Plant plant(config, 1);
  plant.SetSpeed(RpmToRadPerS(speed_rpm), 0.0);
  PlantCommand command;
  command.bias_current_a = 1.0;
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = plant.speed_rad_per_s();
  AxisArray last_m{};
  for (auto _ : state) {
    const SensorFrame frame = plant.Sample();
    for (std::size_t a = 0; a < 4; ++a) {
      const double y_m = frame.position_m[a];
      command.control_current_a[a] = -4000.0 * y_m - 3.0 * (y_m - last_m[a]) * 1e4;
      last_m[a] = y_m;
    }
    plant.Advance(command);
  }
  if (!plant.finite()) state.SkipWithError("the rotor was not levitated");
  ReportRatio(state, config);
}

void Standing(benchmark::State& state) { Run(state, test::FlexibleRotor(), 0.0); }
void Spinning(benchmark::State& state) { Run(state, test::FlexibleRotor(), 3000.0); }
void SpinningHalfSampleDelay(benchmark::State& state) {
  auto config = test::FlexibleRotor();
  config.delay_samples = 0.5;
  Run(state, config, 3000.0);
}
BENCHMARK(Standing);
BENCHMARK(Spinning);
BENCHMARK(SpinningHalfSampleDelay);

void LyingInTouchdown(benchmark::State& state) {
  Plant plant(test::FlexibleRotor(), 1);
  plant.RestInTouchdown();
  PlantCommand command;
  command.amplifiers_enabled = false;
  for (auto _ : state) {
    benchmark::DoNotOptimize(plant.Sample());
    plant.Advance(command);
  }
  ReportRatio(state, test::FlexibleRotor());
}
BENCHMARK(LyingInTouchdown);

void CopyPlant(benchmark::State& state) {
  const Plant original(test::FlexibleRotor(), 1);
  for (auto _ : state) {
    Plant copy(original);
    benchmark::DoNotOptimize(copy);
  }
}
BENCHMARK(CopyPlant);

void RebuildModelAfterAParameter(benchmark::State& state) {
  const PlantModel model(test::FlexibleRotor());
  for (auto _ : state) {
    PlantModel changed(model.parameters());
    benchmark::DoNotOptimize(changed);
  }
}
BENCHMARK(RebuildModelAfterAParameter)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace levitas::plant
