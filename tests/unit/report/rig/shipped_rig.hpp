#pragma once
// A shipped rig and controller by their names.

#include <algorithm>
#include <string>

#include "configuration/rig_file.hpp"
#include "report/svg/figure.hpp"

namespace levitas::report::test {

inline configuration::RigFile Rig(const std::string& name) {
  return configuration::LoadRig(configuration::FindConfig(name, "rigs"));
}

inline law::LawConfig Law(const std::string& name, const configuration::RigFile& rig) {
  return configuration::LoadController(configuration::FindConfig(name, "controllers"), rig.numbers)
      .law;
}

inline const svg::Series* Named(const svg::Panel& panel, const std::string& name) {
  const auto found = std::find_if(panel.series.begin(), panel.series.end(),
                                  [&](const svg::Series& s) { return s.name == name; });
  return found == panel.series.end() ? nullptr : &*found;
}

inline bool HasNote(const svg::Panel& panel, const std::string& part) {
  return std::any_of(panel.notes.begin(), panel.notes.end(), [&](const svg::Note& note) {
    return note.text.find(part) != std::string::npos;
  });
}

}  // namespace levitas::report::test
