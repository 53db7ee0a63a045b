#pragma once
// The commands under `amb design`, one source file each.

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddDesignHinf(CLI::App& design, Action& action);
void AddDesignPid(CLI::App& design, Action& action);
void AddDesignSchedule(CLI::App& design, Action& action);
void AddDesignNotch(CLI::App& design, Action& action);
void AddDesignCheck(CLI::App& design, Action& action);
void AddDesignUncertainty(CLI::App& design, Action& action);
void AddDesignCompare(CLI::App& design, Action& action);

}  // namespace levitas::cli
