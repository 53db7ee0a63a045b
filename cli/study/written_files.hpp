#pragma once
// Tells at the end of a command which files it has written.

#include <string>
#include <vector>

namespace levitas::cli {

/// "wrote a, b"; names that are empty were not asked for. Nothing when none is left.
void TellWritten(const std::vector<std::string>& paths);

}  // namespace levitas::cli
