#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "common/rotational_speed.hpp"
#include "verdict/report.hpp"

namespace levitas::verdict {
namespace {

// Ordered: the file reads in the order of the table.
using Object = nlohmann::ordered_json;

/// JSON knows no infinity: a figure that is not finite is written as null.
Object Number(double value) { return std::isfinite(value) ? Object(value) : Object(nullptr); }

Object Orbits(const Verdict& verdict) {
  Object all = Object::array();
  for (const OrbitJudgement& at : verdict.orbits) {
    all.push_back({{"bearing", at.bearing},
                   {"phase", at.spinning ? "spinning" : "standing"},
                   {"max_m", Number(at.orbit.max_m)},
                   {"max_at_speed_rpm", RadPerSToRpm(at.orbit.max_speed_rad_per_s)},
                   {"max_at_time_s", at.orbit.max_time_s},
                   {"rms_m", Number(at.orbit.rms_m)},
                   {"offset_x_m", Number(at.orbit.offset_x_m)},
                   {"offset_y_m", Number(at.orbit.offset_y_m)},
                   {"objective_m", at.objective_m},
                   {"objective_met", at.met},
                   {"clearance_share", Number(at.clearance_share)},
                   {"clearance_zone", std::string(1, Letter(at.zone))}});
  }
  return all;
}

void AddCurrents(const Inputs& in, const PhaseFigures& phase, const char* name, Object& all) {
  if (phase.cycles == 0) return;
  for (std::size_t axis = 0; axis < in.rig.axes(); ++axis) {
    const CurrentFigures& current = phase.bearings[axis / 2].current[axis % 2];
    all.push_back({{"axis", in.rig.channels.at(axis)},
                   {"phase", name},
                   {"mean_a", Number(current.mean_a)},
                   {"rms_about_mean_a", Number(current.dynamic_rms_a)},
                   {"peak_a", Number(current.peak_a)},
                   {"saturated_share", current.saturated_share}});
  }
}

Object Range(const SpeedRange& range) {
  return {{"shown_rpm", RadPerSToRpm(range.shown_rad_per_s)},
          {"rated_rpm", RadPerSToRpm(range.rated_rad_per_s)},
          {"shown_share", range.Share()},
          {"whole", range.Whole()},
          {"text", Text(range)}};
}

Object Length(const PhaseFigures& phase) {
  return {{"cycles", phase.cycles},
          {"duration_s", phase.duration_s},
          {"saturated_share", phase.saturated_share}};
}

Object Profile(const Inputs& in) {
  Object all = Object::array();
  for (const ProfileBin& bin : in.session.profile) {
    Object row{{"speed_rpm", RadPerSToRpm(bin.speed_rad_per_s)}, {"cycles", bin.cycles}};
    for (std::size_t b = 0; b < bin.max_m.size(); ++b) {
      row["max_m"][in.rig.bearings.at(b)] = Number(bin.max_m[b]);
    }
    all.push_back(row);
  }
  return all;
}

void AddMeasured(const Inputs& in, Object& all) {
  if (!in.measured) return;
  for (const MeasuredSpeed& at : in.measured->speeds) {
    Object axes = Object::array();
    for (const MeasuredAxis& axis : at.axes) {
      axes.push_back(
          {{"axis", axis.channel},
           {"peak", Number(axis.peak)},
           {"sigma", Number(axis.sigma)},
           {"largest_line", Number(axis.line_peak)},
           {"frequency_hz", axis.frequency_hz},
           {"zone", axis.zone ? Object(std::string(1, Letter(*axis.zone))) : Object(nullptr)},
           {"not_graded", axis.refused},
           {"computed_peak", Number(axis.computed_peak)},
           {"more_than_20_percent_apart", axis.differs}});
    }
    all.push_back(
        {{"speed_rpm", RadPerSToRpm(at.speed_rad_per_s)}, {"source", "measured"}, {"axes", axes}});
  }
}

Object Sensitivity(const Inputs& in) {
  Object all = Object::array();
  for (std::size_t speed = 0; speed < in.sensitivity.size(); ++speed) {
    const auto& result = in.sensitivity[speed];
    Object axes = Object::array();
    for (std::size_t i = 0; i < result.axes.size(); ++i) {
      const analysis::AxisSensitivity& axis = result.axes[i];
      axes.push_back(
          {{"axis", in.rig.channels.at(i)},
           {"peak", Number(axis.peak)},
           {"frequency_hz", axis.frequency_hz},
           {"zone", axis.zone ? Object(std::string(1, Letter(*axis.zone))) : Object(nullptr)}});
    }
    all.push_back({{"speed_rpm", RadPerSToRpm(result.speed_rad_per_s)},
                   {"source", "computed"},
                   {"worst_of_all_speeds", speed == in.worst_sensitivity},
                   {"stable", result.stable},
                   {"largest_pole_modulus", Number(result.largest_pole_modulus)},
                   {"largest_singular_value", Number(result.largest_singular_value)},
                   {"axes", axes}});
  }
  AddMeasured(in, all);
  return all;
}

Object Modes(const Inputs& in) {
  Object all = Object::array();
  for (const ModeSpan& span : in.session.modes) {
    all.push_back(
        {{"mode", Name(span.mode)}, {"start_s", span.start_s}, {"duration_s", span.duration_s}});
  }
  return all;
}

Object Trip(const Inputs& in) {
  if (!in.session.trip) return nullptr;
  const TripFigures& trip = *in.session.trip;
  const auto axis = static_cast<std::size_t>(trip.axis);
  const bool named = trip.axis >= 0 && axis < in.rig.channels.size();
  return {{"fault", Name(trip.fault)},
          {"axis", named ? Object(in.rig.channels[axis]) : Object(nullptr)},
          {"value_si", Number(trip.value)},
          {"limit_si", Number(trip.limit)},
          {"time_s", trip.time_s},
          {"mode_before", Name(trip.mode_before)},
          {"speed_rpm", RadPerSToRpm(trip.speed_rad_per_s)},
          {"text", in.trip_text},
          {"file", in.provenance.trip_file},
          {"count", in.session.trips}};
}

Object Release(const Inputs& in) {
  if (!in.session.release) return nullptr;
  const ReleaseFigures& release = *in.session.release;
  return {{"time_s", release.time_s}, {"speed_rpm", Number(RadPerSToRpm(release.speed_rad_per_s))}};
}

Object Duration(const DurationFigures& row) {
  return {{"count", row.count},
          {"p50_ns", row.p50_ns},
          {"p99_ns", row.p99_ns},
          {"p999_ns", row.p999_ns},
          {"max_ns", row.max_ns}};
}

Object Timing(const Inputs& in) {
  const SessionFigures& session = in.session;
  Object timing{{"pace", in.provenance.pace},
                {"cycles", session.cycles},
                {"rig_time_s", session.duration_s},
                {"skipped_periods", session.skipped_periods},
                {"missing_frames", session.missing_frames},
                {"held_currents", session.held_currents},
                {"missing_records", session.missing_records}};
  if (in.rig_process) {
    timing["rig_process"] = {{"cycles", in.rig_process->cycles},
                             {"held_currents", in.rig_process->held_currents},
                             {"lost_messages", in.rig_process->lost_messages},
                             {"watchdog_trips", in.rig_process->watchdog_trips},
                             {"advance", Duration(in.rig_process->advance)}};
  }
  if (!in.timing) return timing;
  const TimingFigures& told = *in.timing;
  timing["wall_s"] = told.wall_s;
  timing["cycles_per_s"] = told.cycles_per_s;
  timing["times_real_time"] = told.times_real_time;
  timing["blamed_stage"] = told.blamed_stage;
  timing["lost_records"] = told.lost_records;
  timing["lost_messages"] = told.lost_messages;
  timing["rejected_frames"] = told.rejected_frames;
  timing["real_time"] = told.real_time;
  if (told.delay) {
    timing["delay"] = {{"expected_periods", told.delay->expected_periods},
                       {"acting",
                        {{"count", told.delay->count},
                         {"least_periods", told.delay->least_periods},
                         {"median_periods", told.delay->median_periods},
                         {"most_periods", told.delay->most_periods}}},
                       {"objection", told.delay->objection}};
  }
  for (const DurationFigures& row : told.durations) timing["durations"][row.name] = Duration(row);
  return timing;
}

Object Bias(const PhaseFigures& phase) {
  if (phase.cycles == 0) return nullptr;
  return {{"mean_bias_current_a", Number(phase.mean_bias_a)},
          {"copper_share", Number(phase.copper_share)}};
}

Object Reserve(const Inputs& in) {
  Object current = nullptr;
  if (const auto used = CurrentUse(in.rig, in.session)) {
    current = {{"axis", used->axis},
               {"phase", used->spinning ? "spinning" : "standing"},
               {"peak_a", Number(used->peak_a)},
               {"limit_a", used->limit_a},
               {"used_share", Number(used->share)}};
  }
  Object noise = Object::array();
  const bool stood = in.session.standing.cycles > 0;
  const PhaseFigures& phase = stood ? in.session.standing : in.session.spinning;
  for (std::size_t b = 0; b < std::min(in.probe_noise_m.size(), phase.bearings.size()); ++b) {
    const double orbit_m = phase.bearings[b].orbit.rms_m;
    noise.push_back({{"bearing", phase.bearings[b].name},
                     {"phase", stood ? "standing" : "spinning"},
                     {"noise_rms_m", in.probe_noise_m[b]},
                     {"orbit_rms_m", Number(orbit_m)},
                     {"noise_share", Number(in.probe_noise_m[b] / orbit_m)}});
  }
  Object damping = nullptr;
  if (in.damping) {
    damping = {{"damping_ratio", in.damping->damping_ratio},
               {"frequency_hz", in.damping->frequency_hz},
               {"speed_rpm", RadPerSToRpm(in.damping->speed_rad_per_s)}};
  }
  Object modes = Object::array();
  for (const ModeDamping& mode : in.modes) {
    modes.push_back({{"at_rest_hz", mode.at_rest_hz},
                     {"damping_ratio", mode.least.damping_ratio},
                     {"frequency_hz", mode.least.frequency_hz},
                     {"speed_rpm", RadPerSToRpm(mode.least.speed_rad_per_s)}});
  }
  return {
      {"current", current},
      {"probe_noise", noise},
      {"least_damping", damping},
      {"modes", modes},
      {"bias", {{"standing", Bias(in.session.standing)}, {"spinning", Bias(in.session.spinning)}}}};
}

Object Blocks(const Inputs& in) {
  Object blocks = Object::array();
  for (const BlockUse& block : in.blocks) {
    blocks.push_back(
        {{"name", block.name},
         {"acted_s", block.acted_s},
         {"times", block.times},
         {"angle", block.angle.empty() ? "measured" : block.angle},
         {"ended_because", block.last_end},
         {"failures", block.failures},
         {"failed_because", block.last_failure},
         {"ended_at_s", block.last_end.empty() ? Object(nullptr) : Object(block.last_end_s)}});
  }
  return blocks;
}

Object Jumps(const Inputs& in) {
  Object jumps = Object::array();
  for (const ProbeJump& jump : in.probe_jumps) {
    jumps.push_back({{"axis", jump.channel},
                     {"time_s", jump.time_s},
                     {"step_m", jump.step_m},
                     {"current_a", jump.current_a},
                     {"moved_m", jump.moved_m ? Object(*jump.moved_m) : Object(nullptr)},
                     {"touches", !jump.moved_m.has_value()},
                     {"returns", jump.returns}});
  }
  return jumps;
}

Object Torsion(const Inputs& in) {
  Object loads = Object::array();
  for (const CouplingLoad& load : in.torsion) {
    loads.push_back({{"coupling", load.coupling},
                     {"torque_rms_n_m", Number(load.torque_rms_n_m)},
                     {"torque_peak_n_m", Number(load.torque_peak_n_m)},
                     {"peak_time_s", load.peak_time_s},
                     {"peak_speed_rpm", RadPerSToRpm(load.peak_speed_rad_per_s)},
                     {"twist_peak_rad", Number(load.twist_peak_rad)}});
  }
  return loads;
}

Object TimeStep(const Inputs& in) {
  if (!in.step_error) return nullptr;
  const analysis::StepError& error = *in.step_error;
  return {{"substeps", error.substeps},
          {"step_s", in.rig.period_s() / error.substeps},
          {"compared_with_substeps", error.compared_with},
          {"simulated_s", error.duration_s},
          {"speed_rpm", RadPerSToRpm(error.speed_rad_per_s)},
          {"largest_difference_m", Number(error.largest_m)},
          {"peak_m", Number(error.peak_m)},
          {"share_of_peak", Number(error.Share())}};
}

Object From(const Provenance& from) {
  return {{"program_version", from.program_version},
          {"rig", from.rig},
          {"controller", from.controller},
          {"scenario", from.scenario},
          {"rig_file", from.rig_file},
          {"controller_file", from.controller_file},
          {"scenario_file", from.scenario_file},
          {"session_file", from.session_file},
          {"pace", from.pace},
          {"port", from.port},
          {"seed", from.seed},
          {"start_utc_ns", from.start_utc_ns},
          {"machine", from.machine}};
}

}  // namespace

nlohmann::ordered_json Json(const Verdict& verdict) {
  const Inputs& in = verdict.inputs;
  Object currents = Object::array();
  AddCurrents(in, in.session.standing, "standing", currents);
  AddCurrents(in, in.session.spinning, "spinning", currents);
  return {{"verdict", Name(verdict.outcome)},
          {"sentence", verdict.sentence},
          {"objections", verdict.objections},
          {"warnings", verdict.warnings},
          {"provenance", From(in.provenance)},
          {"clearance_m", in.rig.clearance_m},
          {"top_speed_rpm", RadPerSToRpm(in.session.top_speed_rad_per_s)},
          {"speed_range", Range(verdict.range)},
          {"standing", Length(in.session.standing)},
          {"spinning", Length(in.session.spinning)},
          {"orbits", Orbits(verdict)},
          {"currents", currents},
          {"sensitivity", Sensitivity(in)},
          {"sensitivity_not_measured", in.measured ? in.measured->why_not : "no test signal"},
          {"reserve", Reserve(in)},
          {"synchronous_blocks", Blocks(in)},
          {"probe_jumps", Jumps(in)},
          {"torsion", Torsion(in)},
          {"time_step", TimeStep(in)},
          {"orbit_over_speed", Profile(in)},
          {"modes", Modes(in)},
          {"trip", Trip(in)},
          {"released_at_speed", Release(in)},
          {"timing", Timing(in)},
          {"damage", in.damage}};
}

}  // namespace levitas::verdict
