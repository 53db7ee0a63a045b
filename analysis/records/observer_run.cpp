#include <cmath>

#include "analysis/records/innovations.hpp"

namespace levitas::analysis {

std::uint64_t InnovationRun::rows() const noexcept {
  std::uint64_t count = 0;
  for (const auto& piece : pieces) count += piece.size();
  return count;
}

InnovationRun RunObserver(const plant::PlantConfig& plant, std::shared_ptr<const ObserverGain> gain,
                          const std::vector<RecordedRow>& rows, double settling_s) {
  InnovationRun run;
  run.period_s = static_cast<double>(plant.period_ns) * 1e-9;
  if (!rows.empty()) run.first_cycle = rows.front().cycle;
  const auto settling_rows = static_cast<std::uint64_t>(std::llround(settling_s / run.period_s));
  Observer observer(plant, std::move(gain));
  const auto axes = static_cast<std::size_t>(observer.unknown_force_n().size());
  AxisArray force_sum_n{};
  std::uint64_t since_start = 0;
  const RecordedRow* previous = nullptr;
  for (const RecordedRow& row : rows) {
    const bool consecutive = previous != nullptr && row.cycle == previous->cycle + 1;
    if (previous != nullptr && !consecutive) ++run.gaps;
    const bool continues = consecutive && previous->levitated;
    previous = &row;
    if (!row.levitated) {
      ++run.idle_rows;
      continue;
    }
    if (!continues) {
      observer.Restart(row.sample.position_m);
      since_start = 0;
    }
    const AxisArray innovation_m = observer.Step(row.sample);
    if (since_start++ < settling_rows) {
      ++run.settling_rows;
      continue;
    }
    if (since_start == settling_rows + 1) run.pieces.emplace_back();
    run.pieces.back().push_back({row.cycle, row.sample.speed_rad_per_s, row.sample.angle_rad,
                                 innovation_m, row.excitation_a});
    for (std::size_t i = 0; i < axes; ++i) {
      force_sum_n[i] += observer.unknown_force_n()[static_cast<Eigen::Index>(i)];
    }
  }
  const auto compared = static_cast<double>(run.rows());
  for (std::size_t i = 0; i < axes && compared > 0.0; ++i) {
    run.unknown_force_n[i] = force_sum_n[i] / compared;
  }
  return run;
}

}  // namespace levitas::analysis
