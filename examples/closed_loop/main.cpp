// The shipped rotor, lifted and held by the shipped controller: one program, nothing between them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "configuration/rig_file.hpp"
#include "controller/cycle/control_cycle.hpp"
#include "plant_sim/plant/command_of.hpp"
#include "plant_sim/plant/plant.hpp"

using namespace levitas;

int main() try {
  const auto rig = configuration::LoadRig(configuration::FindConfig("flexible_rotor", "rigs"));
  const auto controller = configuration::LoadController(
      configuration::FindConfig("flexible_rotor_commissioned", "controllers"), rig.numbers);
  plant::Plant plant(rig.plant, /*seed=*/1);
  plant.RestInTouchdown();
  cycle::ControlCycle control({rig.numbers, controller.law, controller.supervisor});

  cycle::CycleInputs in{.cycle = 1, .frame_present = true};
  in.op.command = OperatorCommand::kLift;
  for (double largest_m = 0.0; in.cycle <= 20'000; ++in.cycle) {  // 2 s in periods of 100 us
    in.frame = plant.Sample();
    const cycle::CycleOutputs out = control.Step(in);
    plant.Advance(plant::CommandOf(out.current));
    in.op.command = OperatorCommand::kNone;
    largest_m = std::max(largest_m, std::hypot(in.frame.position_m[0], in.frame.position_m[1]));
    if (in.cycle % 2'000 != 0) continue;
    std::printf("%.1f s  %-10s  orbit %5.1f um\n",
                static_cast<double>(in.cycle) * rig.numbers.period_s(), Name(out.mode).data(),
                largest_m * 1e6);
    largest_m = 0.0;
  }
} catch (const std::exception& problem) {
  std::fprintf(stderr, "%s\n", problem.what());
  return 1;
}
