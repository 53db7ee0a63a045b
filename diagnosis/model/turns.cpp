#include "diagnosis/model/turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace levitas::diagnosis {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kEnough = 10'000;  ///< rows that tell the turn

/// Squared innovations of the nominal model, from the first sample on.
double Misfit(const RigView& rig, const ObserverGains& gains, const Record& record) {
  const Trajectory run = RunModel(rig, record, gains, {}, {}, 0.0);
  double sum = 0.0;
  for (const SamplePoint& m : run.moments) {
    for (std::size_t a = 0; a < rig.axes; ++a) {
      sum += static_cast<double>(m.innovation_m[a]) * static_cast<double>(m.innovation_m[a]);
    }
  }
  return sum;
}

void Shift(Record& record, double angle_rad) {
  for (auto& row : record.rows) row.sample.angle_rad += angle_rad;
}

}  // namespace

void Unwrap(Record& record, double period_s) {
  for (std::size_t n = 1; n < record.rows.size(); ++n) {
    const auto& before = record.rows[n - 1];
    auto& row = record.rows[n];
    const double passed_s =
        row.cycle > before.cycle ? period_s * static_cast<double>(row.cycle - before.cycle) : 0.0;
    const double speed = 0.5 * (before.sample.speed_rad_per_s + row.sample.speed_rad_per_s);
    const double expected = before.sample.angle_rad + speed * passed_s;
    row.sample.angle_rad += kTurn * std::round((expected - row.sample.angle_rad) / kTurn);
  }
}

void ChooseTurn(const RigView& rig, const ObserverGains& gains, Record& record) {
  const auto turns = static_cast<int>(std::lround(rig.model->train().turns_per_repeat));
  if (turns < 2) return;
  // The start-up gain estimates no disturbance force, which would hide a wrong wheel position.
  const ObserverGains start{gains.start, {{0, gains.start}}};
  Record part = record;
  part.rows.resize(std::min(part.rows.size(), kEnough));
  double least = std::numeric_limits<double>::infinity();
  int best = 0;
  for (int turn = 0; turn < turns; ++turn) {
    const double misfit = Misfit(rig, start, part);
    if (misfit < least) {
      least = misfit;
      best = turn;
    }
    Shift(part, kTurn);
  }
  Shift(record, kTurn * best);
}

void TurnTo(plant::Plant& plant, double from_rad, double to_rad) {
  constexpr double kStep = 2.0;  // [rad] less than half a turn: the plant counts what passes
  const double repeat_rad = kTurn * plant.model().train().turns_per_repeat;
  double way_rad = std::fmod(to_rad - from_rad, repeat_rad);
  if (way_rad < 0.0) way_rad += repeat_rad;
  const auto steps = static_cast<int>(std::ceil(way_rad / kStep));
  for (int i = 1; i <= steps; ++i) {
    plant.SetSpeed(plant.speed_rad_per_s(), from_rad + way_rad * i / steps);
  }
}

}  // namespace levitas::diagnosis
