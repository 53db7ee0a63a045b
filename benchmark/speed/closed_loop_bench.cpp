// Plant and controller in one process, without transport: how much faster than real time.
// `x_real_time` is simulated time over processor time.

#include <benchmark/benchmark.h>

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas {
namespace {

void PlantAndController(benchmark::State& state) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const configuration::ControllerFile controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor", "controllers"), rig.numbers);
  plant::Plant plant(rig.plant, 1);
  plant.RestInTouchdown();
  cycle::ControlCycle control({rig.numbers, controller.law, controller.supervisor});
  std::uint64_t cycle = 0;
  Mode mode = Mode::kOff;
  const auto step = [&](OperatorCommand command, double speed_rad_per_s) {
    cycle::CycleInputs in;
    in.cycle = cycle++;
    in.frame_present = true;
    in.frame = plant.Sample();
    in.op.command = command;
    in.op.speed_rad_per_s = speed_rad_per_s;
    in.op.acceleration_rad_per_s2 = 100.0;
    const cycle::CycleOutputs out = control.Step(in);
    mode = out.mode;
    plant.Advance({out.current.control_current_a, out.current.bias_current_a,
                   out.current.amplifiers_enabled, out.current.drive_enabled,
                   out.current.speed_set_point_rad_per_s,
                   out.current.acceleration_limit_rad_per_s2});
  };
  step(OperatorCommand::kLift, 0.0);
  while (mode == Mode::kSelfTest || mode == Mode::kLift) step(OperatorCommand::kNone, 0.0);
  step(OperatorCommand::kSpin, 314.0);  // 3000 rpm
  for (auto _ : state) step(OperatorCommand::kNone, 0.0);
  if (mode != Mode::kSpinning) state.SkipWithError("not spinning");
  state.counters["x_real_time"] =
      benchmark::Counter(rig.numbers.period_s() * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate);
}
BENCHMARK(PlantAndController);

}  // namespace
}  // namespace levitas
