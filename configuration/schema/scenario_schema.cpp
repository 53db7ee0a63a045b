// Table of a scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "common/rotational_speed.hpp"
#include "configuration/schema/schema.hpp"

namespace levitas::configuration {
namespace {

using namespace unit;
using scenario::Wait;

// [rpm/s] Of a step without an acceleration, and of the sessions that write it out.
constexpr double kAsFastAsItCan = 1e6;
constexpr double kRounding = 1.0 + 1e-9;  // of a number that went to SI and back

// In the order of OperatorCommand, without those for test signals: a step has a list of its own.
constexpr std::array<std::string_view, 7> kCommands{
    "nothing", "lift", "spin", "coast_down", "land", "emergency_stop", "reset"};
// Three waits of their own, then the modes in the order of Mode.
constexpr std::array<std::string_view, 3 + kModeCount> kWaits{
    "nothing",    "speed_reached", "standstill", "off",     "self_test", "lift",
    "levitating", "spinning",      "coast_down", "landing", "tripped"};

std::size_t WaitIndex(const scenario::Step& step) {
  switch (step.wait) {
    case Wait::kNothing:
      return 0;
    case Wait::kSpeedReached:
      return 1;
    case Wait::kStandstill:
      return 2;
    case Wait::kMode:
      break;
  }
  return 3 + static_cast<std::size_t>(step.wait_mode);
}

void SetWait(scenario::Step& step, std::size_t index) {
  constexpr std::array kOwn{Wait::kNothing, Wait::kSpeedReached, Wait::kStandstill};
  step.wait = index < kOwn.size() ? kOwn[index] : Wait::kMode;
  if (index >= kOwn.size()) step.wait_mode = static_cast<Mode>(index - kOwn.size());
}

// Beyond it the excitation is cut back; see orbit_limiter.hpp.
void DescribeOrbitLimit(Visitor& v, scenario::Step& step, const RigNumbers& rig) {
  constexpr double kZoneA = 0.3;  // of the clearance, after ISO 14839-2
  v.Number(
      {"orbit_limit", kMicrometre, 0, 5000, 0,
       "the excitation is cut back while a bearing's orbit is larger; 0: 30 % of the clearance"},
      step.orbit_limit_m);
  if (!step.excitation.empty() && step.orbit_limit_m == 0.0) {
    step.orbit_limit_m = kZoneA * rig.clearance_m;
  }
  v.RefuseIf(rig.clearance_m > 0.0 && step.orbit_limit_m >= rig.clearance_m, "orbit_limit_um",
             fmt::format("must be smaller than the clearance, {:.6g} um", rig.clearance_m * 1e6));
}

void Describe(Visitor& v, scenario::Step& step, const RigNumbers& rig) {
  auto command = static_cast<std::size_t>(step.command);
  v.Choice({"do", kCommands, kRequired, "what the operator asks for"}, command);
  step.command = static_cast<OperatorCommand>(command);
  v.When(step.command == OperatorCommand::kSpin, "with do: spin", [&] {
    v.Number({"speed", kRpm, 0, 300000, kRequired, "speed to reach"}, step.speed_rad_per_s);
    v.RefuseIf(
        rig.max_speed_rad_per_s > 0.0 && step.speed_rad_per_s > rig.max_speed_rad_per_s,
        "speed_rpm",
        fmt::format("found {:.6g} rpm, but the rig is rated for {:.6g} rpm",
                    RadPerSToRpm(step.speed_rad_per_s), RadPerSToRpm(rig.max_speed_rad_per_s)));
    const double most_rpm_per_s =
        std::min(kAsFastAsItCan, RadPerSToRpm(rig.max_acceleration_rad_per_s2));
    v.Number({"acceleration", kRpmPerSecond, 0.1, kAsFastAsItCan, kAsFastAsItCan,
              "rate, up or down, within the drive's; left out: a step, as fast as the drive can"},
             step.acceleration_rad_per_s2);
    if (RadPerSToRpm(step.acceleration_rad_per_s2) * kRounding >= kAsFastAsItCan) {
      step.acceleration_rad_per_s2 = RpmToRadPerS(most_rpm_per_s);
    }
    v.RefuseIf(RadPerSToRpm(step.acceleration_rad_per_s2) > most_rpm_per_s * kRounding,
               "acceleration_rpm_per_s",
               fmt::format("found {:.6g} rpm/s, but the rig's drive does {:.6g} rpm/s",
                           RadPerSToRpm(step.acceleration_rad_per_s2), most_rpm_per_s));
  });
  std::size_t wait = WaitIndex(step);
  v.Choice({"until", kWaits, "nothing", "what to wait for: a mode, the speed, standstill"}, wait);
  SetWait(step, wait);
  v.RefuseIf(step.wait == Wait::kSpeedReached && step.command != OperatorCommand::kSpin, "until",
             "speed_reached is only allowed with do: spin");
  v.When(step.wait != Wait::kNothing, "with an until", [&] {
    v.Number({"timeout", kSecond, 0.001, 100000, kRequired,
              "the scenario fails when the wait takes longer"},
             step.timeout_s);
  });
  DescribeExcitations(v, step, rig);
}

}  // namespace

void DescribeExcitations(Visitor& v, scenario::Step& step, const RigNumbers& rig) {
  v.Number({"hold", kSecond, 0, 1e6, 0, "then stay this long"}, step.hold_s);
  constexpr std::size_t kMost = 4 * kMaxAxes;
  v.List({"excitation", 0, kMost, "test signals while the step holds"}, step.excitation,
         [&](scenario::Excitation& excitation, std::size_t) { Describe(v, excitation, rig); });
  SpreadOverAxes(step.excitation, rig);
  v.RefuseIf(
      step.excitation.size() > kMost, "excitation",
      fmt::format("{} signals with those on all axes, allowed {}", step.excitation.size(), kMost));
  v.RefuseIf(!step.excitation.empty() && step.hold_s == 0.0, "hold_s",
             "an excitation acts during the hold time, which is 0");
  DescribeOrbitLimit(v, step, rig);
}

void Describe(Visitor& v, scenario::ScenarioConfig& scenario, const RigNumbers& rig) {
  v.Name({"name", "of the scenario"}, scenario.name);
  v.List({"steps", 1, 1000, "one after the other"}, scenario.steps,
         [&](scenario::Step& step, std::size_t) { Describe(v, step, rig); });
  v.List({"rig_events", 0, 100, "what happens to the simulated rig, at times of its own"},
         scenario.rig_events,
         [&](ScheduledRigEvent& event, std::size_t) { Describe(v, event, rig); });
}

}  // namespace levitas::configuration
