#include "diagnosis/record_errors/find.hpp"

#include <algorithm>

#include "common/problem.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/law_fit.hpp"
#include "diagnosis/record_errors/plant_fit.hpp"
#include "diagnosis/record_errors/position_unit.hpp"
#include "diagnosis/record_errors/wiring.hpp"
#include "diagnosis/records/levitated_interval.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kMostRows = 16'000;
/// Between the observers of a search: slow enough to see what columns do, fast enough to follow a
/// rig that is off its file.
constexpr ObserverSpeed kObserver{0.003, 1e-5};

}  // namespace

Record Mended(const RigView& rig, const Record& record, const RecordErrors& found) {
  Record out = record;
  const auto rows = static_cast<std::ptrdiff_t>(record.rows.size());
  for (std::ptrdiff_t n = 0; n < rows; ++n) {
    analysis::RecordedRow& row = out.rows[static_cast<std::size_t>(n)];
    const auto late = [&](const ColumnUse& use) -> const analysis::RecordedSample& {
      const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(n + use.late, 0, rows - 1);
      return record.rows[static_cast<std::size_t>(at)].sample;
    };
    for (std::size_t a = 0; a < rig.axes; ++a) {
      const ColumnUse& position = found.uses.position[a];
      const ColumnUse& current = found.uses.current[a];
      row.sample.position_m[a] = position.factor * late(position).position_m[position.from];
      row.sample.command.control_current_a[a] =
          current.factor * late(current).command.control_current_a[current.from];
    }
    row.sample.speed_rad_per_s *= found.speed_factor;
    row.sample.angle_rad *= found.angle_factor;
  }
  return out;
}

RecordErrors FindRecordErrors(const RigView& rig, const Record& record) {
  RecordErrors out;
  out.record = record.name;
  FindPositionUnits(rig, record, out);
  Record mended = Mended(rig, record, out);
  LeaveOutContact(rig, mended);
  const Columns columns = ColumnsOf(mended, rig, kMostRows);
  RecordErrors wiring;
  try {
    const PlantFit plant(rig, columns, kObserver);
    FindWiring(rig, columns, FitLaw(rig, columns), plant, wiring);
  } catch (const Problem&) {  // no observer exists: nothing can be said
    return out;
  }
  for (std::size_t a = 0; a < rig.axes; ++a) {
    // What the wiring takes a column for is a column whose unit was mended.
    wiring.uses.position[a].factor *= out.uses.position[wiring.uses.position[a].from].factor;
  }
  out.uses = wiring.uses;
  out.errors.insert(out.errors.end(), wiring.errors.begin(), wiring.errors.end());
  return out;
}

}  // namespace levitas::diagnosis
