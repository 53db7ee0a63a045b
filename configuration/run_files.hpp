#pragma once
// The controller and the scenario that a rig file names for itself (section run).
//
// Failure  BadInput: no such file, with the key that names it and where it was looked for; of a
//          name that was given, as FindConfig says.
// Thread   any.

#include <string>

#include "configuration/rig_file.hpp"

namespace levitas::configuration {

/// Path of the controller file: the `given` one, else the rig's own, else `otherwise`.
[[nodiscard]] std::string FindController(const RunDefaults& rig, const std::string& given,
                                         const std::string& otherwise);

/// The same of the scenario.
[[nodiscard]] std::string FindScenario(const RunDefaults& rig, const std::string& given,
                                       const std::string& otherwise);

/// Reads what FindController found. A usual controller that nobody named and that does not fit the
/// rig is no file to mend: the rig then names none, and that is what is said.
[[nodiscard]] ControllerFile LoadFound(const std::string& path, const RigFile& rig,
                                       const std::string& given);

}  // namespace levitas::configuration
