// amb identify: models from records. One source file per method.

#include <CLI/CLI.hpp>

#include "cli/commands/study_commands.hpp"
#include "cli/study/identify/geared_commands.hpp"
#include "cli/study/identify/identify_commands.hpp"
#include "cli/study/identify/live_command.hpp"

namespace levitas::cli {

void AddIdentifyCommand(CLI::App& app, Action& action) {
  CLI::App* identify = AddStudyCommand(app, "identify");
  identify->require_subcommand(1);
  identify->footer(
      "From a levitating but badly known rig to a model worth designing on:\n"
      "  amb run --scenario identify --record campaign.lcm\n"
      "  amb identify frf campaign.lcm --svg frf.svg\n"
      "Measured CSV files are read as sessions are (columns: docs/formats.md).");
  AddIdentifyFrf(*identify, action);
  AddIdentifyModal(*identify, action);
  AddIdentifyFullSpectrum(*identify, action);
  AddIdentifyHammersteinWiener(*identify, action);
  AddIdentifyLive(*identify, action);
  AddIdentifyNarx(*identify, action);
  AddIdentifyGreyBox(*identify, action);
  AddIdentifyRotorInLoop(*identify, action);
  AddIdentifyController(*identify, action);
  AddIdentifyCharacteristic(*identify, action);
}

}  // namespace levitas::cli
