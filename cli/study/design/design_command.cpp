// amb design: controllers from a rig and its uncertainty, and the check that accepts them.

#include <CLI/CLI.hpp>

#include "cli/commands/study_commands.hpp"
#include "cli/study/design/design_commands.hpp"

namespace levitas::cli {

void AddDesignCommand(CLI::App& app, Action& action) {
  CLI::App* design = AddStudyCommand(app, "design");
  design->require_subcommand(1);
  design->footer(
      "  amb design hinf --rig flexible_rotor --out hinf.yaml\n"
      "  amb run --controller hinf.yaml --scenario run_up_6000\n"
      "A law is written as accepted only after a check that shares no line with its synthesis.");
  AddDesignHinf(*design, action);
  AddDesignPid(*design, action);
  AddDesignSchedule(*design, action);
  AddDesignNotch(*design, action);
  AddDesignCheck(*design, action);
  AddDesignUncertainty(*design, action);
  AddDesignCompare(*design, action);
}

}  // namespace levitas::cli
