#include "session/replay/replay.hpp"

#include <fmt/core.h>

#include "common/problem.hpp"
#include "common/standard_arithmetic.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::session {

cycle::CycleConfig RecordedConfig(const SessionHeader& header, const std::string& session_path) {
  if (header.controller_yaml.empty()) {
    throw BadInput(
        fmt::format("{}: holds no controller (it was {}), so there is nothing to "
                    "reproduce. Use --controller FILE to see what that controller would "
                    "have commanded.",
                    session_path, header.pace));
  }
  const auto rig = configuration::ParseRig(header.rig_yaml, session_path + " (its rig)");
  const auto controller = configuration::ParseController(
      header.controller_yaml, session_path + " (its controller)", rig.numbers);
  return {rig.numbers, controller.law, controller.supervisor, controller.synchronous,
          controller.bias};
}

cycle::CycleConfig OtherConfig(const SessionHeader& header, const std::string& session_path,
                               const std::string& controller_path) {
  const auto rig = configuration::ParseRig(header.rig_yaml, session_path + " (its rig)");
  const auto controller = configuration::LoadController(controller_path, rig.numbers);
  return {rig.numbers, controller.law, controller.supervisor, controller.synchronous,
          controller.bias};
}

void RefuseUnlessWhole(const SessionHeader& header, const cycle::CycleRecord& first_record,
                       const std::string& session_path) {
  if (!header.excerpt_of.empty()) {
    throw BadInput(
        fmt::format("{}: was cut out of {} around a trip, so the controller's memory at "
                    "its start is not known. Replay the whole session; this file is for "
                    "looking (amb export, amb replay --publish).",
                    session_path, header.excerpt_of));
  }
  if (first_record.in.cycle != kFirstCycle) {
    throw BadInput(
        fmt::format("{}: its first readable cycle is {}, the run's beginning is lost, so "
                    "the controller's memory there is not known. amb export still reads "
                    "what is there.",
                    session_path, first_record.in.cycle));
  }
}

ReplayReport Replay(SessionReader& reader, const cycle::CycleConfig& config,
                    const std::string& session_path) {
  UseStandardArithmetic();
  cycle::ControlCycle control(config);
  ReplayReport report;
  cycle::CycleRecord record;
  if (!reader.Next(record)) {
    throw BadInput(fmt::format("{}: holds no cycle, nothing to replay", session_path));
  }
  RefuseUnlessWhole(reader.header(), record, session_path);
  std::uint64_t expected = kFirstCycle;
  do {
    if (report.difference) continue;  // read on: the damage of the whole file is reported too
    if (!report.gap_cycle && record.in.cycle != expected) report.gap_cycle = expected;
    if (report.gap_cycle) {
      ++report.behind_gap;
      continue;
    }
    const cycle::CycleOutputs computed = control.Step(record.in);
    report.difference = FirstDifference(record.out, computed, reader.header().channels);
    if (report.difference) {
      report.different_cycle = record.in.cycle;
    } else {
      ++report.reproduced;
    }
    ++expected;
  } while (reader.Next(record));
  return report;
}

}  // namespace levitas::session
