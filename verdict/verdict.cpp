#include "verdict/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/rotational_speed.hpp"

namespace levitas::verdict {
namespace {

constexpr std::array<std::string_view, 4> kOutcomes{"accepted", "not_accepted", "tripped",
                                                    "incomplete"};

double Micrometres(double length_m) { return length_m * 1e6; }

void JudgePhase(const RigNumbers& rig, const PhaseFigures& phase, bool spinning,
                std::vector<OrbitJudgement>& orbits) {
  if (phase.cycles == 0) return;
  const double objective_m =
      spinning ? rig.spinning_orbit_objective_m : rig.standing_orbit_objective_m;
  for (std::size_t b = 0; b < phase.bearings.size(); ++b) {
    const BearingFigures& bearing = phase.bearings[b];
    const double share = bearing.orbit.max_m / rig.ClearanceOf(b);
    orbits.push_back({bearing.name, spinning, bearing.orbit, objective_m, share,
                      ClearanceZone(share), bearing.orbit.max_m < objective_m});
  }
}

/// What a run is not accepted for. Peaks of |S| of one kind are one fault seen at several speeds
/// and axes: the sentence names the largest.
struct Objection {
  enum class Kind : std::uint8_t { kOther, kComputedPeak, kMeasuredPeak } kind{};
  double peak{};
  std::string text;
};

void AddObjection(std::string text, std::vector<Objection>& objections) {
  objections.push_back({Objection::Kind::kOther, 0.0, std::move(text)});
}

/// The sentence of them all. Each by itself is in Verdict::objections.
std::string Summed(const std::vector<Objection>& objections) {
  std::vector<std::string> said;
  for (const Objection& one : objections) {
    const auto same = [&one](const Objection& other) { return other.kind == one.kind; };
    const auto count = std::ranges::count_if(objections, same);
    if (one.kind == Objection::Kind::kOther || count == 1) {
      said.push_back(one.text);
      continue;
    }
    const auto largest =
        std::ranges::max_element(objections, [&one](const Objection& a, const Objection& b) {
          return (a.kind == one.kind ? a.peak : -1.0) < (b.kind == one.kind ? b.peak : -1.0);
        });
    if (&*largest != &one) continue;
    said.push_back(fmt::format("{} (the largest of {} such peaks)", one.text, count));
  }
  return fmt::format("{}", fmt::join(said, "; "));
}

std::string While(bool spinning) { return spinning ? "while spinning" : "while standing"; }

void ObjectToOrbit(const OrbitJudgement& at, std::vector<Objection>& objections) {
  const std::string where =
      at.spinning ? fmt::format(" at {:.0f} rpm", RadPerSToRpm(at.orbit.max_speed_rad_per_s)) : "";
  if (!at.met) {
    AddObjection(fmt::format("{} orbit {:.1f} um {} exceeds {:.1f} um{}", at.bearing,
                             Micrometres(at.orbit.max_m), While(at.spinning),
                             Micrometres(at.objective_m), where),
                 objections);
  }
  if (!Acceptable(at.zone)) {
    AddObjection(fmt::format("{} displacement of {:.2f} clearances {} is zone {}{}", at.bearing,
                             at.clearance_share, While(at.spinning), Letter(at.zone), where),
                 objections);
  }
}

void ObjectToComputed(const analysis::SensitivityResult& result, const Inputs& in,
                      std::vector<Objection>& objections) {
  const RigNumbers& rig = in.rig;
  const double speed_rpm = RadPerSToRpm(result.speed_rad_per_s);
  if (!result.point.failure.empty()) {
    AddObjection(fmt::format("{} (at {:.0f} rpm)", result.point.failure, speed_rpm), objections);
    return;
  }
  if (!result.stable) {
    AddObjection(fmt::format("the linear loop is unstable at {:.0f} rpm", speed_rpm), objections);
    return;
  }
  for (std::size_t i = 0; i < result.axes.size(); ++i) {
    const analysis::AxisSensitivity& axis = result.axes[i];
    if (axis.zone && Acceptable(*axis.zone)) continue;
    if (in.measured && FindGraded(*in.measured, rig.channels.at(i), result.speed_rad_per_s)) {
      continue;
    }
    objections.push_back(
        {Objection::Kind::kComputedPeak, axis.peak,
         fmt::format("computed sensitivity peak of {} is {:.2f} at {:.0f} rpm{}",
                     rig.channels.at(i), axis.peak, speed_rpm,
                     axis.zone ? fmt::format(", zone {}", Letter(*axis.zone)) : "")});
  }
}

void JudgeMeasured(const MeasuredSpeed& at, Verdict& verdict, std::vector<Objection>& objections) {
  const double speed_rpm = RadPerSToRpm(at.speed_rad_per_s);
  for (const MeasuredAxis& axis : at.axes) {
    if (axis.zone && !Acceptable(*axis.zone)) {
      objections.push_back({Objection::Kind::kMeasuredPeak, axis.peak,
                            fmt::format("measured sensitivity peak of {} is {:.2f} at {:.0f} rpm, "
                                        "zone {}",
                                        axis.channel, axis.peak, speed_rpm, Letter(*axis.zone))});
    }
    if (!axis.differs) continue;
    verdict.warnings.push_back(fmt::format(
        "sensitivity peak of {} at {:.0f} rpm: measured {:.2f}, computed {:.2f}, {:.0f} % apart: "
        "the rig file or the controller file is probably not what runs",
        axis.channel, speed_rpm, axis.peak, axis.computed_peak,
        100.0 * std::abs(axis.computed_peak - axis.peak) / axis.peak));
  }
}

std::string TripSentence(const Inputs& in) {
  const TripFigures& trip = *in.session.trip;
  std::string what = in.trip_text;
  if (what.empty()) {
    const auto axis = static_cast<std::size_t>(std::max(trip.axis, 0));
    const bool named = trip.axis >= 0 && axis < in.rig.channels.size();
    what = fmt::format("{}{}: {:.4g}, allowed {:.4g}.", Name(trip.fault),
                       named ? " on " + in.rig.channels[axis] : "", trip.value, trip.limit);
  }
  // The recorded sentence begins "TRIP in cycle N: ...".
  const std::string beginning =
      what.starts_with("TRIP ") ? "TRIPPED " + what.substr(5) : "TRIPPED: " + what;
  return fmt::format("{} (It was in mode {} at {:.0f} rpm, {:.3f} s after the start.)", beginning,
                     Name(trip.mode_before), RadPerSToRpm(trip.speed_rad_per_s), trip.time_s);
}

std::string ReleaseSentence(const ReleaseFigures& release) {
  return fmt::format(
      "the amplifiers went off while the rotor turned at {:.0f} rpm, {:.3f} s after "
      "the start",
      RadPerSToRpm(release.speed_rad_per_s), release.time_s);
}

std::string JumpSentence(const ProbeJump& jump) {
  const std::string what =
      fmt::format("the probe of {} jumped {} {:.1f} um at {:.3f} s", jump.channel,
                  jump.returns ? "back by" : "by", Micrometres(jump.step_m), jump.time_s);
  if (!jump.moved_m) {
    return what +
           ": its reading less that is beyond the clearance, so that the rotor lies in its "
           "touchdown bearing";
  }
  return fmt::format(
      "{}: its static current moved by {:.3f} A, as shifting the rotor by {:.1f} um costs", what,
      jump.current_a, Micrometres(std::abs(*jump.moved_m)));
}

/// Of readings that stepped so shortly before a trip that nothing more is known of them.
std::string StepsBefore(const Inputs& in) {
  std::string out;
  for (const ProbeJump& step : in.broken_off_steps) {
    const double before_s = in.session.trip->time_s - step.time_s;
    constexpr double kShortlyS = 0.5;  // the law has answered the step by then
    if (before_s < 0.0 || before_s > kShortlyS) continue;
    out += fmt::format(
        " {:.1f} ms before, the reading of {} stepped by {:.1f} um, further than a rotor moves in "
        "a cycle: look at that probe.",
        1e3 * before_s, step.channel, Micrometres(step.step_m));
  }
  return out;
}

/// "standing 4.1 um (objective 7.0 um)" for the worst bearing of a phase, or that it was not run.
std::string WorstOf(const std::vector<OrbitJudgement>& orbits, bool spinning) {
  const OrbitJudgement* worst = nullptr;
  for (const OrbitJudgement& at : orbits) {
    if (at.spinning != spinning) continue;
    if (worst == nullptr || at.orbit.max_m > worst->orbit.max_m) worst = &at;
  }
  const std::string_view phase = spinning ? "spinning" : "standing";
  if (worst == nullptr) return fmt::format("{} not run", phase);
  return fmt::format("{} {:.1f} um of {:.1f} um allowed (zone {})", phase,
                     Micrometres(worst->orbit.max_m), Micrometres(worst->objective_m),
                     Letter(worst->zone));
}

std::string AcceptedWhere(const SpeedRange& range) {
  const std::string where = Text(range);
  return where.empty() ? "ACCEPTED" : "ACCEPTED " + where;
}

/// Outcome and sentence.
void Conclude(const Inputs& inputs, const std::vector<Objection>& objections, Verdict& verdict) {
  if (inputs.session.trip) {
    verdict.outcome = Outcome::kTripped;
    verdict.sentence = TripSentence(inputs) + StepsBefore(inputs);
    if (inputs.session.release) {
      verdict.sentence += fmt::format(" ({}.)", ReleaseSentence(*inputs.session.release));
    }
  } else if (!inputs.incomplete_reason.empty()) {
    verdict.outcome = Outcome::kIncomplete;
    verdict.sentence = "INCOMPLETE: " + inputs.incomplete_reason;
    if (inputs.session.release) {
      verdict.sentence += "; " + ReleaseSentence(*inputs.session.release);
    }
  } else if (!verdict.objections.empty()) {
    verdict.outcome = Outcome::kNotAccepted;
    verdict.sentence = "NOT ACCEPTED: " + Summed(objections);
  } else {
    verdict.outcome = Outcome::kAccepted;
    verdict.sentence = fmt::format("{}: orbit {}, {}", AcceptedWhere(verdict.range),
                                   WorstOf(verdict.orbits, false), WorstOf(verdict.orbits, true));
  }
}

}  // namespace

std::string_view Name(Outcome outcome) noexcept {
  const auto index = static_cast<std::size_t>(outcome);
  return index < kOutcomes.size() ? kOutcomes[index] : "invalid";
}

Verdict Judge(Inputs inputs) {
  Verdict verdict;
  std::vector<Objection> objections;
  verdict.range = RangeOf(inputs.rig, inputs.session);
  JudgePhase(inputs.rig, inputs.session.standing, false, verdict.orbits);
  JudgePhase(inputs.rig, inputs.session.spinning, true, verdict.orbits);
  if (verdict.orbits.empty()) {
    AddObjection("the rotor was not levitated for longer than the settling time", objections);
  }
  if (inputs.session.release) AddObjection(ReleaseSentence(*inputs.session.release), objections);
  for (const ProbeJump& jump : inputs.probe_jumps) AddObjection(JumpSentence(jump), objections);
  for (const OrbitJudgement& at : verdict.orbits) ObjectToOrbit(at, objections);
  for (const auto& result : inputs.sensitivity) ObjectToComputed(result, inputs, objections);
  if (inputs.measured) {
    for (const MeasuredSpeed& at : inputs.measured->speeds) JudgeMeasured(at, verdict, objections);
  }
  for (const Objection& one : objections) verdict.objections.push_back(one.text);
  if (inputs.timing && inputs.timing->delay && !inputs.timing->delay->objection.empty()) {
    verdict.warnings.push_back(inputs.timing->delay->objection);
  }
  Conclude(inputs, objections, verdict);
  verdict.inputs = std::move(inputs);
  return verdict;
}

}  // namespace levitas::verdict
