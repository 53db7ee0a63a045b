#pragma once
// Says before a run that its loop is unstable: what the poles know, no rotor has to show.
//
// Loop      of rig file and controller, delay included (analysis/poles.hpp), at rest and at the
//           fastest speed of the scenario.
// Said      the pole that grows fastest, how fast, and the commands that help. The run goes on: the
//           linear loop is a model, and protections stand behind it.
// Cost      some 10 ms for each speed. Thread: any.
// Failure   none: a rig without a linear loop of its own (coils on a voltage) is not judged.

#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::cli {

/// Empty where the loop is stable at all of these speeds or cannot be judged. `rig_name` and
/// `controller_name` are as a command takes them.
[[nodiscard]] std::string UnstableLoop(const configuration::RigFile& rig, const law::LawConfig& law,
                                       const std::vector<double>& speeds_rad_per_s,
                                       const std::string& rig_name,
                                       const std::string& controller_name);

/// Why the blocks of synchronous control must not run with this rig; analysis/synchronous_loop.hpp:
/// unlike the loop itself they are never tried, nor is what cannot be judged. Empty where all are
/// stable, or there are none. Costs some 10 ms for each of 25 speeds of a block.
[[nodiscard]] std::string UnstableBlocksOf(const configuration::RigFile& rig,
                                           const configuration::ControllerFile& controller);

/// Standstill, and the fastest speed that the scenario asks for where it spins at all.
[[nodiscard]] std::vector<double> ScenarioSpeeds(const scenario::ScenarioConfig& scenario);

}  // namespace levitas::cli
