#include "verdict/session_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace levitas::verdict {
namespace {

std::uint64_t Cycles(double time_s, const RigNumbers& rig) {
  return static_cast<std::uint64_t>(std::llround(std::max(time_s, 0.0) / rig.period_s()));
}

/// Faster than any rotor: a reading beyond it, or none at all, belongs to no bin.
constexpr double kFastest = RpmToRadPerS(1e6);

/// A reading that is not finite must look large, not vanish in a comparison with NaN.
double Radius(double x_m, double y_m) {
  const double radius_m = std::hypot(x_m, y_m);
  return std::isfinite(radius_m) ? radius_m : std::numeric_limits<double>::infinity();
}

}  // namespace

SessionStatistics::SessionStatistics(const RigNumbers& rig, double standstill_rad_per_s,
                                     double settle_s)
    : rig_(rig),
      frame_(rig),
      splitter_(standstill_rad_per_s, Cycles(settle_s, rig)),
      standstill_rad_per_s_(standstill_rad_per_s) {
  figures_.standstill_rad_per_s = standstill_rad_per_s;
  standing_.bearings.resize(rig.bearings.size());
  spinning_.bearings.resize(rig.bearings.size());
}

double SessionStatistics::TimeOf(const cycle::CycleRecord& record) const {
  return static_cast<double>(record.in.cycle - first_cycle_) * rig_.period_s();
}

void SessionStatistics::Add(const cycle::CycleRecord& record) {
  if (figures_.cycles == 0) {
    first_cycle_ = record.in.cycle;
    previous_cycle_ = record.in.cycle - 1;
  }
  ++figures_.cycles;
  AddLosses(record);
  AddMode(record);
  AddRelease(record);
  const double speed_rad_per_s = record.in.frame.speed_rad_per_s;
  figures_.top_speed_rad_per_s = std::max(figures_.top_speed_rad_per_s, std::abs(speed_rad_per_s));
  const Phase phase = splitter_.Next(record.in.cycle, record.out.mode, speed_rad_per_s);
  if (record.in.frame_present) AddSpeed(phase == Phase::kSpinning ? speed_rad_per_s : 0.0);
  if (phase != Phase::kNotJudged) {
    PhaseSums& sums = phase == Phase::kStanding ? standing_ : spinning_;
    ++sums.cycles;
    if (record.in.frame_present) AddOrbit(record, sums, phase == Phase::kSpinning);
    AddCurrents(record, sums);
  }
  previous_cycle_ = record.in.cycle;
}

// One frame alone may be wrong: the smaller of two in a row was reached.
void SessionStatistics::AddSpeed(double speed_rad_per_s) {
  const double now_rad_per_s = std::isfinite(speed_rad_per_s) ? std::abs(speed_rad_per_s) : 0.0;
  figures_.levitated_speed_rad_per_s = std::max(
      figures_.levitated_speed_rad_per_s, std::min(now_rad_per_s, previous_spinning_rad_per_s_));
  previous_spinning_rad_per_s_ = now_rad_per_s;
}

void SessionStatistics::AddLosses(const cycle::CycleRecord& record) {
  if (record.in.cycle > previous_cycle_) {
    figures_.missing_records += record.in.cycle - previous_cycle_ - 1;
  }
  figures_.skipped_periods += record.in.missed_deadlines;
  if (!record.in.frame_present) {
    ++figures_.missing_frames;
    return;
  }
  const SensorFrame& frame = record.in.frame;
  // The rig counts from its own start; what it held before the first record is not this run's.
  const bool same_rig = !first_frame_ && frame.rig_session == rig_session_;
  if (same_rig) figures_.held_currents += frame.held_currents - previous_held_;
  first_frame_ = false;
  rig_session_ = frame.rig_session;
  previous_held_ = frame.held_currents;
}

// The frame before counts too: what switches the amplifiers off may be a single wrong speed. Two
// frames must show that it turned, since one may as well be wrong in the other direction.
void SessionStatistics::AddRelease(const cycle::CycleRecord& record) {
  const double speed_rad_per_s = std::abs(record.in.frame.speed_rad_per_s);
  const bool energised = record.out.current.amplifiers_enabled;
  if (energised_ && !energised && !figures_.release) {
    letting_go_ = ReleaseFigures{TimeOf(record), last_speed_rad_per_s_};
  }
  if (energised) letting_go_.reset();
  energised_ = energised;
  last_speed_rad_per_s_ = speed_rad_per_s;
  if (!letting_go_ || figures_.release) return;
  if (TimeOf(record) - letting_go_->time_s > kReleaseWindowS) {
    letting_go_.reset();
    return;
  }
  if (!(speed_rad_per_s > standstill_rad_per_s_)) return;
  if (letting_go_->speed_rad_per_s > standstill_rad_per_s_) {
    figures_.release = letting_go_;
    figures_.release->speed_rad_per_s = std::min(letting_go_->speed_rad_per_s, speed_rad_per_s);
  }
  letting_go_->speed_rad_per_s = speed_rad_per_s;
}

