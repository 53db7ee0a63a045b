#include "diagnosis/report/affected_part.hpp"

#include <algorithm>

#include "diagnosis/diagnose/diagnose_files.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {

std::string PlaceOfEffect(effect::Id id) { return std::string(effect::Name(effect::At(id).place)); }

std::string PlaceOfResidual(const std::string& coherent_with) {
  if (coherent_with == "current") return "magnet";
  if (coherent_with == "rotation" || coherent_with == "position") return "rotor";
  return coherent_with == "mains" ? "sensor" : "external";
}

std::string PlaceOf(const DiagnosisResult& s) {
  const SearchResult& a = s.answer;
  if (!a.causes.empty()) {
    const Hypothesis& first = a.causes.front();
    if (!first.terms.empty() && s.terms[first.terms.front()].location.on_sensor) return "sensor";
    return PlaceOfEffect(first.effect);
  }
  if (a.verdict == Verdict::kNone) return "";
  return PlaceOfResidual(a.residual.coherent_with);
}

std::vector<std::string> Channels(const DiagnosisResult& s) {
  const auto& channels = s.view->numbers.channels;
  if (s.answer.causes.empty()) {
    if (s.answer.verdict == Verdict::kNone) return {};
    return {channels[s.answer.residual.worst_channel]};
  }
  std::vector<std::string> found;
  for (std::size_t a = 0; a < channels.size(); ++a) {
    const std::vector<std::size_t>& terms = s.answer.causes.front().terms;
    const bool touched = std::any_of(terms.begin(), terms.end(), [&s, a](std::size_t t) {
      return s.terms[t].location.Touches(a);
    });
    if (touched) found.push_back(channels[a]);
  }
  return found.empty() ? channels : found;
}

}  // namespace levitas::diagnosis
