#include "diagnosis/report/excitation_coverage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

constexpr double kSlowRoll = 0.02;  ///< of the rated speed

bool Has(const DiagnosisResult& s, effect::Id effect) {
  return std::any_of(s.terms.begin(), s.terms.end(),
                     [effect](const Term& term) { return term.effect == effect; });
}

/// The effects that were searched and of which `needs` holds.
void Append(const DiagnosisResult& s, bool effect::Facts::*needs, std::vector<effect::Id>& to) {
  for (const effect::Row& row : effect::Catalogue()) {
    if (row.facts.*needs && Has(s, row.id)) to.push_back(row.id);
  }
}

}  // namespace

Coverage CoverageOf(const DiagnosisResult& s) {
  Coverage c;
  const double rated = s.view->numbers.max_speed_rad_per_s;
  c.turns = rated <= 0.0 || s.fastest_rad_per_s > kSlowRoll * rated;
  c.excited = s.excited;
  return c;
}

std::vector<effect::Id> UnobservableEffects(const DiagnosisResult& s) {
  const Coverage c = CoverageOf(s);
  std::vector<effect::Id> effects;
  if (!c.turns) Append(s, &effect::Facts::needs_rotation, effects);
  if (!c.excited) Append(s, &effect::Facts::needs_excitation, effects);
  return effects;
}

std::string UnobservableSentence(const DiagnosisResult& s) {
  const Coverage c = CoverageOf(s);
  if (c.turns && c.excited) return {};
  std::vector<effect::Id> turning;
  std::vector<effect::Id> excited;
  Append(s, &effect::Facts::needs_rotation, turning);
  Append(s, &effect::Facts::needs_excitation, excited);
  std::string text = "These records cannot show every effect:";
  if (!c.turns) {
    text += fmt::format(" the rotor does not turn, so {} would not show",
                        fmt::join(effect::NamesOf(turning), ", "));
  }
  if (!c.excited) {
    text += fmt::format("{} no test signal is recorded, so {} would hardly show",
                        c.turns ? "" : ";", fmt::join(effect::NamesOf(excited), ", "));
  }
  return text + ".";
}

std::string MissingRecords(const DiagnosisResult& s) {
  const Coverage c = CoverageOf(s);
  if (c.turns && c.excited) return {};
  if (c.turns) return "standing with a test signal on every axis, and spinning with it";
  if (c.excited) return "spinning at two speeds and a run-up, with the test signal";
  return "standing with a test signal on every axis, spinning with it at two speeds, and a run-up";
}

}  // namespace levitas::diagnosis
