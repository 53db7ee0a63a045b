#include "diagnosis/report/affected_part.hpp"

#include <algorithm>
#include <stdexcept>

#include "diagnosis/report/diagnose_files.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {

std::string PlaceOfEffect(const std::string& effect) {
  const effect::Row* row = effect::Find(effect);
  if (row == nullptr) throw std::logic_error(effect + " is not in the catalogue of effects");
  return std::string(effect::Name(row->place));
}

std::string PlaceOfResidual(const std::string& coherent_with) {
  if (coherent_with == "current") return "magnet";
  if (coherent_with == "rotation" || coherent_with == "position") return "rotor";
  return coherent_with == "mains" ? "sensor" : "external";
}

std::string PlaceOf(const DiagnosisResult& s) {
  const SearchResult& a = s.answer;
  if (!a.causes.empty()) {
    if (a.causes.front().effect == "axis_rotation") return a.causes.front().place.substr(0, 6);
    return PlaceOfEffect(a.causes.front().effect);
  }
  if (a.verdict == Verdict::kNone) return "";
  return PlaceOfResidual(a.remainder.coherent_with);
}

std::vector<std::string> Channels(const DiagnosisResult& s) {
  const auto& channels = s.view->numbers.channels;
  if (s.answer.causes.empty()) {
    if (s.answer.verdict == Verdict::kNone) return {};
    return {channels[s.answer.remainder.worst_channel]};
  }
  std::vector<std::string> found;
  for (std::size_t a = 0; a < channels.size(); ++a) {
    const std::string& channel = channels[a];
    const std::string& bearing = s.view->numbers.bearings[a / 2];
    for (const std::size_t t : s.answer.causes.front().terms) {
      const std::string place = " " + s.terms[t].place + ",";
      const bool named = place.find(" " + channel + ",") != std::string::npos ||
                         place.find(" " + bearing + ",") != std::string::npos;
      if (named && std::find(found.begin(), found.end(), channel) == found.end()) {
        found.push_back(channel);
      }
    }
  }
  return found.empty() ? channels : found;
}

}  // namespace levitas::diagnosis
