#pragma once
// The rig of a run that differs from its file: in the bias current, in effects added to it.
//
// Equation  the magnets keep their force constant k, so that ki = 4 k i0 / s0^2 grows with the bias
//           current i0 and ks = 4 k i0^2 / s0^3 with its square.
// Effects   entries as in the list `effects` of a rig file, one a text, in braces or without; they
//           come after those of the file.
// Both programs of the run read the text made here, and the session's header holds it.
// Failure   BadInput of the strict reader: the changed rig is read as any file is, so that its
//           limits are those of every rig file. It names the option and the entry.
// Thread    any.

#include <optional>
#include <string>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::cli {

struct RigChanges {
  std::optional<double> bias_current_a{};  ///< none: that of the file
  std::vector<std::string> effects{};
  [[nodiscard]] bool any() const { return bias_current_a || !effects.empty(); }
};

struct RigAsRun {
  configuration::RigFile rig;
  std::string text;  ///< complete, every default written out
};

/// Without changes: the file as it is.
[[nodiscard]] RigAsRun ReadRigAsRun(const std::string& path, const RigChanges& changes);

}  // namespace levitas::cli
