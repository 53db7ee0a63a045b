// Table of a scenario file.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "config/schema/schema.hpp"

namespace levitas::config {
namespace {

using namespace unit;
using scenario::Wait;

// In the order of OperatorCommand.
constexpr std::array<std::string_view, kOperatorCommandCount> kCommands{
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

void Describe(Visitor& v, scenario::Excitation& excitation, const RigNumbers& rig) {
  std::vector<std::string_view> names(rig.channels.begin(), rig.channels.end());
  if (names.empty()) names.push_back(excitation.channel);  // written without its rig
  const auto at = std::ranges::find(names, excitation.channel);
  auto index = at == names.end() ? 0 : static_cast<std::size_t>(at - names.begin());
  v.Choice({"channel", names, kRequired, "axis of the rig"}, index);
  if (rig.channels.empty()) {
    excitation.channel = names[index];
  } else {
    excitation.channel = rig.channels[index];
    excitation.axis = index;
  }
  v.Number({"amplitude", kAmpere, 1e-6, 100, kRequired, "the current is plus or minus this"},
           excitation.amplitude_a);
  const double limit_a = std::min(rig.bias_current_a, rig.max_coil_current_a - rig.bias_current_a);
  v.RefuseIf(!rig.channels.empty() && excitation.amplitude_a > limit_a, "amplitude_a",
             fmt::format("found {:.6g} A, but the coils leave {:.6g} A in all",
                         excitation.amplitude_a, limit_a));
  v.Integer({"order", 7, 23, 12, "the sequence repeats after 2^order - 1 bits"}, excitation.order);
  v.Integer({"divisor", 1, 100000, 1, "control cycles per bit"}, excitation.divisor);
  v.Number({"start", kOne, 0, 0.999999, 0,
            "where in the sequence it begins; spread channels (0, 0.25, ...) to decorrelate them"},
           excitation.start);
}

void Describe(Visitor& v, scenario::Step& step, const RigNumbers& rig) {
  auto command = static_cast<std::size_t>(step.command);
  v.Choice({"do", kCommands, kRequired, "what the operator asks for"}, command);
  step.command = static_cast<OperatorCommand>(command);
  v.When(step.command == OperatorCommand::kSpin, "with do: spin", [&] {
    v.Number({"speed", kRpm, 0, 300000, kRequired, "speed to reach"}, step.speed_rad_per_s);
    v.RefuseIf(rig.max_speed_rad_per_s > 0.0 && step.speed_rad_per_s > rig.max_speed_rad_per_s,
               "speed_rpm",
               fmt::format("found {:.6g} rpm, but the rig is rated for {:.6g} rpm",
                           step.speed_rad_per_s * 30.0 / static_cast<double>(kPi),
                           rig.max_speed_rad_per_s * 30.0 / static_cast<double>(kPi)));
    v.Number({"acceleration", kRpmPerSecond, 0.1, 1e6, kRequired, "rate, up or down"},
             step.acceleration_rad_per_s2);
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
  v.Number({"hold", kSecond, 0, 1e6, 0, "then stay this long"}, step.hold_s);
  v.List({"excitation", 0, kMaxAxes, "pseudo-random binary current while the step holds"},
         step.excitation,
         [&](scenario::Excitation& excitation, std::size_t) { Describe(v, excitation, rig); });
  v.RefuseIf(!step.excitation.empty() && step.hold_s == 0.0, "hold_s",
             "an excitation acts during the hold time, which is 0");
}

}  // namespace

void Describe(Visitor& v, scenario::ScenarioConfig& scenario, const RigNumbers& rig) {
  v.Name({"name", "of the scenario"}, scenario.name);
  v.List({"steps", 1, 1000, "one after the other"}, scenario.steps,
         [&](scenario::Step& step, std::size_t) { Describe(v, step, rig); });
}

}  // namespace levitas::config
