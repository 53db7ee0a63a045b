// amb-plant: the simulated rig over LCM. The rotor starts at rest in the touchdown bearings.

#include "programs/plant/plant_run.hpp"
#include "transport/lcm_rig_link.hpp"

namespace {

using namespace levitas;

// Longer than an answer takes across two cores; see docs/timing.md.
constexpr std::int64_t kSpinNs = 20'000;

constexpr const plant_run::PlantProgram& kProgram = plant_run::kAmbPlant;

ExitStatus Run(const plant_run::PlantOptions& options) {
  const configuration::RigFile rig =
      configuration::LoadRig(configuration::FindConfig(options.rig, "rigs"));
  transport::LcmNetwork network = transport::ParseLcmNetwork(options.port);
  transport::TakeKey(network, options.key, "play the controller");
  transport::LcmRigLink link(network, rig.numbers.axes(), kSpinNs);
  return plant_run::RunPlant({.program = kProgram,
                              .options = options,
                              .rig = rig,
                              .link = link,
                              .where = network.Url(transport::Direction::kCurrent)});
}

}  // namespace

int main(int argc, char** argv) { return plant_run::MainOf(kProgram, argc, argv, Run); }
