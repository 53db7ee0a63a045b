#pragma once
// The subcommands of `amb identify`: each adds its options and action (cli/commands/command.hpp).

#include "cli/commands/command.hpp"

namespace levitas::cli {

void AddIdentifyFrf(CLI::App& identify, Action& action);
void AddIdentifyModal(CLI::App& identify, Action& action);
void AddIdentifyHammersteinWiener(CLI::App& identify, Action& action);
/// Two of them: narx and narmax.
void AddIdentifyNarx(CLI::App& identify, Action& action);
void AddIdentifyGreyBox(CLI::App& identify, Action& action);
void AddIdentifyRotorInLoop(CLI::App& identify, Action& action);
void AddIdentifyController(CLI::App& identify, Action& action);
void AddIdentifyCharacteristic(CLI::App& identify, Action& action);

}  // namespace levitas::cli
