// Cost of one sampling period of every shipped rig, and how many times faster than real time that
// is.
//
// What is timed is Sample and Advance of the plant as it runs levitated at its rated speed: noise
// and converters, all magnets with their true force, gyroscopics, no contact. No law is in the
// loop: a rotor without weight and unbalance stays in the centre by itself, exactly, at the same
// arithmetic.

#include <benchmark/benchmark.h>

#include <filesystem>

#include "configuration/rig_file.hpp"
#include "plant_sim/plant/plant.hpp"
#include "plant_sim/plant/plant_model.hpp"

namespace levitas::bench {
namespace {

struct Subject {
  std::string name;
  plant::PlantConfig config;
  double speed_rad_per_s{};
};

void RunPeriods(benchmark::State& state, const Subject& subject) {
  plant::Plant plant(subject.config, 1);
  plant.SetSpeed(subject.speed_rad_per_s, 0.0);
  plant::PlantCommand command;
  for (const auto& bearing : subject.config.bearings) {
    command.bias_current_a = bearing.magnet.bias_current_a;
  }
  command.drive_enabled = true;
  command.speed_set_point_rad_per_s = subject.speed_rad_per_s;
  for (auto _ : state) {
    benchmark::DoNotOptimize(plant.Sample());
    plant.Advance(command);
  }
  if (!plant.finite() || plant.ContactForce() > 0.0) state.SkipWithError("it did not stay put");
  state.counters["degrees_of_freedom"] =
      static_cast<double>(2 * plant.layout().modes + plant.layout().twists);
  state.counters["x_real_time"] =
      benchmark::Counter(static_cast<double>(state.iterations()) *
                             static_cast<double>(subject.config.period_ns) * 1e-9,
                         benchmark::Counter::kIsRate);
}

Subject Balanced(const std::string& rig_name) {
  configuration::RigFile rig = configuration::LoadRig(configuration::FindConfig(rig_name, "rigs"));
  rig.plant.gravity_m_per_s2 = 0.0;
  for (auto& mass : rig.plant.unbalance) mass.moment_kg_m = 0.0;
  for (auto& bearing : rig.plant.bearings) {  // a ball half way between its magnets
    if (bearing.magnet.exponential) bearing.magnet.exponential->far_gap_m = bearing.magnet.gap_m;
  }
  return {rig_name, rig.plant, rig.numbers.max_speed_rad_per_s};
}

void Register(const Subject& subject) {
  benchmark::RegisterBenchmark(("Rig/" + subject.name).c_str(),
                               [subject](benchmark::State& state) { RunPeriods(state, subject); });
}

/// Every rig of the folder, and the largest of them once more with all its degrees of freedom.
const bool kRegistered = [] {
  const std::filesystem::path one = configuration::FindConfig("flexible_rotor", "rigs");
  for (const auto& entry : std::filesystem::directory_iterator(one.parent_path())) {
    if (entry.path().extension() == ".yaml") Register(Balanced(entry.path().stem()));
  }
  Subject whole = Balanced("ufu_rig");
  whole.name += "_not_reduced";
  whole.config.rotor.modes_per_plane = 0;
  Register(whole);
  whole.name += "_one_substep";
  whole.config.substeps = 1;
  Register(whole);
  return true;
}();

}  // namespace
}  // namespace levitas::bench
