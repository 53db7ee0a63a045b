#pragma once
// The verdict at the top of a report's page: its sentence, what was objected, and its figures as
// tables; critical speeds as a table.
// Thread   any. Failure: none; text of the session is escaped.

#include <optional>
#include <string>

#include "analysis/critical_speeds.hpp"
#include "verdict/verdict.hpp"

namespace levitas::report {

/// Without a verdict the sentence that nothing was judged.
[[nodiscard]] std::string VerdictSection(const std::optional<verdict::Verdict>& verdict);
/// Empty when nothing was computed.
[[nodiscard]] std::string CriticalSpeedSection(const std::optional<analysis::Campbell>& levitated);

}  // namespace levitas::report
