#pragma once
// The rig that a session was recorded with, as its header holds it.
//
// Text     complete, every default written out (configuration::WriteRig); for an import the rig
//          that was named to `amb import`.
// Thread   any.
// Failure  BadInput naming the file when the header's rig cannot be read, as that of a newer one.
//          A file that is no session, or none that can be read, holds no rig: who loads it says
//          what is wrong with it.

#include <optional>
#include <string>

#include "configuration/rig_file.hpp"

namespace levitas::session {

[[nodiscard]] std::optional<configuration::RigFile> RigOfSession(const std::string& path);

}  // namespace levitas::session
