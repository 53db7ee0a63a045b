// Terms and estimates by effect and place.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "diagnosis/report/diagnose_files.hpp"
#include "diagnosis/report/named_values.hpp"

namespace levitas::diagnosis {
namespace {

void Add(std::vector<PlacedEffect>& groups, const std::string& effect, const std::string& place,
         const std::string& parameter, double theta) {
  const auto same = std::find_if(groups.begin(), groups.end(), [&](const PlacedEffect& g) {
    return g.effect == effect && g.place == place;
  });
  PlacedEffect& group =
      same != groups.end() ? *same : groups.emplace_back(PlacedEffect{effect, place, {}});
  group.theta.try_emplace(parameter, theta);
}

}  // namespace

double PlacedEffect::At(const std::string& parameter) const {
  const auto found = theta.find(parameter);
  return found == theta.end() ? 0.0 : found->second;
}

double PlacedEffect::Amplitude() const { return std::hypot(At("cosine"), At("sine")); }
double PlacedEffect::Phase() const { return std::atan2(At("sine"), At("cosine")); }

double PlacedEffect::Number() const {
  const auto at = place.find_first_of("-0123456789");
  return at == std::string::npos ? 0.0 : std::strtod(place.c_str() + at, nullptr);
}

std::string PlacedEffect::After(const std::string& comma) const {
  const auto at = place.find(comma);
  return at == std::string::npos ? place : place.substr(at + comma.size());
}

const Estimate* EstimateOf(const std::vector<Estimate>& estimates, const PlacedEffect& at,
                           const std::string& parameter) {
  const auto found = std::find_if(estimates.begin(), estimates.end(), [&](const Estimate& e) {
    return e.effect == at.effect && e.place == at.place && e.parameter == parameter;
  });
  return found == estimates.end() ? nullptr : &*found;
}

const Term* TermOf(const std::vector<Term>& terms, const PlacedEffect& at,
                   const std::string& parameter) {
  const auto found = std::find_if(terms.begin(), terms.end(), [&](const Term& t) {
    return t.effect == at.effect && t.place == at.place && t.parameter == parameter;
  });
  return found == terms.end() ? nullptr : &*found;
}

std::vector<PlacedEffect> CausesByPlace(const DiagnosisResult& s) {
  std::vector<PlacedEffect> groups;
  for (const Hypothesis& cause : s.answer.causes) {
    for (const std::size_t t : cause.terms) {
      const Term& term = s.terms[t];
      Add(groups, term.effect, term.place, term.parameter, s.answer.theta_extended[t]);
    }
  }
  return groups;
}

std::vector<PlacedEffect> CalibrationByPlace(const DiagnosisResult& s) {
  std::vector<PlacedEffect> groups;
  for (const Estimate& e : s.answer.calibration) {
    Add(groups, e.effect, e.place, e.parameter, e.value);
  }
  return groups;
}

}  // namespace levitas::diagnosis
