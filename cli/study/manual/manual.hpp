#pragma once
// The command line written down: a page of docs/, a manual page, completion for bash.
//
// Thread   any. Failure: none.

#include <string>

#include "cli/study/manual/command_tree.hpp"
#include "cli/study/manual/programs.hpp"

namespace levitas::cli {

/// docs/commands.md: the commands of amb, then the programs beside it.
[[nodiscard]] std::string Markdown(const CommandText& root,
                                   const std::vector<ProgramText>& programs);

/// amb.1 in the man macros of troff; `version` stands in its foot.
[[nodiscard]] std::string ManPage(const CommandText& root, const std::string& version);
/// The page of another program.
[[nodiscard]] std::string ManPage(const ProgramText& program, const std::string& version);

/// For `source <(amb manual --bash)`. Completes commands, options, values where they are few,
/// shipped names behind --rig, --controller, --scenario, and file names everywhere else.
[[nodiscard]] std::string BashCompletion(const CommandText& root,
                                         const std::vector<ProgramText>& programs);

}  // namespace levitas::cli
