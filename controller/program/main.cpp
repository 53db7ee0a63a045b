// amb-controller: see controller_run.hpp.

#include <fmt/core.h>

#include <cstdio>

#include "controller/program/controller_run.hpp"

int main(int argc, char** argv) {
  using namespace levitas;
  try {
    controller_program::ControllerOptions options;
    ExitStatus status = ExitStatus::kDone;
    if (!controller_program::ReadCommandLine(argc, argv, options, status)) {
      return static_cast<int>(status);
    }
    return static_cast<int>(controller_program::Run(options));
  } catch (const Problem& problem) {
    fmt::print(stderr, "amb-controller: {}\n", problem.what());
    return static_cast<int>(problem.status());
  } catch (const std::exception& error) {
    fmt::print(stderr, "amb-controller: {}\n", error.what());
    return static_cast<int>(ExitStatus::kOther);
  }
}
