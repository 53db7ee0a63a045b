#include "verdict/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "common/problem.hpp"

namespace levitas::verdict {
namespace {

using Json = nlohmann::json;

DurationFigures Duration(const std::string& name, const Json& json) {
  return {name,
          json.at("count").get<std::uint64_t>(),
          json.at("p50_ns").get<double>(),
          json.at("p99_ns").get<double>(),
          json.at("p999_ns").get<double>(),
          json.at("max_ns").get<double>()};
}

/// In the order of the cycle, whatever the order of the file.
constexpr std::array kStages{"wait", "read", "check", "supervise", "law", "write", "record"};

void ReadTiming(const Json& timing, TimingFigures& figures) {
  for (const char* name : {"wakeup", "compute", "latency"}) {
    figures.durations.push_back(Duration(name, timing.at(name)));
  }
  std::uint64_t most = 0;
  for (const char* stage : kStages) {
    figures.durations.push_back(Duration(stage, timing.at("stage").at(stage)));
    const auto blamed = timing.at("blamed").at(stage).get<std::uint64_t>();
    if (blamed <= most) continue;
    most = blamed;
    figures.blamed_stage = stage;
  }
}

/// Reads the file if it is there; what is not understood becomes one message.
template <class Figures>
std::optional<Figures> Read(const std::string& path,
                            const std::function<void(const Json&, Figures&)>& take) {
  std::error_code none;
  if (path.empty() || !std::filesystem::exists(path, none)) return std::nullopt;
  try {
    Figures figures;
    std::ifstream file(path);
    take(Json::parse(file), figures);
    return figures;
  } catch (const Json::parse_error& error) {
    throw BadInput(
        fmt::format("{}: is not a report: empty or cut off; was there room on its disk? ({})", path,
                    error.what()));
  } catch (const Json::exception& error) {
    throw BadInput(
        fmt::format("{}: is not a report of this program's version ({})", path, error.what()));
  }
}

std::optional<DelayFigures> Delay(const Json& json) {
  if (!json.contains("delay")) return std::nullopt;
  const Json& delay = json.at("delay");
  const Json& acting = delay.at("acting");
  return DelayFigures{
      acting.at("count").get<std::uint64_t>(),  delay.at("expected_periods").get<double>(),
      acting.at("least_periods").get<double>(), acting.at("median_periods").get<double>(),
      acting.at("most_periods").get<double>(),  delay.at("objection").get<std::string>()};
}

}  // namespace

std::optional<TimingFigures> ReadControllerReport(const std::string& path, double period_s) {
  return Read<TimingFigures>(path, [period_s](const Json& json, TimingFigures& figures) {
    figures.cycles = json.at("cycles").get<std::uint64_t>();
    figures.wall_s = json.at("wall_s").get<double>();
    if (figures.wall_s > 0.0) {
      figures.cycles_per_s = static_cast<double>(figures.cycles) / figures.wall_s;
      figures.times_real_time = figures.cycles_per_s * period_s;
    }
    figures.lost_records = json.at("records_lost").get<std::uint64_t>();
    figures.lost_messages = json.at("messages_lost").get<std::uint64_t>();
    figures.rejected_frames = json.at("frames_rejected").get<std::uint64_t>();
    figures.real_time = json.at("realtime").get<std::string>();
    figures.trip_file = json.at("trip_file").get<std::string>();
    figures.delay = Delay(json);
    ReadTiming(json.at("timing"), figures);
  });
}

std::optional<RigFigures> ReadRigReport(const std::string& path) {
  return Read<RigFigures>(path, [](const Json& json, RigFigures& figures) {
    figures.cycles = json.at("cycles").get<std::uint64_t>();
    figures.held_currents = json.at("held_currents").get<std::uint64_t>();
    figures.lost_messages = json.at("messages_lost").get<std::uint64_t>();
    figures.watchdog_trips = json.at("watchdog_trips").get<std::uint64_t>();
    figures.advance = Duration("rig's period", json.at("advance"));
  });
}

}  // namespace levitas::verdict
