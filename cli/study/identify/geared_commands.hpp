#pragma once
// Commands for geared rotors and for trials of the identification (cli/commands/command.hpp).

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddIdentifyFullSpectrum(CLI::App& identify, Action& action);
/// Of `amb bench`: identification, full-spectrum and pump.
void AddBenchIdentification(CLI::App& bench, Action& action);
void AddBenchFullSpectrum(CLI::App& bench, Action& action);
void AddBenchPump(CLI::App& bench, Action& action);

}  // namespace levitas::cli
