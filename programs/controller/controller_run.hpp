#pragma once
// One run of amb-controller, from the files to the exit status.
//
// Exit status   0 the scenario, the duration or the operator's stop ended with the rotor landed;
//               4 there was a trip, acknowledged or not; 3 a bad file; 1 anything else, such as a
//               rig that is silent or a scenario that could not be finished.
// Threads       main (signals, partner), loop, recorder, telemetry, operator commands.
// Failure       Problem.

#include "common/problem.hpp"
#include "programs/controller/controller_options.hpp"

namespace levitas::controller_program {

[[nodiscard]] ExitStatus Run(const ControllerOptions& options);

}  // namespace levitas::controller_program
