#include "design/pid/schedule_search.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "common/rotational_speed.hpp"
#include "controller/law/law_schedule.hpp"

namespace levitas::design {
namespace {

using Seen = std::function<bool(double, const std::string&)>;

/// Share and text of one search among several.
Seen PartOf(const Seen& seen, std::size_t part, std::size_t parts, std::string name) {
  return [&seen, part, parts, name = std::move(name)](double share, const std::string& text) {
    const double done = (static_cast<double>(part) + share) / static_cast<double>(parts);
    return seen(done, name + ": " + text);
  };
}

struct Entry {
  double speed_rad_per_s{};
  PidPoint point;
  std::vector<law::AxisLawConfig> axes;
};

law::LawConfig TableOf(const std::vector<Entry>& entries, const law::LawConfig& like) {
  law::LawConfig table = like;
  table.axes = entries.front().axes;
  for (std::size_t i = 1; i < entries.size(); ++i)
    table.schedule.push_back({entries[i].speed_rad_per_s, entries[i].axes, {}});
  return table;
}

class TableSearch {
 public:
  TableSearch(const configuration::RigFile& rig, const PidLimits& limits,
              const std::vector<uncertainty::Parameter>& parameters, const ScheduleOptions& options,
              const Seen& seen)
      : rig_(rig), limits_(limits), parameters_(parameters), options_(options), seen_(seen) {}

  ScheduleResult Run() {
    const auto& speeds = options_.speeds_rad_per_s;
    // The last law stays above its speed, where a rig may get by its over-speed.
    const double top = std::max(speeds.back(), 1.1 * rig_.numbers.max_speed_rad_per_s);
    parts_ = speeds.size() + 1;
    out_.one = SearchPid(rig_, limits_, parameters_, options_.search,
                         PartOf(seen_, part_++, parts_, "one law for all speeds"));
    out_.evaluations = out_.one.evaluations;
    out_.interrupted = out_.one.interrupted;
    std::vector<Entry> entries;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      const double below = speeds[i == 0 ? 0 : i - 1];
      const double above = i + 1 < speeds.size() ? speeds[i + 1] : top;
      entries.push_back(Searched(entries.empty() ? out_.one.point : entries.back().point, speeds[i],
                                 below, above));
    }
    FillGaps(entries);
    out_.law = TableOf(entries, out_.one.law);
    return out_;
  }

 private:
  /// An entry for `speed` that holds from `below` to `above`, near the law of `start`.
  Entry Searched(const PidPoint& start, double speed, double below, double above) {
    if (out_.interrupted) return {speed, start, LawAt(start.shape, start.x).axes};
    PidSearchOptions part = options_.search;
    part.least_speed_rad_per_s = below;
    part.most_speed_rad_per_s = above;
    part.seed += 1000 * part_;
    const auto found = SearchPidFrom(start, rig_, limits_, parameters_, part,
                                     PartOf(seen_, std::min(part_, parts_ - 1), parts_,
                                            fmt::format("{:.0f} rpm", RadPerSToRpm(speed))));
    ++part_;
    out_.evaluations += found.evaluations;
    out_.interrupted = found.interrupted;
    return {speed, found.point, found.law.axes};
  }

  /// Whether the laws between two neighbours hold, and keep |S| within its limit, in between.
  [[nodiscard]] bool Holds(const std::vector<Entry>& entries, std::size_t i) const {
    constexpr int kBetween = 8;
    const PidJudge judge(rig_, limits_, options_.search.third_n);
    const law::LawConfig table = TableOf(entries, out_.one.law);
    const double from = entries[i].speed_rad_per_s;
    const double to = entries[i + 1].speed_rad_per_s;
    for (int k = 1; k < kBetween; ++k) {
      const double speed = from + (to - from) * k / kBetween;
      const auto plant = std::make_shared<SampledPlant>(rig_, speed, Known::kAll);
      const PidFigures at = judge.Of(law::LawAt(table, speed), {{plant, true}});
      if (at.growing > 0 || at[Limit::kSensitivity].ratio > 1.0) return false;
    }
    return true;
  }

  /// Another entry in the middle of two whose laws do not hold what lies between them.
  void FillGaps(std::vector<Entry>& entries) {
    constexpr int kMostAdded = 3;  // between two speeds that were asked for
    int added = 0;
    for (std::size_t i = 0; i + 1 < entries.size() && !out_.interrupted;) {
      const double below = entries[i].speed_rad_per_s;
      const double above = entries[i + 1].speed_rad_per_s;
      const bool holds = Holds(entries, i);
      if (!holds && added < kMostAdded && entries.size() < kMostEntries) {
        const Entry middle = Searched(entries[i].point, 0.5 * (below + above), below, above);
        entries.insert(entries.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
        ++added;
        continue;
      }
      if (!holds) out_.open.emplace_back(below, above);
      const auto& asked = options_.speeds_rad_per_s;
      if (std::find(asked.begin(), asked.end(), above) != asked.end()) added = 0;
      ++i;
    }
  }

  const configuration::RigFile& rig_;
  const PidLimits& limits_;
  const std::vector<uncertainty::Parameter>& parameters_;
  const ScheduleOptions& options_;
  const Seen& seen_;
  ScheduleResult out_;
  std::size_t part_{};
  std::size_t parts_{};
};

}  // namespace

ScheduleResult SearchSchedule(const configuration::RigFile& rig, const PidLimits& limits,
                              const std::vector<uncertainty::Parameter>& parameters,
                              const ScheduleOptions& options, const Seen& seen) {
  return TableSearch(rig, limits, parameters, options, seen).Run();
}

}  // namespace levitas::design
