#include "diagnosis/report/coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

namespace levitas::diagnosis {
namespace {

constexpr double kSlowRoll = 0.02;  ///< of the rated speed

constexpr std::array<std::string_view, 10> kTurning{
    "unbalance",          "sensor_runout",      "misalignment",     "shaft_bow",
    "shaft_anisotropy",   "gyroscopic_inertia", "internal_damping", "breathing_crack",
    "transmission_error", "gear_runout"};
constexpr std::array<std::string_view, 8> kExcited{
    "current_gain",        "displacement_stiffness", "sensor_gain",  "extra_delay",
    "amplifier_bandwidth", "sensor_bandwidth",       "eddy_current", "modal_frequency"};

bool Has(const SessionAnswer& s, std::string_view effect) {
  return std::any_of(s.terms.begin(), s.terms.end(),
                     [effect](const Term& term) { return term.effect == effect; });
}

template <std::size_t kCount>
void Append(const SessionAnswer& s, const std::array<std::string_view, kCount>& list,
            std::vector<std::string>& to) {
  for (const std::string_view effect : list) {
    if (Has(s, effect)) to.emplace_back(effect);
  }
}

}  // namespace

Coverage CoverageOf(const SessionAnswer& s) {
  Coverage c;
  const double rated = s.view->numbers.max_speed_rad_per_s;
  // Whose words are its own has nothing that turns (diagnosis/levitator).
  c.turns = rated <= 0.0 || s.fastest_rad_per_s > kSlowRoll * rated || s.own_words;
  c.excited = s.excited || s.own_words;
  return c;
}

std::vector<std::string> CannotTell(const SessionAnswer& s) {
  const Coverage c = CoverageOf(s);
  std::vector<std::string> effects;
  if (!c.turns) Append(s, kTurning, effects);
  if (!c.excited) Append(s, kExcited, effects);
  return effects;
}

std::string CannotTellSentence(const SessionAnswer& s) {
  const Coverage c = CoverageOf(s);
  if (c.turns && c.excited) return {};
  std::vector<std::string> turning;
  std::vector<std::string> excited;
  Append(s, kTurning, turning);
  Append(s, kExcited, excited);
  std::string text = "These records cannot tell everything:";
  if (!c.turns) {
    text += fmt::format(" the rotor does not turn, so {} would not show", fmt::join(turning, ", "));
  }
  if (!c.excited) {
    text += fmt::format("{} no test signal is recorded, so {} would hardly show",
                        c.turns ? "" : ";", fmt::join(excited, ", "));
  }
  return text + ".";
}

std::string MissingRecords(const SessionAnswer& s) {
  const Coverage c = CoverageOf(s);
  if (c.turns && c.excited) return {};
  if (c.turns) return "standing with a test signal on every axis, and spinning with it";
  if (c.excited) return "spinning at two speeds and a run-up, with the test signal";
  return "standing with a test signal on every axis, spinning with it at two speeds, and a run-up";
}

}  // namespace levitas::diagnosis
