// amb-controller: see controller_run.hpp.

#include <string>

#include "programs/controller/controller_run.hpp"
#include "rt/limits.hpp"
#include "rt/say.hpp"
#include "rt/stop_signal.hpp"

namespace {

int Main(int argc, char** argv) {
  using namespace levitas;
  try {
    controller_program::ControllerOptions options;
    ExitStatus status = ExitStatus::kDone;
    if (!controller_program::ReadCommandLine(argc, argv, options, status)) {
      return static_cast<int>(status);
    }
    const std::string limited = rt::ReserveCpuTime();
    if (!limited.empty()) rt::Say("amb-controller: " + limited);
    return static_cast<int>(controller_program::Run(options));
  } catch (const Problem& problem) {
    rt::Say(std::string("amb-controller: ") + problem.what());
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    rt::Say(std::string("amb-controller: ") + error.what());
    return static_cast<int>(ExitStatus::kOther);
  }
}

}  // namespace

int main(int argc, char** argv) {
  levitas::rt::OpenStandardFiles();
  if (!levitas::rt::EnsureStack("amb-controller")) {
    return static_cast<int>(levitas::ExitStatus::kOther);
  }
  levitas::rt::CatchStopSignals();
  const int status = Main(argc, argv);
  static_cast<void>(levitas::rt::FlushSaid());
  return status;
}
