#include "diagnosis/record_errors/find.hpp"

#include <algorithm>
#include <cmath>

#include "common/each_in_parallel.hpp"
#include "common/problem.hpp"
#include "diagnosis/record_errors/columns.hpp"
#include "diagnosis/record_errors/gaps.hpp"
#include "diagnosis/record_errors/law_fit.hpp"
#include "diagnosis/record_errors/plant_fit.hpp"
#include "diagnosis/record_errors/position_unit.hpp"
#include "diagnosis/record_errors/rate.hpp"
#include "diagnosis/record_errors/readings.hpp"
#include "diagnosis/record_errors/rotation_unit.hpp"
#include "diagnosis/record_errors/wiring.hpp"
#include "diagnosis/records/levitated_interval.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kMostRows = 16'000;
/// Between the observers of a search: slow enough to see what columns do, fast enough to follow a
/// rig that is off its file.
constexpr ObserverSpeed kObserver{0.003, 1e-5};
constexpr Eigen::Index kFewestRows = 500;
constexpr double kAlike = 0.05;  ///< rates that records show

/// What law and plant tell, of columns whose positions are in metres.
void FindInTheLoop(const RigView& rig, const Columns& columns, const SeenElsewhere& elsewhere,
                   RecordErrors& out) {
  const std::vector<LawOfColumn> laws = FitLaw(rig, columns);
  RecordErrors wiring;
  const PlantFit plant(rig, columns, kObserver);
  FindWiring(rig, columns, laws, plant, elsewhere.wiring, wiring);
  const Eigen::VectorXd left = plant.MeanSquares(wiring.uses);
  const bool spoilt = !out.errors.empty() || !wiring.errors.empty();
  if (left.size() > 0 && !spoilt) {
    FindRate(rig, columns, laws, left.array().log().sum(), elsewhere.rows_apart, out);
  }
  out.wiring = wiring.uses;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    // What the wiring takes a column for is a column whose unit was mended.
    ColumnUse& use = wiring.uses.position[a];
    use.factor *= out.uses.position[use.from].factor;
  }
  out.uses = wiring.uses;
  out.errors.insert(out.errors.end(), wiring.errors.begin(), wiring.errors.end());
}

/// [periods] What all records agree on that turn; else 0.
double RateShownBy(const std::vector<RecordErrors>& found) {
  double shown = 0.0;
  for (const RecordErrors& turned : found) {
    if (turned.rows_apart == 0.0) continue;
    if (shown > 0.0 && std::abs(turned.rows_apart / shown - 1.0) > kAlike) return 0.0;
    shown = turned.rows_apart;
  }
  return shown;
}

SeenElsewhere ShownBy(const std::vector<RecordErrors>& found) {
  SeenElsewhere out;
  const auto wired = std::ranges::find_if(found, [](const RecordErrors& errors) {
    return errors.has_test_signal && !(errors.wiring == ColumnUses{});
  });
  if (wired != found.end()) out.wiring = wired->wiring;
  out.rows_apart = RateShownBy(found);
  return out;
}

/// Has the record another wiring than others show, of which it knows less than they?
bool IsUnsureOfWiring(const RecordErrors& found, const SeenElsewhere& elsewhere) {
  return !(elsewhere.wiring == ColumnUses{}) && !found.has_test_signal &&
         !(found.wiring == elsewhere.wiring);
}

/// Does it state a rate by its plant alone, where another one turns?
bool IsUnsureOfRate(const RecordErrors& found, const SeenElsewhere& elsewhere) {
  const bool by_its_times = found.drifts || found.time_factor != 1.0;
  const bool says_rate = std::ranges::any_of(
      found.errors, [](const RecordError& error) { return error.kind == RecordErrorKind::kRate; });
  return elsewhere.rows_apart > 0.0 && found.rows_apart == 0.0 && says_rate && !by_its_times;
}

void LeaveGaps(const std::vector<std::uint64_t>& gaps, Record& record) {
  std::size_t passed = 0;
  for (analysis::RecordedRow& row : record.rows) {
    while (passed < gaps.size() && gaps[passed] <= row.cycle) ++passed;
    row.cycle += passed * kUnknownGap;
  }
}

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
    if (found.angle_factor == 1.0 || n == 0) continue;
    // An angle in another unit was wrapped on the way: the speed tells how far it turned.
    const analysis::RecordedRow& before = out.rows[static_cast<std::size_t>(n - 1)];
    row.sample.angle_rad =
        before.sample.angle_rad + rig.period_s * before.sample.speed_rad_per_s *
                                      static_cast<double>(row.cycle - before.cycle);
  }
  LeaveGaps(found.gaps, out);
  return out;
}

RecordErrors FindRecordErrors(const RigView& rig, const Record& record,
                              const SeenElsewhere& elsewhere) {
  RecordErrors out;
  out.record = record.name;
  FindClock(rig, record.times_s, out);
  FindPositionUnits(rig, record, out);
  Record mended = Mended(rig, record, out);
  LeaveOutContact(rig, mended);
  Columns columns = ColumnsOf(mended, rig, kMostRows);
  if (columns.rows() < kFewestRows) return out;
  out.has_test_signal = columns.excitation_a.cwiseAbs().maxCoeff() > 0.0;
  FindQuantised(rig, columns, out);
  FindClipped(rig, columns, out);
  FindHeld(rig, columns, out);
  const bool read_wrong = std::ranges::any_of(out.errors, [](const RecordError& error) {
    return error.kind == RecordErrorKind::kQuantised || error.kind == RecordErrorKind::kClipped ||
           error.kind == RecordErrorKind::kHeld;
  });
  FindRotationUnit(rig, columns, out);
  // Neither law nor plant is in such readings, nor in rows of which some are left out.
  if (read_wrong || FindRateOfRotation(rig, columns, out)) return out;
  FindGaps(rig, mended, record.rows.front().cycle, out);
  if (!out.gaps.empty()) {
    LeaveGaps(out.gaps, mended);
    columns = ColumnsOf(mended, rig, kMostRows);
  }
  try {
    FindInTheLoop(rig, columns, elsewhere, out);
  } catch (const Problem&) {  // no observer exists: nothing can be said
  }
  return out;
}

std::vector<RecordErrors> FindErrorsOfRecords(const RigView& rig,
                                              const std::vector<Record>& records) {
  std::vector<RecordErrors> found(records.size());
  EachThatMayFail(records.size(), 0,
                  [&](std::size_t i) { found[i] = FindRecordErrors(rig, records[i], {}); });
  const SeenElsewhere elsewhere = ShownBy(found);
  for (std::size_t i = 0; i < records.size(); ++i) {
    SeenElsewhere unsure_of;
    if (IsUnsureOfWiring(found[i], elsewhere)) unsure_of.wiring = elsewhere.wiring;
    if (IsUnsureOfRate(found[i], elsewhere)) unsure_of.rows_apart = elsewhere.rows_apart;
    if (!(unsure_of == SeenElsewhere{})) {
      found[i] = FindRecordErrors(rig, records[i], unsure_of);
    }
  }
  return found;
}

}  // namespace levitas::diagnosis