void SessionStatistics::AddMode(const cycle::CycleRecord& record) {
  const double now_s = TimeOf(record);
  const Mode mode = record.out.mode;
  const Mode before = figures_.modes.empty() ? Mode::kOff : figures_.modes.back().mode;
  const bool changed = figures_.modes.empty() || before != mode;
  if (record.out.fault != Fault::kNone && previous_fault_ == Fault::kNone) {
    ++figures_.trips;
    if (!figures_.trip) {
      figures_.trip = TripFigures{record.out.fault,
                                  record.out.fault_axis,
                                  record.out.fault_value,
                                  record.out.fault_limit,
                                  now_s,
                                  before,
                                  record.in.frame.speed_rad_per_s};
    }
  }
  previous_fault_ = record.out.fault;
  if (changed) figures_.modes.push_back({mode, now_s, 0.0});
  figures_.modes.back().duration_s = now_s + rig_.period_s() - figures_.modes.back().start_s;
  figures_.duration_s = now_s + rig_.period_s();
}

void SessionStatistics::AddOrbit(const cycle::CycleRecord& record, PhaseSums& sums, bool spinning) {
  ++sums.orbit_cycles;
  const SensorFrame& frame = record.in.frame;
  ProfileBin* bin = nullptr;
  if (spinning && std::abs(frame.speed_rad_per_s) <= kFastest) {
    const auto index =
        static_cast<std::size_t>(std::abs(frame.speed_rad_per_s) / kProfileBinRadPerS);
    while (profile_.size() <= index) {
      const double middle = (static_cast<double>(profile_.size()) + 0.5) * kProfileBinRadPerS;
      profile_.push_back({middle, 0, std::vector<double>(rig_.bearings.size(), 0.0)});
    }
    bin = &profile_[index];
    ++bin->cycles;
  }
  const AxisArray position_m = frame_.Bearing(record).position_m;
  for (std::size_t b = 0; b < rig_.bearings.size(); ++b) {
    const double x_m = position_m[2 * b];
    const double y_m = position_m[2 * b + 1];
    const double radius_m = Radius(x_m, y_m);
    BearingSums& bearing = sums.bearings[b];
    bearing.sum_x_m += x_m;
    bearing.sum_y_m += y_m;
    bearing.square_m2 += x_m * x_m + y_m * y_m;
    if (radius_m > bearing.worst.max_m) {
      bearing.worst.max_m = radius_m;
      bearing.worst.max_speed_rad_per_s = frame.speed_rad_per_s;
      bearing.worst.max_time_s = TimeOf(record);
    }
    if (bin != nullptr) bin->max_m[b] = std::max(bin->max_m[b], radius_m);
  }
}

void SessionStatistics::AddCurrents(const cycle::CycleRecord& record, PhaseSums& sums) const {
  if (record.out.saturated_axes != 0) ++sums.saturated;
  const double bias_a = record.out.current.bias_current_a;
  sums.bias_a += bias_a;
  sums.bias_square_a2 += bias_a * bias_a;
  const AxisArray currents_a = frame_.Bearing(record).current_a;
  for (std::size_t axis = 0; axis < 2 * rig_.bearings.size(); ++axis) {
    const double current_a = currents_a[axis];
    AxisSums& at = sums.bearings[axis / 2].axis[axis % 2];
    at.sum_a += current_a;
    at.square_a2 += current_a * current_a;
    at.peak_a = std::max(at.peak_a, std::abs(current_a));
    if ((record.out.saturated_axes >> axis & 1U) != 0U) ++at.saturated;
  }
}

PhaseFigures SessionStatistics::Summary(const PhaseSums& sums) const {
  PhaseFigures phase;
  phase.cycles = sums.cycles;
  phase.duration_s = static_cast<double>(sums.cycles) * rig_.period_s();
  const double cycles = static_cast<double>(std::max<std::uint64_t>(sums.cycles, 1));
  const double frames = static_cast<double>(std::max<std::uint64_t>(sums.orbit_cycles, 1));
  phase.saturated_share = static_cast<double>(sums.saturated) / cycles;
  phase.mean_bias_a = sums.bias_a / cycles;
  double square_a2 = sums.bias_square_a2;
  for (std::size_t b = 0; b < sums.bearings.size(); ++b) {
    const BearingSums& bearing = sums.bearings[b];
    BearingFigures figures{rig_.bearings[b], bearing.worst, {}};
    figures.orbit.rms_m = std::sqrt(bearing.square_m2 / frames);
    figures.orbit.offset_x_m = bearing.sum_x_m / frames;
    figures.orbit.offset_y_m = bearing.sum_y_m / frames;
    for (std::size_t k = 0; k < 2; ++k) {
      const AxisSums& axis = bearing.axis[k];
      const double mean_a = axis.sum_a / cycles;
      square_a2 += axis.square_a2 / static_cast<double>(rig_.axes());
      const double variance_a2 = std::max(0.0, axis.square_a2 / cycles - mean_a * mean_a);
      figures.current[k] = {mean_a, std::sqrt(variance_a2), axis.peak_a,
                            static_cast<double>(axis.saturated) / cycles};
    }
    phase.bearings.push_back(figures);
  }
  phase.copper_share = square_a2 / cycles / (rig_.bias_current_a * rig_.bias_current_a);
  return phase;
}

SessionFigures SessionStatistics::Figures() const {
  SessionFigures figures = figures_;
  figures.standing = Summary(standing_);
  figures.spinning = Summary(spinning_);
  for (const ProfileBin& bin : profile_) {
    if (bin.cycles > 0) figures.profile.push_back(bin);
  }
  return figures;
}

}  // namespace levitas::verdict
