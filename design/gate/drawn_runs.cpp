#include "design/gate/drawn_runs.hpp"

#include <algorithm>
#include <cmath>

#include "common/two_pi.hpp"
#include "controller/law/running_law.hpp"
#include "plant_sim/plant/plant.hpp"

namespace levitas::design {
namespace {

struct Watch {
  std::vector<std::complex<double>> synchronous;
  std::vector<double> sum;
  std::size_t saturated{}, seen{};
};

/// Instants of a run, in periods from its start.
struct Schedule {
  std::size_t lift{};     ///< the reference is in the centre
  std::size_t turning{};  ///< the rotor turns
  std::size_t settle{};   ///< the watch begins
  std::size_t down{};     ///< after a run-up, the drive takes the rotor back to rest
  std::size_t all{};      ///< the end
  std::size_t kept{};     ///< so many before the end are kept
};

Schedule ScheduleOf(const RunOptions& options, double period_s, double run_up_s) {
  constexpr double kLiftS = 0.3;  // the reference's way to the centre, and as long to settle there
  const double w = options.speed_rad_per_s;
  double watch_s = options.watch_s;
  double kept_s = 0.02;
  if (w > 0.0) {  // whole turns, of a rotor that makes some
    const double turn_s = kTwoPi / w;
    if (turn_s < watch_s) watch_s = turn_s * std::round(watch_s / turn_s);
    kept_s = std::min(2.0 * turn_s, watch_s);
  }
  const auto periods = [&](double seconds) { return static_cast<std::size_t>(seconds / period_s); };
  Schedule out;
  out.lift = periods(kLiftS);
  out.turning = periods(2.0 * kLiftS);
  out.settle = out.turning + (run_up_s > 0.0 ? 0 : periods(options.settle_s));
  out.down = out.settle + periods(run_up_s + watch_s);
  out.all = out.down + periods(run_up_s);
  out.kept = periods(kept_s);
  return out;
}

/// The drive begins: at the speed at once, or on its way up.
void StartTurning(const RunOptions& options, double rate_rad_per_s2, plant::Plant& plant,
                  plant::PlantCommand& command) {
  const double w = options.speed_rad_per_s;
  if (!options.run_up) plant.SetSpeed(w, 0.0);
  command.drive_enabled = w > 0.0;
  command.speed_set_point_rad_per_s = w;
  command.acceleration_limit_rad_per_s2 = rate_rad_per_s2;
}

/// The reference leaves the touchdown bearing with the share `still` of the way to go.
AxisArray ErrorOf(const RigNumbers& numbers, std::size_t axes, double still,
                  const AxisArray& resting_m, const AxisArray& position_m) {
  AxisArray error_m{};
  for (std::size_t i = 0; i < axes; ++i)
    error_m[i] = numbers.sensor_polarity[i] * (still * resting_m[i] - position_m[i]);
  return error_m;
}

/// The orbit of each bearing, and whether the turning rotor left the room it may use.
void WatchOrbits(const RigNumbers& numbers, std::size_t axes, const AxisArray& y, bool turning,
                 bool watched, RunFigures& out) {
  constexpr double kAllowedShare = 0.5;
  for (std::size_t b = 0; b < out.orbit_m.size(); ++b) {
    const double radius = std::hypot(y[2 * b], 2 * b + 1 < axes ? y[2 * b + 1] : 0.0);
    if (turning) out.lost = out.lost || !(radius < kAllowedShare * numbers.ClearanceOf(b));
    if (watched) out.orbit_m[b] = std::max(out.orbit_m[b], radius);
  }
}

void WatchCurrents(const law::LawOutput& given, double angle_rad, Watch& watch) {
  ++watch.seen;
  watch.saturated += given.saturated_axes != 0 ? 1 : 0;
  for (std::size_t i = 0; i < watch.sum.size(); ++i) {
    watch.sum[i] += given.control_current_a[i];
    watch.synchronous[i] += given.control_current_a[i] * std::polar(1.0, -angle_rad);
  }
}

/// Static and synchronous currents as means over the watch.
void TakeMeans(const Watch& watch, bool turns, RunFigures& out) {
  const double count = std::max<double>(1.0, static_cast<double>(watch.seen));
  out.saturated_share = static_cast<double>(watch.saturated) / count;
  for (std::size_t i = 0; i < watch.sum.size(); ++i) {
    out.static_a.push_back(watch.sum[i] / count);
    out.synchronous_a.push_back(turns ? 2.0 * std::abs(watch.synchronous[i]) / count : 0.0);
  }
}

}  // namespace

configuration::RigFile WithThirdHarmonic(const configuration::RigFile& rig, double newtons) {
  configuration::RigFile out = rig;
  if (!rig.plant.shafts.empty() || !(newtons > 0.0)) return out;
  effect::EffectConfig entry;
  entry.id = effect::Id::kMisalignment;
  entry.values[0] = 0.0;
  entry.values[1] = -3.0;
  entry.values[2] = newtons;
  out.plant.effects.push_back(entry);
  return out;
}

RunFigures RunOnce(const configuration::RigFile& rig, const law::LawConfig& law,
                   const RunOptions& options) {
  plant::Plant plant(rig.plant, options.seed);
  plant.RestInTouchdown();
  const AxisArray resting_m = plant.SensorOutput();
  law::RunningLaw running(law);
  const double period_s = rig.numbers.period_s();
  const std::size_t axes = law.axis_count();
  const double w = options.speed_rad_per_s;
  const double rate = rig.plant.drive.max_acceleration_rad_per_s2;
  const Schedule when = ScheduleOf(options, period_s, options.run_up ? w / rate : 0.0);
  RunFigures out;
  out.orbit_m.assign((axes + 1) / 2, 0.0);
  Watch watch{std::vector<std::complex<double>>(axes), std::vector<double>(axes), 0, 0};
  plant::PlantCommand command;
  command.bias_current_a = rig.numbers.bias_current_a;
  for (std::size_t n = 0; n < when.all && !out.lost; ++n) {
    if (n == when.turning) {
      StartTurning(options, rate, plant, command);
      if (!options.run_up) running.JumpTo(w);
    }
    if (n == when.down) command.speed_set_point_rad_per_s = 0.0;
    const SensorFrame frame = plant.Sample();
    const double still =
        n < when.lift ? 1.0 - static_cast<double>(n) / static_cast<double>(when.lift) : 0.0;
    const AxisArray error_m = ErrorOf(rig.numbers, axes, still, resting_m, frame.position_m);
    const law::LawOutput given =
        running.Step(frame.speed_rad_per_s, error_m, {}, law.current_limit_a);
    for (std::size_t i = 0; i < axes; ++i)
      command.control_current_a[i] = rig.numbers.actuator_polarity[i] * given.control_current_a[i];
    const AxisArray y = plant.SensorOutput();
    const bool watched = n >= when.settle;
    WatchOrbits(rig.numbers, axes, y, n >= when.turning, watched, out);
    if (watched) {
      WatchCurrents(given, plant.angle_rad(), watch);
      if (options.keep_orbit && n + when.kept >= when.all) out.positions_m.push_back(y);
    }
    plant.Advance(command);
    out.lost = out.lost || (n >= when.turning && plant.ContactForce() > 0.0) || !plant.finite();
  }
  TakeMeans(watch, w > 0.0, out);
  return out;
}

}  // namespace levitas::design
