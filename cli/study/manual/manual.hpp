#pragma once
// The command line written down: a page of docs/, a manual page, completion for bash.
//
// Thread   any. Failure: none.

#include <string>

#include "cli/study/manual/command_tree.hpp"

namespace levitas::cli {

/// docs/commands.md.
[[nodiscard]] std::string Markdown(const CommandText& root);

/// amb.1 in the man macros of troff; `version` stands in its foot.
[[nodiscard]] std::string ManPage(const CommandText& root, const std::string& version);

/// For `source <(amb manual --bash)`. Completes commands, options, values where they are few,
/// shipped names behind --rig, --controller, --scenario, and file names everywhere else.
[[nodiscard]] std::string BashCompletion(const CommandText& root);

}  // namespace levitas::cli
