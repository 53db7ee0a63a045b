#include "session/replay/what_if.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "common/problem.hpp"
#include "controller/cycle/law_alone.hpp"
#include "session/replay/replay.hpp"

namespace levitas::session {
namespace {

// The slowest filter of a usable law settles well within this; its integrator need not.
constexpr double kFillTimeS = 0.1;

/// The other controller: whole, or its law alone for imported data.
class Other {
 public:
  Other(const cycle::CycleConfig& config, bool law_only) {
    if (law_only) {
      law_.emplace(config);
    } else {
      control_.emplace(config);
    }
  }
  cycle::CycleOutputs Step(const cycle::CycleInputs& in) noexcept {
    return law_ ? law_->Step(in) : control_->Step(in);
  }

 private:
  std::optional<cycle::LawAlone> law_;
  std::optional<cycle::ControlCycle> control_;
};

/// Sums over the compared cycles of one channel.
struct Sums {
  double recorded_squares{};
  double sum{};
  double squares{};
  double max{};
  std::uint64_t max_cycle{};

  void Add(double recorded, double other, std::uint64_t cycle) noexcept {
    const double difference = other - recorded;
    recorded_squares += recorded * recorded;
    sum += difference;
    squares += difference * difference;
    if (std::abs(difference) > max) {
      max = std::abs(difference);
      max_cycle = cycle;
    }
  }
};

std::vector<ChannelDifference> Statistics(const std::vector<Sums>& sums,
                                          const SessionHeader& header, std::uint64_t compared,
                                          std::uint64_t first_cycle) {
  std::vector<ChannelDifference> channels;
  const double count = static_cast<double>(compared > 0 ? compared : 1);
  for (std::size_t axis = 0; axis < sums.size(); ++axis) {
    const double cycles = static_cast<double>(sums[axis].max_cycle - first_cycle);
    channels.push_back({.channel = header.channels[axis],
                        .recorded_rms_a = std::sqrt(sums[axis].recorded_squares / count),
                        .mean_a = sums[axis].sum / count,
                        .rms_a = std::sqrt(sums[axis].squares / count),
                        .max_a = sums[axis].max,
                        .max_time_s = sums[axis].max_cycle == 0
                                          ? 0.0
                                          : cycles * static_cast<double>(header.period_ns) * 1e-9});
  }
  return channels;
}

}  // namespace

WhatIfReport WhatIf(SessionReader& reader, const cycle::CycleConfig& config,
                    const std::string& session_path, const WhatIfSink& sink) {
  const bool imported = reader.header().controller_yaml.empty();
  Other controller(config, imported);
  const auto fill_cycles =
      static_cast<std::uint64_t>(kFillTimeS * 1e9 / static_cast<double>(reader.header().period_ns));
  WhatIfReport report;
  std::vector<Sums> sums(reader.header().channels.size());
  cycle::CycleRecord record;
  std::uint64_t first_cycle = 0;
  while (reader.Next(record)) {
    if (report.cycles == 0) {
      if (!imported) RefuseUnlessWhole(reader.header(), record, session_path);
      first_cycle = record.in.cycle;
    }
    ++report.cycles;
    const cycle::CycleOutputs other = controller.Step(record.in);
    if (other.fault != Fault::kNone && report.fault == Fault::kNone) {
      report.fault = other.fault;
      report.fault_cycle = record.in.cycle;
    }
    const bool comparable =
        record.out.current.amplifiers_enabled && other.current.amplifiers_enabled;
    if (!comparable || (imported && report.cycles <= fill_cycles)) continue;
    if (report.compared == 0) report.first_compared_cycle = record.in.cycle;
    ++report.compared;
    if (!imported && other.mode != record.out.mode) ++report.mode_differs;
    for (std::size_t axis = 0; axis < sums.size(); ++axis) {
      sums[axis].Add(record.out.current.control_current_a[axis],
                     other.current.control_current_a[axis], record.in.cycle);
    }
    if (sink) sink(record, other);
  }
  if (report.cycles == 0) {
    throw BadInput(fmt::format("{}: holds no cycle, nothing to compare", session_path));
  }
  report.channels = Statistics(sums, reader.header(), report.compared, first_cycle);
  return report;
}

}  // namespace levitas::session
