#include "analysis/step_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/bare_loop.hpp"

namespace levitas::analysis {
namespace {

constexpr int kFiner = 8;
constexpr double kDurationS = 1.0;
constexpr double kManyModes = 16.0;
constexpr double kRelease = 0.1;  // of the clearance

/// A tenth of the clearance off its centre on every axis, turning.
void Release(BareLoop& loop, const plant::PlantConfig& rig, double speed_rad_per_s) {
  AxisArray release_m{};
  for (std::size_t axis = 0; axis < loop.axes(); ++axis) {
    const plant::BearingConfig& bearing = rig.bearings[axis / 2];
    const double room_m = bearing.touchdown.clearance_m > 0.0 ? bearing.touchdown.clearance_m
                                                              : 0.5 * bearing.magnet.gap_m;
    release_m[axis] = kRelease * room_m;
  }
  loop.PlaceAtRest(release_m);
  loop.Turn(speed_rad_per_s, 0.0);
}

}  // namespace

StepError MeasureStepError(const plant::PlantConfig& rig, const law::LawConfig& law,
                           double speed_rad_per_s) {
  plant::PlantConfig fine = rig;
  fine.substeps = kFiner * rig.substeps;
  BareLoop with_rigs_step(rig, law);
  BareLoop with_finer_step(fine, law);
  for (BareLoop* loop : {&with_rigs_step, &with_finer_step}) Release(*loop, rig, speed_rad_per_s);
  const auto modes = static_cast<double>(rig.rotor.given ? rig.rotor.given->modes.size() + 2
                                                         : rig.rotor.modes_per_plane);
  const double share = modes > 0.0 ? std::min(1.0, kManyModes / modes) : 0.1;
  const double period_s = static_cast<double>(rig.period_ns) * 1e-9;
  const auto periods = static_cast<std::uint64_t>(share * kDurationS / period_s);
  StepError error{rig.substeps,    fine.substeps, static_cast<double>(periods) * period_s,
                  speed_rad_per_s, 0.0,           0.0};
  for (std::uint64_t n = 0; n < periods; ++n) {
    const AxisArray a_m = with_rigs_step.Step();
    const AxisArray b_m = with_finer_step.Step();
    for (std::size_t axis = 0; axis < law.axis_count(); ++axis) {
      const double difference_m = std::abs(a_m[axis] - b_m[axis]);
      error.largest_m = std::isfinite(difference_m) ? std::max(error.largest_m, difference_m)
                                                    : std::numeric_limits<double>::infinity();
      error.peak_m = std::max(error.peak_m, std::abs(b_m[axis]));
    }
  }
  return error;
}

}  // namespace levitas::analysis
