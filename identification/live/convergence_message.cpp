#include "identification/live/convergence_message.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace levitas::identification {

std::string ChangedName(const LiveIdentification& live, const ConvergencePoint& point) {
  const std::vector<std::string>& axes = live.rig()->numbers.channels;
  return fmt::format("{} for {}", RegressorName(*live.recursion()->model(), point.regressor, axes),
                     axes[static_cast<std::size_t>(point.output)]);
}

levitas_msg::convergence_t ConvergenceMessage(const LiveIdentification& live,
                                              const ConvergencePoint& point) {
  const OnlineRecursion& recursion = *live.recursion();
  const RowCounts& counts = recursion.counts();
  levitas_msg::convergence_t message{};
  message.cycle = static_cast<std::int64_t>(point.cycle);
  message.start_utc_ns = live.header().start_utc_ns;
  message.rows = static_cast<std::int64_t>(point.rows);
  message.gaps = static_cast<std::int64_t>(counts.gaps);
  message.missing_rows = static_cast<std::int64_t>(counts.missing);
  message.begun_anew = static_cast<std::int32_t>(
      std::min<std::uint64_t>(counts.begun_anew, std::numeric_limits<std::int32_t>::max()));
  message.change = point.change;
  message.tolerance = recursion.model()->options.tolerance;
  message.converged = point.converged ? 1 : 0;
  message.error_rms_m.assign(point.error_rms.begin(), point.error_rms.end());
  message.fit_percent.assign(point.fit_percent.begin(), point.fit_percent.end());
  message.outputs = static_cast<std::int32_t>(message.error_rms_m.size());
  message.changed = ChangedName(live, point);
  return message;
}

}  // namespace levitas::identification
