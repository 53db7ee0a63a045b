#pragma once
// The commands of `amb-study`, which `amb` knows by name and meaning only.
//
// Why      identification and diagnosis are more than half of what there is to compile; whoever
//          wants to run a rig does not wait for them.
// Found    amb-study lies in the folder of the program that asks.
// Build    the two must come from one build: amb hands over its mark (build_mark.hpp) in the
//          environment, and an amb-study that was linked with other libraries refuses to answer.
// Failure  StartStudy returns only by throwing Problem (kOther): the program is not there or cannot
//          be started.

#include <array>
#include <string_view>

#include "cli/commands/command.hpp"

namespace levitas::cli {

struct StudyCommand {
  const char* name;
  const char* meaning;  ///< the line in the list of commands
};

inline constexpr std::array kStudyCommands{
    StudyCommand{
        "import",
        "Measured data (CSV, MAT), or a candump log of a rig's CAN buses, becomes a session"},
    StudyCommand{"simulate", "Where the model departs from a recorded session"},
    StudyCommand{"effects",
                 "What a rig may do beyond its nominal model: the catalogue, and the signature of "
                 "each effect"},
    StudyCommand{"identify", "A model from a record"},
    StudyCommand{"design",
                 "Controllers from a rig and its uncertainty, judged before they are written"},
    StudyCommand{"balance", "Correction weights of the rotor from a recorded run-up"},
    StudyCommand{"diagnose", "What the model of a rig gets wrong, and why"},
    StudyCommand{"bench", "How good diagnosis, identification and protections are"},
    StudyCommand{"manual",
                 "Every command and option: as a page, as a manual page, as completion for bash"},
};

/// Null when `name` is no command of amb-study.
[[nodiscard]] const StudyCommand* FindStudyCommand(std::string_view name);

/// The subcommand of that name, with its meaning, to be given options. `name` is in the list.
[[nodiscard]] CLI::App* AddStudyCommand(CLI::App& app, std::string_view name);

/// The variable of the environment with the mark of the amb that started amb-study.
inline constexpr const char* kStartedBy = "LEVITAS_STARTED_BY_BUILD";

/// Puts amb-study in the place of this process; `mark` is that of this program.
[[noreturn]] void StartStudy(char** argv, const char* mark);

/// Throws Problem (kOther) when an amb of another mark than `mark` started this program.
void RefuseOtherBuild(const char* mark);

}  // namespace levitas::cli
