#include "programs/controller/report.hpp"

#include <fmt/core.h>

#include "transport/statistics_json.hpp"

namespace levitas::controller_program {

namespace {
using transport::HistogramJson;

nlohmann::ordered_json TimingJson(const loop::LoopStatistics& statistics) {
  nlohmann::ordered_json json{{"wakeup", HistogramJson(statistics.wakeup)},
                              {"compute", HistogramJson(statistics.compute)},
                              {"latency", HistogramJson(statistics.latency)}};
  for (std::size_t at = 1; at < cycle::kStageCount; ++at) {
    const char* name = loop::StageName(static_cast<cycle::Stage>(at));
    json["stage"][name] = HistogramJson(statistics.stage[at]);
    json["blamed"][name] = statistics.blamed[at];
  }
  return json;
}

std::uint64_t Cycles(const scenario::GuardCounts& counts, scenario::Reduced why) {
  return counts.cycles[static_cast<std::size_t>(why)];
}

nlohmann::ordered_json SignalsJson(const scenario::GuardCounts& counts) {
  using scenario::Reduced;
  return {{"cycles_reduced_current_sum", Cycles(counts, Reduced::kCurrentSum)},
          {"cycles_reduced_shift_sum", Cycles(counts, Reduced::kShiftSum)},
          {"cycles_cut_off", Cycles(counts, Reduced::kRadius)},
          {"cycles_beyond_orbit_limit", Cycles(counts, Reduced::kOrbitLimit)},
          {"farthest_share_of_clearance", counts.farthest}};
}

std::string SignalsText(const scenario::GuardCounts& counts) {
  using scenario::Reduced;
  const std::uint64_t sums =
      Cycles(counts, Reduced::kCurrentSum) + Cycles(counts, Reduced::kShiftSum);
  const std::uint64_t off = Cycles(counts, Reduced::kRadius);
  const std::uint64_t orbit = Cycles(counts, Reduced::kOrbitLimit);
  if (sums + off + orbit == 0) return "";
  return fmt::format(
      "test signals reduced             sum too large {}, cut off {}, orbit limit {} cycles\n",
      sums, off, orbit);
}

nlohmann::ordered_json Figures(const can_port::DelayFigures& delay) {
  return {{"count", delay.count},
          {"least_periods", delay.least_periods},
          {"median_periods", delay.median_periods},
          {"p99_periods", delay.p99_periods},
          {"most_periods", delay.most_periods}};
}

std::string DelayText(const DelayWatch& delay) {
  const can_port::DelayFigures arrived = delay.meter().Arrived();
  if (arrived.count == 0) return "";
  const can_port::DelayFigures acting = delay.meter().Acting();
  std::string text = fmt::format(
      "delay of the buses               current there after {:.2f} / {:.2f} / {:.2f} periods "
      "(least, median, most), acts after {:.2f}; taken for margins: {:.2f}\n",
      arrived.least_periods, arrived.median_periods, arrived.most_periods, acting.median_periods,
      delay.expected_periods());
  const std::string objection = DelayObjection(acting, delay.expected_periods());
  return objection.empty() ? text : text + objection + '\n';
}

nlohmann::ordered_json LinesJson(const gpio::LineCounters& lines) {
  return {{"stops", lines.stops},
          {"enables", lines.enables},
          {"write_failures", lines.write_failures},
          {"pulses_good", lines.pulses.good},
          {"pulses_extra", lines.pulses.extra},
          {"pulses_missing", lines.pulses.missing},
          {"pulse_jumps", lines.pulses.jumps}};
}

nlohmann::ordered_json DelayJson(const DelayWatch& delay) {
  const can_port::DelayFigures acting = delay.meter().Acting();
  return {{"expected_periods", delay.expected_periods()},
          {"arrived", Figures(delay.meter().Arrived())},
          {"acting", Figures(acting)},
          {"objection", DelayObjection(acting, delay.expected_periods())}};
}

std::string OverrunsText(const loop::LoopStatistics& statistics) {
  if (statistics.overruns == 0) return "";
  std::string text =
      fmt::format("overruns                         {}, blamed:", statistics.overruns);
  for (std::size_t at = 1; at < cycle::kStageCount; ++at) {
    if (statistics.blamed[at] == 0) continue;
    text += fmt::format(" {} {}", loop::StageName(static_cast<cycle::Stage>(at)),
                        statistics.blamed[at]);
  }
  return text + '\n';
}

std::string EmergencyStopText(const Histogram& stop) {
  if (stop.count() == 0) return "";
  return fmt::format(
      "operator's stop to trip          {:.1f} / {:.1f} / {:.1f} us (p50 / p99 / "
      "longest of {})\n",
      stop.Percentile(0.5) * 1e-3, stop.Percentile(0.99) * 1e-3,
      static_cast<double>(stop.max_ns()) * 1e-3, stop.count());
}

std::string Triple(const Histogram& histogram) {
  return fmt::format("{:.2f} / {:.2f} / {:.2f} us", histogram.Percentile(0.5) * 1e-3,
                     histogram.Percentile(0.99) * 1e-3, histogram.Percentile(0.999) * 1e-3);
}
}  // namespace

nlohmann::ordered_json ReportJson(const RunFacts& facts) {
  nlohmann::ordered_json json{
      {"pace", facts.options.realtime ? "realtime" : "lockstep"},
      {"cycles", facts.statistics.cycles},
      {"wall_s", static_cast<double>(facts.statistics.last_ns - facts.statistics.first_ns) * 1e-9},
      {"skipped_periods", facts.statistics.skipped_periods},
      {"overruns", facts.statistics.overruns},
      {"missing_frames", facts.statistics.missing_frames},
      {"repeated_frames", facts.statistics.repeated_frames},
      {"old_frames", facts.statistics.old_frames},
      {"undated_frames", facts.statistics.undated_frames},
      {"frames_read", facts.port.frames_read},
      {"frames_skipped", facts.port.frames_skipped},
      {"frames_rejected", facts.port.frames_rejected},
      {"frames_refused", facts.port.frames_refused},
      {"currents_written", facts.port.currents_written},
      {"write_failures", facts.port.write_failures},
      {"messages_lost", facts.port.frames_lost},
      {"transport", facts.transport},
      {"records_lost", facts.records_lost},
      {"telemetry_dropped", facts.telemetry_dropped},
      {"commands_rejected", facts.commands.rejected},
      {"commands_old", facts.commands.old},
      {"commands_overtaken", facts.commands.overtaken},
      {"commands_dropped", facts.commands.dropped},
      {"test_signals", SignalsJson(facts.signals_reduced)},
      {"emergency_stop", HistogramJson(facts.statistics.emergency_stop)},
      {"trips", facts.trips},
      {"first_fault", Name(facts.first_fault)},
      {"trip_file", facts.trip_file},
      {"scenario_problem", facts.scenario_problem},
      {"realtime", rt::Text(facts.real_time)}};
  if (facts.lines != nullptr) json["lines"] = LinesJson(*facts.lines);
  if (facts.delay != nullptr) json["delay"] = DelayJson(*facts.delay);
  json["timing"] = TimingJson(facts.statistics);
  return json;
}

std::string ReportText(const RunFacts& facts) {
  const loop::LoopStatistics& statistics = facts.statistics;
  std::string text =
      fmt::format("{} cycles, {} skipped, {} without a frame, {} messages lost, {} records lost\n",
                  statistics.cycles, statistics.skipped_periods, statistics.missing_frames,
                  facts.port.frames_lost, facts.records_lost);
  text += fmt::format("computation (p50 / p99 / p99.9)  {}\n", Triple(statistics.compute));
  if (facts.options.realtime) {
    text += fmt::format("wake-up error                    {}\n", Triple(statistics.wakeup));
    text += fmt::format("sample to current                {}\n", Triple(statistics.latency));
  }
  if (facts.delay != nullptr) text += DelayText(*facts.delay);
  text += OverrunsText(statistics);
  text += EmergencyStopText(statistics.emergency_stop);
  text += SignalsText(facts.signals_reduced);
  if (facts.commands.dropped > 0) {
    text +=
        fmt::format("commands                         {} found no room\n", facts.commands.dropped);
  }
  if (statistics.undated_frames > 0) {
    text +=
        fmt::format("{} frames bore a sampling instant that cannot be: dated by their arrival\n",
                    statistics.undated_frames);
  }
  if (facts.lines != nullptr && facts.lines->write_failures > 0) {
    text += fmt::format("lines: an output could not be written in {} cycles\n",
                        facts.lines->write_failures);
  }
  if (!facts.transport.empty()) text += "transport: " + facts.transport + '\n';
  if (facts.trips > 0) {
    text += fmt::format("tripped: {}{}{}\n", Name(facts.first_fault),
                        facts.trip_file.empty() ? "" : ", recorded in ", facts.trip_file);
  }
  if (!facts.scenario_problem.empty()) text += facts.scenario_problem + '\n';
  return text;
}

}  // namespace levitas::controller_program
