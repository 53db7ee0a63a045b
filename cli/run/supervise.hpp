#pragma once
// Runs controller and rig side by side until the controller ends, and says what went wrong if one
// of them dies or hangs. Every wait has a bound but the one for a controller that holds a rotor.
//
// Alone      without a simulated rig (a real one is on the port) the controller alone is run, and
//            what is said of the rig below does not apply.
// End        the controller ends by itself when its scenario is done or has tripped; the rig then
//            follows it, or is asked to.
// Ctrl-C     the first is passed to the controller, which lands the rotor; the second ends both at
//            once: the controller switches the amplifiers off, or is killed after `grace`.
// Blind      without telemetry for `silence_limit`, or when following the run goes wrong (a hook
//            that throws), we see nothing of the rotor, and that is no reason to let go of it: the
//            controller is asked to land it, and from then on followed as a process.
// Death      of one: the other gets `notice` to see it (the controller trips, freezes what came
//            before and closes its record), then it is asked to end, and after `grace` made to.
// Hang       no thread of the controller has run for `hung_limit` after that (process_pulse.hpp):
//            both are asked to end, and after `grace` made to. A controller whose threads run is
//            waited for as long as it takes: how long a landing may take, it knows itself.
// Failure    Problem (exit status 1) only when a program cannot be started; all else is a result.
// Thread     the main thread (see ChildProcess).

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/child_process.hpp"
#include "cli/run/progress.hpp"

namespace levitas::cli {

struct ProgramCall {
  std::string program;  ///< path
  std::vector<std::string> arguments;
  std::string log_file;     ///< takes what it writes
  std::string life_line{};  ///< option that names the child's end of a pipe; empty: it has none
};

struct RunPlan {
  ProgramCall plant;  ///< no program: a rig is there already
  ProgramCall controller;
  std::chrono::milliseconds notice{1'000};
  std::chrono::milliseconds grace{5'000};
  std::chrono::milliseconds silence_limit{15'000};
  std::chrono::milliseconds hung_limit{ChildProcess::kHung};
};

struct RunResult {
  ChildExit controller;
  std::optional<ChildExit> plant;  ///< empty: still running when the controller ended; ended by us;
                                   ///< or none was started
  bool interrupted{};              ///< Ctrl-C was pressed
  std::string trouble;  ///< one message; empty when the controller ended with status 0 or 4
};

struct RunHooks {
  /// Waits for at most the given time for telemetry; nothing when there is none.
  std::function<std::optional<ProgressSample>(std::chrono::milliseconds)> telemetry;
  std::function<void(const ProgressSample&)> progress;
  std::function<void(const std::string&)> say;  ///< a line for people, in between
  std::function<int()> interrupts;              ///< Ctrl-C so far
};

[[nodiscard]] RunResult Supervise(const RunPlan& plan, const RunHooks& hooks);

}  // namespace levitas::cli
