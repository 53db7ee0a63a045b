#pragma once
// What amb-controller says of a run: for people at its end, and as JSON.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "common/rig_port.hpp"
#include "controller/loop/loop_statistics.hpp"
#include "controller/scenario/excitation_guard.hpp"
#include "hil/guarded_port/guarded_port.hpp"
#include "programs/controller/controller_options.hpp"
#include "programs/controller/delay_watch.hpp"
#include "rt/real_time.hpp"
#include "transport/operator_receiver.hpp"

namespace levitas::controller_program {

/// Everything that is known when the loop has ended.
struct RunFacts {
  const ControllerOptions& options;
  const loop::LoopStatistics& statistics;
  port::PortCounters port;
  std::string transport;  ///< what went wrong on it
  std::uint64_t records_lost{};
  std::uint64_t telemetry_dropped{};
  transport::OperatorCounts commands;       ///< those that were not taken
  scenario::GuardCounts signals_reduced{};  ///< what was taken from the test signals
  std::uint64_t trips{};
  Fault first_fault{Fault::kNone};
  std::string trip_file;
  std::string scenario_problem;
  const gpio::LineCounters* lines{};  ///< null: no lines in use
  const std::vector<rt::RealTimeFact>& real_time;
  const DelayWatch* delay{};  ///< of the buses; null: not measured
};

[[nodiscard]] nlohmann::ordered_json ReportJson(const RunFacts& facts);
[[nodiscard]] std::string ReportText(const RunFacts& facts);

}  // namespace levitas::controller_program
