#pragma once
// From a recorded session to its verdict: reads the session, the files it carries in its header and
// the program's report, and computes the sensitivity peaks of the loop that ran.
//
// Thread   any; offline. Failure: BadInput when the session or its header cannot be read.

#include <string>

#include "verdict/verdict.hpp"

namespace levitas::verdict {

/// [s] left out after each lift: the touchdown bearing is left, the integrator still settles.
inline constexpr double kSettleAfterLiftS = 0.5;

struct CommissionOptions {
  std::string session_path;
  std::string controller_report;  ///< path of the controller's --json; may be missing
  std::string plant_report;       ///< path of the rig's --json; may be missing
  Provenance provenance;          ///< paths and port; the rest is taken from the session's header
  std::string incomplete_reason;  ///< see Inputs
};

[[nodiscard]] Verdict Commission(const CommissionOptions& options);

}  // namespace levitas::verdict
