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
  constexpr double kAllowedShare = 0.5;
  plant::Plant plant(rig.plant, options.seed);
  plant.RestInTouchdown();
  const AxisArray resting_m = plant.SensorOutput();
  law::RunningLaw running(law);
  const double period_s = rig.numbers.period_s();
  const std::size_t axes = law.axis_count();
  const std::size_t bearings = (axes + 1) / 2;
  const double w = options.speed_rad_per_s;
  const double rate = rig.plant.drive.max_acceleration_rad_per_s2;
  const Schedule when = ScheduleOf(options, period_s, options.run_up ? w / rate : 0.0);
  RunFigures out;
  out.orbit_m.assign(bearings, 0.0);
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
    AxisArray error_m{};
    for (std::size_t i = 0; i < axes; ++i)
      error_m[i] = rig.numbers.sensor_polarity[i] * (still * resting_m[i] - frame.position_m[i]);
    const law::LawOutput given =
        running.Step(frame.speed_rad_per_s, error_m, {}, law.current_limit_a);
    for (std::size_t i = 0; i < axes; ++i)
      command.control_current_a[i] = rig.numbers.actuator_polarity[i] * given.control_current_a[i];
    const AxisArray y = plant.SensorOutput();
    const bool watched = n >= when.settle;
    for (std::size_t b = 0; b < bearings; ++b) {
      const double radius = std::hypot(y[2 * b], 2 * b + 1 < axes ? y[2 * b + 1] : 0.0);
      if (n >= when.turning)
        out.lost = out.lost || !(radius < kAllowedShare * rig.numbers.ClearanceOf(b));
      if (watched) out.orbit_m[b] = std::max(out.orbit_m[b], radius);
    }
    if (watched) {
      ++watch.seen;
      watch.saturated += given.saturated_axes != 0 ? 1 : 0;
      for (std::size_t i = 0; i < axes; ++i) {
        watch.sum[i] += given.control_current_a[i];
        watch.synchronous[i] += given.control_current_a[i] * std::polar(1.0, -plant.angle_rad());
      }
      if (options.keep_orbit && n + when.kept >= when.all) out.positions_m.push_back(y);
    }
    plant.Advance(command);
    out.lost = out.lost || (n >= when.turning && plant.ContactForce() > 0.0) || !plant.finite();
  }
  const double count = std::max<double>(1.0, static_cast<double>(watch.seen));
  out.saturated_share = static_cast<double>(watch.saturated) / count;
  for (std::size_t i = 0; i < axes; ++i) {
    out.static_a.push_back(watch.sum[i] / count);
    out.synchronous_a.push_back(w > 0.0 ? 2.0 * std::abs(watch.synchronous[i]) / count : 0.0);
  }
  return out;
}

}  // namespace levitas::design
