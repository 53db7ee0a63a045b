#pragma once
// Readings, commands and excitation of the closed loop of a standing rotor, cut out of a recorded
// run (session/exchange/recording.hpp) as the matrices that the fit needs.
//
// Rows     from the first excited one on, consecutive, up to the first that is missing or not
//          levitated.
// Frame    bearing frame.
// Thread   any.
// Failure  BadInput: not a recorded run of this rig, no excitation in it, a rotor that turns, too
//          few rows.

#include <string>

#include "configuration/rig_file.hpp"
#include "identification/nonlinear/known_loop.hpp"

namespace levitas::identification {

struct LoopRecord {
  Series series;  ///< commanded currents in, readings out
  LoopExcitation excitation;
};

[[nodiscard]] LoopRecord ReadLoopRecord(const std::string& path, const configuration::RigFile& rig);

}  // namespace levitas::identification
