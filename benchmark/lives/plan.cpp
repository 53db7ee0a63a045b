#include "benchmark/lives/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "benchmark/lives/ranges.hpp"
#include "benchmark/lives/signal_plan.hpp"
#include "common/random.hpp"
#include "common/rotational_speed.hpp"

namespace levitas::lives {
namespace {

class Draw {
 public:
  Draw(LifePlan& plan, const RigNumbers& rig) : plan_(plan), rig_(rig), random_(plan.seed) {}

  void All();

 private:
  double Between(double low, double high) const { return ranges_.Between(low, high); }
  double Over(double low, double high) const { return ranges_.Over(low, high); }
  std::size_t One(std::size_t of) const { return ranges_.One(of); }
  bool Coin() const { return ranges_.Coin(); }
  double Seconds() const { return static_cast<double>(plan_.length_ns) * 1e-9; }
  /// An instant with the rotor turning in most lives.
  double WhileTurning() { return Between(2.0, Seconds() - 1.0); }

  void Profile();
  void ProfileAsScenario(double first_rpm, double second_rpm, double rate);
  void Draws(Kind kind);
  void Line(Kind kind);
  void Disorder(Kind kind, LineTrouble t);
  void Add(const LineTrouble& trouble, const std::string& text, std::vector<LineTrouble>& to);
  void Truth(Kind kind);
  void FalseSpeed(Kind kind, double at_s, const std::string& when, Falsehood& f);
  void FalsePosition(Kind kind, const std::string& when, Falsehood& f);
  void Deeds(Kind kind);
  void Commands();
  void Signals();
  LineTrouble Window();
  void Tell(const std::string& text) { plan_.story += (plan_.story.empty() ? "" : "; ") + text; }
  void Do(double at_s, Action action) {
    action.at_ns = Ns(at_s);
    plan_.actions.push_back(action);
  }

