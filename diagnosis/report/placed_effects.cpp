// Terms and estimates by effect and place.

#include <algorithm>
#include <cmath>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "diagnosis/report/named_values.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

void Add(std::vector<PlacedEffect>& groups, const DiagnosisResult& s, std::size_t index,
         double theta) {
  const Point& point = s.answer.extended;
  const Term term = TermAt(s.terms, point, index);
  const auto same = std::find_if(groups.begin(), groups.end(), [&term](const PlacedEffect& g) {
    return g.effect == term.effect && g.location.name == term.location.name;
  });
  PlacedEffect& group = same != groups.end()
                            ? *same
                            : groups.emplace_back(PlacedEffect{
                                  term.effect, term.location, point.shapes[index], {}, {}});
  group.theta.try_emplace(term.parameter, theta);
  group.term.try_emplace(term.parameter, index);
}

}  // namespace

std::string_view PlacedEffect::effect_name() const {
  return effect ? effect::At(*effect).name : std::string_view{};
}

double PlacedEffect::At(const std::string& parameter) const {
  const auto found = theta.find(parameter);
  return found == theta.end() ? 0.0 : found->second;
}

double PlacedEffect::Amplitude() const { return std::hypot(At("cosine"), At("sine")); }
double PlacedEffect::Phase() const { return std::atan2(At("sine"), At("cosine")); }

const Estimate* EstimateOf(const std::vector<Estimate>& estimates, std::size_t term) {
  const auto found = std::find_if(estimates.begin(), estimates.end(),
                                  [term](const Estimate& e) { return e.term == term; });
  return found == estimates.end() ? nullptr : &*found;
}

std::vector<PlacedEffect> CausesByPlace(const DiagnosisResult& s) {
  std::vector<PlacedEffect> groups;
  for (const Hypothesis& cause : s.answer.causes) {
    for (const std::size_t t : cause.terms) {
      Add(groups, s, t, s.answer.extended.theta[t]);
    }
  }
  return groups;
}

std::vector<PlacedEffect> CalibrationByPlace(const DiagnosisResult& s) {
  std::vector<PlacedEffect> groups;
  for (const Estimate& e : s.answer.calibration) Add(groups, s, e.term, e.value);
  return groups;
}

}  // namespace levitas::diagnosis
