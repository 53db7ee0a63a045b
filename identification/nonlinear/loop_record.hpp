#pragma once
// What a session says of the closed loop of a standing rotor while it is excited, on all axes at
// once: readings, commands and what was added to either.
//
// Rows     from the first excited one on, consecutive, up to the first that is missing or not
//          levitated.
// Frame    bearing frame: probe and amplifier polarity of the rig file are undone.
// Thread   any.
// Failure  BadInput: not a session of this rig, no excitation in it, a rotor that turns, too few
//          rows.

#include <string>

#include "common/rig_numbers.hpp"
#include "identification/nonlinear/known_loop.hpp"

namespace levitas::identification {

struct LoopRecord {
  Series series;  ///< commanded currents in, readings out
  LoopExcitation excitation;
};

[[nodiscard]] LoopRecord ReadLoopRecord(const std::string& path, const RigNumbers& rig);

}  // namespace levitas::identification