  LifePlan& plan_;
  const RigNumbers& rig_;
  Random random_;
  Ranges ranges_{random_};
};

void Draw::Profile() {
  const double rated = RadPerSToRpm(rig_.max_speed_rad_per_s);
  const double most = std::min(RadPerSToRpm(rig_.max_acceleration_rad_per_s2), 1e5);
  const double rate = most * Between(0.4, 1.0);
  const double first_rpm = rated * Between(0.1, 1.0);
  const double second_rpm = One(3) == 0 ? 0.0 : rated * Between(0.05, 1.0);
  plan_.plays_scenario = Coin();
  Tell(fmt::format("{:.0f} then {:.0f} rpm at {:.0f} rpm/s{}", first_rpm, second_rpm, rate,
                   plan_.plays_scenario ? " as a scenario" : ""));
  if (plan_.plays_scenario) return ProfileAsScenario(first_rpm, second_rpm, rate);
  Do(0.1, {.deed = Deed::kCommand, .command = OperatorCommand::kLift});
  const auto spin = [&](double at_s, double rpm) {
    Do(at_s, {.deed = Deed::kCommand,
              .command = OperatorCommand::kSpin,
              .speed_rpm = rpm,
              .rpm_per_s = rate});
  };
  spin(kLiftedS, first_rpm);
  spin(Between(4.0, 7.0), second_rpm);
  if (One(4) == 0) {
    Do(Between(3.0, 8.0), {.deed = Deed::kCommand, .command = OperatorCommand::kCoastDown});
  }
}

void Draw::ProfileAsScenario(double first_rpm, double second_rpm, double rate) {
  const auto spin = [&](double rpm, double hold_s) {
    scenario::Step step;
    step.command = OperatorCommand::kSpin;
    step.speed_rad_per_s = RpmToRadPerS(rpm);
    step.acceleration_rad_per_s2 = RpmToRadPerS(rate);
    step.wait = rpm > 0.0 ? scenario::Wait::kSpeedReached : scenario::Wait::kStandstill;
    step.timeout_s = 60.0;
    step.hold_s = hold_s;
    return step;
  };
  plan_.scenario.name = "drawn";
  plan_.scenario.steps = {LiftStep(), spin(first_rpm, Between(0.2, 3.0)),
                          spin(second_rpm, Between(0.2, 2.0))};
}

LineTrouble Draw::Window() {
  LineTrouble trouble;
  trouble.from_ns = Ns(WhileTurning());
  trouble.to_ns = Coin() ? plan_.length_ns : trouble.from_ns + Ns(Over(1e-3, 3.0));
  return trouble;
}

void Draw::Add(const LineTrouble& trouble, const std::string& text, std::vector<LineTrouble>& to) {
  to.push_back(trouble);
  Tell(fmt::format("{} from {:.4f} to {:.4f} s", text, static_cast<double>(trouble.from_ns) * 1e-9,
                   static_cast<double>(trouble.to_ns) * 1e-9));
}

void Draw::Line(Kind kind) {
  LineTrouble t = Window();
  const auto frames = [&](const std::string& text) { Add(t, text, plan_.frame_troubles); };
  const auto currents = [&](const std::string& text) { Add(t, text, plan_.current_troubles); };
  const double share = Coin() ? Between(0.0, 0.95) : Over(1e-3, 0.5);
  switch (kind) {
    case Kind::kFramesLost:
      t.lost = share;
      return frames(fmt::format("{:.1f} % of the frames lost", 100.0 * share));
    case Kind::kCurrentsLost:
      t.lost = share;
      return currents(fmt::format("{:.1f} % of the currents lost", 100.0 * share));
    case Kind::kBurstsOfFrames:
    case Kind::kBurstsOfCurrents:
      t.burst_of = static_cast<std::uint32_t>(Over(2.0, 400.0));
      t.burst = static_cast<std::uint32_t>(std::clamp(Over(1.0, 40.0), 1.0, t.burst_of - 1.0));
      if (kind == Kind::kBurstsOfFrames) {
        return frames(fmt::format("{} of each {} frames lost", t.burst, t.burst_of));
      }
      return currents(fmt::format("{} of each {} currents lost", t.burst, t.burst_of));
    case Kind::kFramesLate:
      t.delay_ns = Ns(Over(5e-6, 3e-3));
      return frames(fmt::format("frames {:.0f} us late", static_cast<double>(t.delay_ns) * 1e-3));
    case Kind::kCurrentsLate:
      t.delay_ns = Ns(Over(5e-6, 3e-3));
      return currents(
          fmt::format("currents {:.0f} us late", static_cast<double>(t.delay_ns) * 1e-3));
    default:
      return Disorder(kind, t);
  }
}

/// Frames at odd times, twice or overtaken; by a coin the currents, too.
void Draw::Disorder(Kind kind, LineTrouble t) {
  const auto frames = [&](const std::string& text) { Add(t, text, plan_.frame_troubles); };
  switch (kind) {
    case Kind::kJitter:
      t.jitter_ns = Ns(Over(2e-5, 3e-3));
      if (Coin()) plan_.current_troubles.push_back(t);
      return frames(
          fmt::format("jitter of 0 to {:.0f} us", static_cast<double>(t.jitter_ns) * 1e-3));
    case Kind::kTwice:
      t.twice = Between(0.01, 1.0);
      if (Coin()) plan_.current_troubles.push_back(t);
      return frames(fmt::format("{:.0f} % twice", 100.0 * t.twice));
    default:
      t.old = Between(0.01, 1.0);
      t.old_periods = 1 + static_cast<std::uint32_t>(One(50));
      if (Coin()) plan_.current_troubles.push_back(t);
      return frames(fmt::format("behind {:.0f} % an older one of {} periods before", 100.0 * t.old,
                                t.old_periods));
  }
}

void Draw::FalseSpeed(Kind kind, double at_s, const std::string& when, Falsehood& f) {
  f.what = Falsified::kSpeed;
  if (kind == Kind::kSpeedGlitch) {
    const double rated = rig_.max_speed_rad_per_s;
    const std::array values{
        0.0, -0.2, RpmToRadPerS(Between(-4.0, 4.0)), rated * 0.5, -rated, 2.0 * rated, 1e9};
    f.value = values[One(values.size())];
    Tell(fmt::format("speed reads {:.4g} rad/s {}", f.value, when));
  } else if (kind == Kind::kSpeedNotFinite) {
    f.value =
        Coin() ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
    Tell(fmt::format("speed reads {} {}", f.value, when));
  } else {
    f.what = Falsified::kSpeedHeld;
    f.to_ns = Ns(at_s + Over(1e-2, 10.0));
    Tell(fmt::format("speed stuck from {:.4f} s", at_s));
  }
}

void Draw::FalsePosition(Kind kind, const std::string& when, Falsehood& f) {
  f.what = Falsified::kPosition;
  if (kind == Kind::kPositionGlitch) {
    f.value = rig_.SensorRangeOf(f.axis / 2) * Between(-1.0, 1.0);
    Tell(fmt::format("axis {} reads {:.0f} um {}", f.axis, f.value * 1e6, when));
  } else if (kind == Kind::kPositionNotFinite) {
    f.value = std::numeric_limits<double>::quiet_NaN();
    Tell(fmt::format("axis {} reads nan {}", f.axis, when));
  } else {
    f.what = Falsified::kPositionHeld;
    Tell(fmt::format("axis {} stuck {}", f.axis, when));
  }
}

void Draw::Truth(Kind kind) {
  Falsehood f;
  const double at_s = WhileTurning();
  const double lasts_s = Coin() ? 1e-4 : Over(1e-4, 1.0);
  f.from_ns = Ns(at_s);
  f.to_ns = Ns(at_s + lasts_s);
  f.axis = One(rig_.axes());
  const std::string when = fmt::format("at {:.4f} s for {:.4f} s", at_s, lasts_s);
  switch (kind) {
    case Kind::kSpeedGlitch:
    case Kind::kSpeedNotFinite:
    case Kind::kSpeedStuck:
      FalseSpeed(kind, at_s, when, f);
      break;
    case Kind::kPositionGlitch:
    case Kind::kPositionNotFinite:
    case Kind::kPositionStuck:
      FalsePosition(kind, when, f);
      break;
    default:
      f.what = Falsified::kStatus;
      f.status = kRigEmergencyStop;
      Tell(fmt::format("the rig's stop bit {}", when));
      break;
  }
  plan_.falsehoods.push_back(f);
}

void Draw::Signals() {
  const std::size_t requests = 1 + One(3);
  for (std::size_t n = 0; n < requests; ++n) {
    scenario::Step step;
    step.hold_s = Between(0.1, 3.0);
    step.orbit_limit_m = rig_.clearance_m * (Coin() ? 0.3 : Between(0.1, 0.99));
    const std::size_t signals = 1 + One(8);
    for (std::size_t k = 0; k < signals; ++k) step.excitation.push_back(DrawSignal(random_, rig_));
    if (plan_.plays_scenario && Coin()) {
      plan_.scenario.steps[1].excitation = step.excitation;
      plan_.scenario.steps[1].orbit_limit_m = step.orbit_limit_m;
    }
    plan_.signals.push_back(step);
    const double at_s = Between(kLiftedS, Seconds() - 1.0);
    Do(at_s, {.deed = Deed::kExcite, .signal = plan_.signals.size() - 1});
    Tell(fmt::format("{} test signals at {:.3f} s for {:.2f} s", signals, at_s, step.hold_s));
  }
}

void Draw::Commands() {
  const std::size_t count = 5 + One(40);
  Tell(fmt::format("{} commands at any time", count));
  for (std::size_t n = 0; n < count; ++n) {
    constexpr std::array kAsked{OperatorCommand::kLift, OperatorCommand::kSpin,
                                OperatorCommand::kSpin, OperatorCommand::kCoastDown,
                                OperatorCommand::kLand, OperatorCommand::kReset};
    Do(Between(0.1, Seconds()),
       {.deed = Deed::kCommand,
        .command = kAsked[One(kAsked.size())],
        .speed_rpm = RadPerSToRpm(rig_.max_speed_rad_per_s) * Between(-1.1, 1.1),
        .rpm_per_s = RadPerSToRpm(rig_.max_acceleration_rad_per_s2) * Between(0.05, 1.1)});
  }
}

void Draw::Deeds(Kind kind) {
  const double at_s = WhileTurning();
  const std::string when = fmt::format("at {:.4f} s", at_s);
  switch (kind) {
    case Kind::kStall: {
      const std::size_t stalls = 1 + One(30);
      const double lasts_s = Over(5e-5, 5e-3);
      for (std::size_t n = 0; n < stalls; ++n) {
        Do(n == 0 ? at_s : WhileTurning(), {.deed = Deed::kStall, .duration_ns = Ns(lasts_s)});
      }
      return Tell(fmt::format("controller late by {:.2f} ms, {} times", lasts_s * 1e3, stalls));
    }
    case Kind::kKill:
    case Kind::kKillAndRestart:
      Do(at_s, {.deed = Deed::kKill});
      Tell("controller killed " + when);
      if (kind == Kind::kKill) return;
      {
        const double again_s = at_s + Over(0.01, 2.0);
        Do(again_s, {.deed = Deed::kRevive});
        return Tell(fmt::format("another one at {:.4f} s", again_s));
      }
    case Kind::kRigRestart: {
      const double off_s = Over(1e-3, 0.5);
      Do(at_s, {.deed = Deed::kRestartRig, .duration_ns = Ns(off_s)});
      return Tell(fmt::format("rig restarted {} after {:.3f} s", when, off_s));
    }
    case Kind::kEmergencyStop:
      Do(at_s, {.deed = Deed::kEmergencyStop});
      return Tell("emergency stop " + when);
    default:
      Do(at_s, {.deed = Deed::kRequestEnd});
      return Tell("asked to end " + when);
  }
}

void Draw::Draws(Kind kind) {
  plan_.kinds.push_back(kind);
  if (kind >= Kind::kFramesLost && kind <= Kind::kOlder) return Line(kind);
  if (kind >= Kind::kSpeedGlitch && kind <= Kind::kPositionStuck) return Truth(kind);
  if (kind == Kind::kRigStopBit) return Truth(kind);
  if (kind == Kind::kCommands) return Commands();
  if (kind == Kind::kTestSignals) return Signals();
  if (kind != Kind::kNone) Deeds(kind);
}

void Draw::All() {
  plan_.watchdog_periods = Coin() ? 20 : 1000;
  plan_.keeps_order = Coin();
  Profile();
  const auto kind = static_cast<Kind>(plan_.seed % kKindCount);
  if (kind == Kind::kTwo) {
    for (int n = 0; n < 2; ++n) Draws(static_cast<Kind>(1 + One(kKindCount - 2)));
  } else {
    Draws(kind);
  }
  std::stable_sort(plan_.actions.begin(), plan_.actions.end(),
                   [](const Action& a, const Action& b) { return a.at_ns < b.at_ns; });
}

}  // namespace

std::string_view Name(Kind kind) noexcept {
  constexpr std::array<std::string_view, kKindCount> kNames{"nothing",
                                                            "frames_lost",
                                                            "currents_lost",
                                                            "bursts_of_frames",
                                                            "bursts_of_currents",
                                                            "frames_late",
                                                            "currents_late",
                                                            "jitter",
                                                            "twice",
                                                            "older",
                                                            "speed_glitch",
                                                            "speed_not_finite",
                                                            "speed_stuck",
                                                            "position_glitch",
                                                            "position_not_finite",
                                                            "position_stuck",
                                                            "stall",
                                                            "kill",
                                                            "kill_and_restart",
                                                            "rig_restart",
                                                            "emergency_stop",
                                                            "rig_stop_bit",
                                                            "commands",
                                                            "test_signals",
                                                            "end",
                                                            "two"};
  return kNames[static_cast<std::size_t>(kind)];
}

bool LifePlan::Has(Kind kind) const noexcept {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

scenario::Step LiftStep() {
  scenario::Step lift;
  lift.command = OperatorCommand::kLift;
  lift.wait = scenario::Wait::kMode;
  lift.wait_mode = Mode::kLevitating;
  lift.timeout_s = 5.0;
  lift.hold_s = 0.2;
  return lift;
}

LifePlan DrawLife(std::uint64_t seed, double seconds, const RigNumbers& rig) {
  LifePlan plan;
  plan.seed = seed;
  plan.length_ns = Ns(seconds);
  Draw(plan, rig).All();
  return plan;
}

}  // namespace levitas::lives
