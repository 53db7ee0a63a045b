#pragma once
// One run of a simulated rig, from its options to the exit status, whatever link it is on.
//
// Signals       the first waits while a controller holds the rotor, see rt/stop_signal.hpp.
// Exit status   0 the controller said goodbye, or a signal; 1 no controller came, or real time was
//               required and is refused; 3 a bad file.
// Threads       main (signals, partner, events), loop.
// Failure       Problem.

#include <functional>
#include <string>

#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "plant_sim/loop/plant_loop.hpp"
#include "programs/plant/plant_options.hpp"

namespace levitas::plant_run {

struct PlantSetup {
  const PlantProgram& program;
  const PlantOptions& options;
  const configuration::RigFile& rig;
  port::RigLink& link;
  std::string where;  ///< for people: where the controller should be
  AmplifierGate* gate{nullptr};
  std::int64_t silence_ns{0};
};

[[nodiscard]] ExitStatus RunPlant(const PlantSetup& setup);

/// Calls `run`, prints a Problem as one message, returns what main returns.
int MainOf(const PlantProgram& program, int argc, char** argv,
           const std::function<ExitStatus(const PlantOptions&)>& run);

}  // namespace levitas::plant_run
