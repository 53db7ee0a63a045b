#pragma once
// A controller file that a command writes: read as `amb run` reads it before it is written.
//
// Failure  BadInput with the path, of what a reader refuses (a new block beside an angle that
//          cannot serve it); nothing is written then. Else as WriteTextFile.

#include <string>

#include "configuration/rig_file.hpp"

namespace levitas::cli {

/// `head`: a comment above it, "# ...\n".
void WriteControllerFile(const std::string& path, const std::string& head,
                         const configuration::ControllerFile& controller, const RigNumbers& rig);

}  // namespace levitas::cli
