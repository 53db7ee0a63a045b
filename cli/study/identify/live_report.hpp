#pragma once
// What amb identify live tells: a line a second, the record of convergence, the final table, JSON.
//
// Record   CSV, one line per point; columns: time_s, cycle, rows, largest_change (ratio), then of
//          every axis error_<axis>_m (rms) and fit_<axis>_percent, the coefficients
//          curve2_<axis>_1_per_a, curve3_<axis>_1_per_a2 .. of i + c2 i^2 + c3 i^3 ..; gaps,
//          missing_rows, pauses, begun_anew (counts so far) and converged (0 or 1).
// Appears  under its name when the command ends; until then beside it (common/output_file.hpp),
//          every line at once.
// Thread   one. Failure: that of common/output_file.hpp.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "common/output_file.hpp"
#include "identification/live/live_identification.hpp"

namespace levitas::cli {

class LiveReport {
 public:
  /// An empty path: no record.
  explicit LiveReport(const std::string& record_path);
  ~LiveReport();
  LiveReport(const LiveReport&) = delete;
  LiveReport& operator=(const LiveReport&) = delete;
  LiveReport(LiveReport&&) = delete;
  LiveReport& operator=(LiveReport&&) = delete;

  /// What runs, and what is looked for.
  void TellRun(const identification::LiveIdentification& live) const;
  void Add(const identification::LiveIdentification& live,
           const identification::ConvergencePoint& point);
  /// The final table; the record gets its name.
  void Finish(const identification::LiveIdentification& live, double busy_s);
  [[nodiscard]] nlohmann::ordered_json Json(const identification::LiveIdentification& live,
                                            double busy_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace levitas::cli
