#pragma once
// Standard deviations of a modal identification, from the JSON that `amb identify modal --json`
// wrote.
//
// Modes    those that the data show, from the first up to the first that they do not.
// Failure  BadInput: no such file, or not what that command writes (the file is named).

#include <string>

#include "design/drawn_rigs/rig_uncertainty.hpp"

namespace levitas::cli {

[[nodiscard]] uncertainty::IdentifiedDeviations ReadIdentifiedDeviations(const std::string& path);

}  // namespace levitas::cli
