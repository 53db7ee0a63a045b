#pragma once
// amb report: a recorded session as one HTML page with pictures.

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddReportCommand(CLI::App& app, Action& action);

}  // namespace levitas::cli
