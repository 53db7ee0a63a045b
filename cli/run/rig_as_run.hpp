#pragma once
// The rig of a run that differs from its file in the bias current.
//
// Equation  the magnets keep their force constant k, so that ki = 4 k i0 / s0^2 grows with the bias
//           current i0 and ks = 4 k i0^2 / s0^3 with its square.
// Both programs of the run read the text made here, and the session's header holds it.
// Failure   BadInput of the strict reader: the changed rig is read as any file is, so that its
//           limits are those of every rig file.
// Thread    any.

#include <optional>
#include <string>

#include "configuration/rig_file.hpp"

namespace levitas::cli {

struct RigAsRun {
  config::RigFile rig;
  std::string text;  ///< complete, every default written out
};

/// `bias_current_a` in place of that of the file; none: the file as it is.
[[nodiscard]] RigAsRun ReadRigAsRun(const std::string& path, std::optional<double> bias_current_a);

}  // namespace levitas::cli
