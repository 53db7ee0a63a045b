#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/speed_sweep.hpp"
#include "common/rotational_speed.hpp"
#include "verdict/report.hpp"

namespace levitas::verdict {
namespace {

using Out = std::back_insert_iterator<std::string>;

double Um(double length_m) { return length_m * 1e6; }

std::string_view PhaseName(bool spinning) { return spinning ? "spinning" : "standing"; }

/// A duration with the unit that leaves one to three digits before the point.
std::string Duration(double duration_ns) {
  if (duration_ns < 1e3) return fmt::format("{:.0f} ns", duration_ns);
  if (duration_ns < 1e6) return fmt::format("{:.1f} us", duration_ns * 1e-3);
  return fmt::format("{:.1f} ms", duration_ns * 1e-6);
}

/// Of the first column: the usual ten, or what the longest name needs with a blank behind it.
std::size_t NameWidth(const std::vector<std::string>& names) {
  std::size_t width = 10;
  for (const std::string& name : names) width = std::max(width, name.size() + 1);
  return width;
}

void Heading(const Verdict& verdict, Out out) {
  const Provenance& from = verdict.inputs.provenance;
  fmt::format_to(out, "Verdict on rig {}, controller {}, scenario {} ({}, seed {})\n", from.rig,
                 from.controller, from.scenario.empty() ? "none" : from.scenario, from.pace,
                 from.seed);
  if (!verdict.inputs.damage.empty()) fmt::format_to(out, "record: {}\n", verdict.inputs.damage);
}

void Orbits(const Verdict& verdict, Out out) {
  if (verdict.orbits.empty()) return;
  const std::size_t width = NameWidth(verdict.inputs.rig.bearings);
  fmt::format_to(out, "\n{:<{}}{:<10}{:>7}{:>8}{:>10}{:>10} {:<5}{:>13}{:>5}{:>21}\n", "orbit",
                 width, "phase", "max um", "rms um", "offset um", "limit um", "", "of clearance",
                 "zone", "worst at");
  for (const OrbitJudgement& at : verdict.orbits) {
    const std::string where =
        at.spinning ? fmt::format("{:.0f} rpm, {:.2f} s",
                                  RadPerSToRpm(at.orbit.max_speed_rad_per_s), at.orbit.max_time_s)
                    : fmt::format("{:.2f} s", at.orbit.max_time_s);
    fmt::format_to(
        out, "{:<{}}{:<10}{:>7.2f}{:>8.2f}{:>10.2f}{:>10.1f} {:<5}{:>13.3f}{:>5}{:>21}\n",
        at.bearing, width, PhaseName(at.spinning), Um(at.orbit.max_m), Um(at.orbit.rms_m),
        Um(std::hypot(at.orbit.offset_x_m, at.orbit.offset_y_m)), Um(at.objective_m),
        at.met ? "ok" : "FAIL", at.clearance_share, Letter(at.zone), where);
  }
}

void Range(const Verdict& verdict, Out out) {
  const SpeedRange& range = verdict.range;
  if (verdict.orbits.empty() || !range.turns || !(range.rated_rad_per_s > 0.0)) return;
  const std::string share =
      range.Whole() ? "" : fmt::format(", {:.0f} % of the rated speed", 100.0 * range.Share());
  fmt::format_to(out, "\nspeed     levitated {}{}\n", Text(range), share);
}

void CurrentsOf(const Inputs& in, const PhaseFigures& phase, bool spinning, Out out) {
  if (phase.cycles == 0) return;
  for (std::size_t b = 0; b < phase.bearings.size(); ++b) {
    for (std::size_t k = 0; k < 2 && 2 * b + k < in.rig.axes(); ++k) {
      const CurrentFigures& current = phase.bearings[b].current[k];
      fmt::format_to(out, "{:<{}}{:<10}{:>9.4f}{:>17.4f}{:>9.4f}{:>18.2f} %\n",
                     in.rig.channels[2 * b + k], NameWidth(in.rig.channels), PhaseName(spinning),
                     current.mean_a, current.dynamic_rms_a, current.peak_a,
                     100.0 * current.saturated_share);
    }
  }
}

void Currents(const Inputs& in, Out out) {
  if (in.session.standing.cycles + in.session.spinning.cycles == 0) return;
  fmt::format_to(out, "\n{:<{}}{:<10}{:>9}{:>17}{:>9}{:>20}\n", "current",
                 NameWidth(in.rig.channels), "phase", "static A", "rms about mean A", "peak A",
                 "cycles saturated");
  CurrentsOf(in, in.session.standing, false, out);
  CurrentsOf(in, in.session.spinning, true, out);
}

void WorstSensitivity(const Inputs& in, Out out) {
  if (in.sensitivity.size() < 2 || in.worst_sensitivity >= in.sensitivity.size()) return;
  const analysis::SensitivityResult& worst = in.sensitivity[in.worst_sensitivity];
  if (worst.axes.empty()) return;
  const std::size_t axis = analysis::WorstAxis(worst);
  fmt::format_to(out, "worst from {:.0f} to {:.0f} rpm, computed: {} with {:.2f} at {:.0f} rpm\n",
                 RadPerSToRpm(in.sensitivity.front().speed_rad_per_s),
                 RadPerSToRpm(in.sensitivity.back().speed_rad_per_s), in.rig.channels.at(axis),
                 worst.axes[axis].peak, RadPerSToRpm(worst.speed_rad_per_s));
}

void MeasuredRows(const Inputs& in, Out out) {
  if (!in.measured) return;
  for (const MeasuredSpeed& at : in.measured->speeds) {
    for (const MeasuredAxis& axis : at.axes) {
      const std::string zone = axis.zone ? std::string(1, Letter(*axis.zone)) : "none";
      fmt::format_to(
          out,
          "{:<{}}{:>10.0f}{:>9.3f}{:>9.1f}   {:<16}measured, sigma {:.3f}, single line {:.3f}{}\n",
          axis.channel, NameWidth(in.rig.channels), RadPerSToRpm(at.speed_rad_per_s), axis.peak,
          axis.frequency_hz, zone, axis.sigma, axis.line_peak,
          axis.refused.empty() ? "" : ": " + axis.refused);
    }
  }
  if (!in.measured->why_not.empty()) {
    fmt::format_to(out, "not measured although there were test signals: {}\n",
                   in.measured->why_not);
  }
}

void Sensitivity(const Inputs& in, Out out) {
  if (in.sensitivity.empty()) return;
  fmt::format_to(out, "\n{:<{}}{:>10}{:>9}{:>9}   {:<16}{}\n", "peak |S|",
                 NameWidth(in.rig.channels), "speed rpm", "peak", "at Hz", "zone", "from");
  for (const auto& result : in.sensitivity) {
    for (std::size_t i = 0; i < result.axes.size(); ++i) {
      const analysis::AxisSensitivity& axis = result.axes[i];
      const std::string zone = axis.zone ? std::string(1, Letter(*axis.zone)) : "none: unstable";
      fmt::format_to(out, "{:<{}}{:>10.0f}{:>9.3f}{:>9.1f}   {:<16}computed\n",
                     in.rig.channels.at(i), NameWidth(in.rig.channels),
                     RadPerSToRpm(result.speed_rad_per_s), axis.peak, axis.frequency_hz, zone);
    }
  }
  MeasuredRows(in, out);
  WorstSensitivity(in, out);
}

/// Of a controller that may lower the bias, or a record in which it moved.
void Bias(const Inputs& in, Out out) {
  for (const bool spinning : {false, true}) {
    const PhaseFigures& phase = spinning ? in.session.spinning : in.session.standing;
    constexpr double kStayed = 1e-6;  // of the rig's
    const double rig_a = in.rig.bias_current_a;
    const bool known = phase.cycles > 0 && phase.mean_bias_a > 0.0;
    if (!known) continue;
    if (std::abs(phase.mean_bias_a - rig_a) <= kStayed * rig_a) {
      if (!in.saves_bias) continue;
      fmt::format_to(out,
                     "          bias {}: {:.3f} A throughout, nothing saved: too short, or "
                     "current, orbit or speed asked for all of it\n",
                     PhaseName(spinning), rig_a);
      continue;
    }
    fmt::format_to(out,
                   "          bias {}: {:.3f} of {:.3f} A in the mean, copper losses {:.1f} % of "
                   "the whole\n",
                   PhaseName(spinning), phase.mean_bias_a, rig_a, 100.0 * phase.copper_share);
  }
}

/// What a block did, without its name.
std::string Deeds(const BlockUse& block) {
  if (block.times == 0)
    return "never acted: its speed, a good angle or a levitated rotor was wanting";
  std::string text = fmt::format("acted {:.2f} s", block.acted_s);
  if (block.times > 1) text += fmt::format(" in {} times", block.times);
  text += block.last_end.empty()
              ? ", to the end of the record"
              : fmt::format(", ended at {:.2f} s: {}", block.last_end_s, block.last_end);
  const bool told = block.failures == 1 && block.last_failure == block.last_end;
  if (block.failures > 0 && !told) {
    text += block.failures == 1
                ? "; given up once: "
                : fmt::format("; given up {} times, the last one: ", block.failures);
    text += block.last_failure;
  }
  if (!block.angle.empty()) text += "; " + block.angle;
  return text;
}

void Blocks(const Inputs& in, Out out) {
  for (const BlockUse& block : in.blocks) {
    fmt::format_to(out, "{}{}: {}\n", &block == &in.blocks.front() ? "\nblocks    " : "          ",
                   block.name, Deeds(block));
  }
}

/// Those that a resonance can excite up to the frequency of a tenth of the sampling.
void Modes(const Inputs& in, Out out) {
  constexpr std::size_t kInALine = 4;
  const double up_to_hz = 0.1 / in.rig.period_s();
  std::size_t told = 0;
  for (const ModeDamping& mode : in.modes) {
    if (mode.at_rest_hz > up_to_hz) break;
    const char* begins = told == 0 ? "          each mode's, with its frequency at rest: "
                         : told % kInALine == 0 ? ",\n          "
                                                : ", ";
    fmt::format_to(out, "{}{:.0f} Hz {:.4f}", begins, mode.at_rest_hz, mode.least.damping_ratio);
    ++told;
  }
  if (told > 0) fmt::format_to(out, "\n");
}

void Reserve(const Inputs& in, Out out) {
  const auto used = CurrentUse(in.rig, in.session);
  if (!used) return;
  fmt::format_to(out,
                 "\nreserve   {:.0f} % of the control current was used at most: {} {}, {:.3f} of "
                 "{:.3f} A\n",
                 100.0 * used->share, used->axis, PhaseName(used->spinning), used->peak_a,
                 used->limit_a);
  const bool stood = in.session.standing.cycles > 0;
  const PhaseFigures& phase = stood ? in.session.standing : in.session.spinning;
  for (std::size_t b = 0; b < std::min(in.probe_noise_m.size(), phase.bearings.size()); ++b) {
    fmt::format_to(out,
                   "          noise of the probes of {}: {:.2f} um rms, {:.2f} um the orbit {}\n",
                   phase.bearings[b].name, Um(in.probe_noise_m[b]),
                   Um(phase.bearings[b].orbit.rms_m), PhaseName(!stood));
  }
  if (in.damping) {
    fmt::format_to(out,
                   "          least damping ratio, computed: {:.4f} at {:.1f} Hz and {:.0f} rpm\n",
                   in.damping->damping_ratio, in.damping->frequency_hz,
                   RadPerSToRpm(in.damping->speed_rad_per_s));
  }
  Modes(in, out);
  double largest = 0.0;
  for (const auto& at : in.sensitivity) largest = std::max(largest, at.largest_singular_value);
  if (largest > 0.0) {
    fmt::format_to(out, "          largest singular value of S, computed: {:.2f}\n", largest);
  }
  Bias(in, out);
}

void Torsion(const Inputs& in, Out out) {
  for (const CouplingLoad& load : in.torsion) {
    fmt::format_to(out,
                   "torsion   {}: torque beside the mean load {:.3g} N m rms, at most {:.3g} N m "
                   "at {:.3f} s and {:.0f} rpm; twist at most {:.0f} urad\n",
                   load.coupling, load.torque_rms_n_m, load.torque_peak_n_m, load.peak_time_s,
                   RadPerSToRpm(load.peak_speed_rad_per_s), 1e6 * load.twist_peak_rad);
  }
}

void TimeStep(const Inputs& in, Out out) {
  if (!in.step_error) return;
  const analysis::StepError& error = *in.step_error;
  fmt::format_to(
      out,
      "\ntime step {} of {:.3g} us a period; in a release from a tenth of the clearance, the "
      "weight not carried yet (peak {:.1f} um), {} of them change {:.2g} % of the peak\n",
      error.substeps, in.rig.period_s() * 1e6 / error.substeps, Um(error.peak_m),
      error.compared_with, 100.0 * error.Share());
}

void DurationRow(const DurationFigures& row, Out out) {
  if (row.count == 0) return;
  fmt::format_to(out, "{:<14}{:>12}{:>12}{:>12}{:>12}\n", row.name, Duration(row.p50_ns),
                 Duration(row.p99_ns), Duration(row.p999_ns), Duration(row.max_ns));
}

void Durations(const TimingFigures& timing, const std::optional<RigFigures>& rig, Out out) {
  if (timing.durations.empty()) return;
  fmt::format_to(out, "{:<14}{:>12}{:>12}{:>12}{:>12}\n", "duration", "p50", "p99", "p99.9", "max");
  for (const DurationFigures& row : timing.durations) DurationRow(row, out);
  if (rig) DurationRow(rig->advance, out);
}

/// A text of several lines, each behind the heading's column.
void Indented(const std::string& text, Out out) {
  std::size_t from = 0;
  while (from < text.size()) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    fmt::format_to(out, "{:<10}{}\n", from == 0 ? "machine" : "", text.substr(from, end - from));
    from = end + 1;
  }
}

void Losses(const Inputs& in, Out out) {
  const SessionFigures& session = in.session;
  const std::uint64_t messages = (in.timing ? in.timing->lost_messages : 0) +
                                 (in.rig_process ? in.rig_process->lost_messages : 0);
  const std::string before =
      fmt::format("losses    {} periods skipped, {} frames missing, {} currents late,",
                  session.skipped_periods, session.missing_frames, session.held_currents);
  const std::string after =
      fmt::format("{} messages lost, {} records lost", messages, session.missing_records);
  constexpr std::size_t kColumns = 100;
  const bool fits = before.size() + 1 + after.size() <= kColumns;
  fmt::format_to(out, "{}{}{}\n", before, fits ? " " : "\n          ", after);
  if (session.skipped_periods > 0 && in.timing && !in.timing->blamed_stage.empty()) {
    fmt::format_to(out, "          most overruns are due to the stage: {}\n",
                   in.timing->blamed_stage);
  }
}

void Delay(const DelayFigures& delay, Out out) {
  if (delay.count == 0) return;
  fmt::format_to(out,
                 "delay     from sample to current {:.2f} / {:.2f} / {:.2f} periods measured "
                 "(least, median, most), {:.2f} taken for margins\n",
                 delay.least_periods, delay.median_periods, delay.most_periods,
                 delay.expected_periods);
  if (!delay.objection.empty()) fmt::format_to(out, "          {}\n", delay.objection);
}

void Timing(const Inputs& in, Out out) {
  const SessionFigures& session = in.session;
  fmt::format_to(out, "\ntiming    {} cycles, {:.2f} s of the rig's time", session.cycles,
                 session.duration_s);
  if (in.timing && in.timing->wall_s > 0.0) {
    fmt::format_to(out, " in {:.2f} s: {:.0f} cycles/s, {:.2f} x real time", in.timing->wall_s,
                   in.timing->cycles_per_s, in.timing->times_real_time);
  }
  fmt::format_to(out, "\n");
  Losses(in, out);
  if (in.timing) {
    if (in.timing->delay) Delay(*in.timing->delay, out);
    Indented(in.timing->real_time, out);
    Durations(*in.timing, in.rig_process, out);
  }
}

}  // namespace

std::string Table(const Verdict& verdict) {
  std::string text;
  const Out out = std::back_inserter(text);
  Heading(verdict, out);
  Range(verdict, out);
  Orbits(verdict, out);
  Currents(verdict.inputs, out);
  Sensitivity(verdict.inputs, out);
  Reserve(verdict.inputs, out);
  Blocks(verdict.inputs, out);
  Torsion(verdict.inputs, out);
  TimeStep(verdict.inputs, out);
  Timing(verdict.inputs, out);
  if (!verdict.warnings.empty()) fmt::format_to(out, "\n");
  for (const std::string& warning : verdict.warnings) {
    fmt::format_to(out, "WARNING: {}\n", warning);
  }
  if (verdict.inputs.measured) {
    fmt::format_to(out,
                   "\nThe run held test signals, which is no normal use; its orbits are judged as "
                   "if it were.\n");
  }
  fmt::format_to(out, "\n{}\n", verdict.sentence);
  return text;
}

}  // namespace levitas::verdict
