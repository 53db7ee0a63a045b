#include "diagnosis/report/extended_rig.hpp"

#include <fmt/core.h>

#include "common/problem.hpp"
#include "diagnosis/report/named_values.hpp"
#include "diagnosis/report/report_text.hpp"

namespace levitas::diagnosis {
namespace {

/// Entries as the strict reader takes them on this rig; none when it refuses one of them.
std::vector<effect::EffectConfig> Read(config::RigFile rig,
                                       const std::vector<std::string>& entries) {
  const std::string none = "effects: []\n";
  rig.plant.effects.clear();
  std::string text = config::WriteRig(rig);
  const auto at = text.rfind(none);
  if (at == std::string::npos) return {};
  std::string list = "effects:\n";
  for (const std::string& entry : entries) list += "  - " + entry + "\n";
  text.replace(at, none.size(), list);
  try {
    return config::ParseRig(text, "extended_rig.yaml").plant.effects;
  } catch (const BadInput&) {
    return {};
  }
}

/// What the file and the entries hold together, as far as they can stand side by side.
bool Accepts(config::RigFile rig, const std::vector<effect::EffectConfig>& effects) {
  rig.plant.effects.insert(rig.plant.effects.end(), effects.begin(), effects.end());
  try {
    static_cast<void>(config::ParseRig(config::WriteRig(rig), "extended_rig.yaml"));
    return true;
  } catch (const BadInput&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> EffectEntries(const DiagnosisResult& answer) {
  std::vector<std::string> entries;
  for (const PlacedEffect& group : CausesByPlace(answer)) {
    const std::string entry = EntryText(group.effect, ValuesOf(*answer.view, group));
    if (!entry.empty()) entries.push_back(entry);
  }
  return entries;
}

std::string WithEffects(config::RigFile rig, const std::vector<std::string>& entries) {
  std::string refused;
  const auto all = entries.empty() ? std::vector<effect::EffectConfig>{} : Read(rig, entries);
  if (!all.empty() && Accepts(rig, all)) {
    rig.plant.effects.insert(rig.plant.effects.end(), all.begin(), all.end());
    return config::WriteRig(rig);
  }
  for (const std::string& entry : entries) {
    const auto effects = Read(rig, {entry});
    if (effects.empty() || !Accepts(rig, effects)) {
      refused += "#  - " + entry + "\n";
    } else {
      rig.plant.effects.insert(rig.plant.effects.end(), effects.begin(), effects.end());
    }
  }
  if (!refused.empty()) refused.insert(0, "# not known to this build's reader:\n");
  return refused + config::WriteRig(rig);
}

std::string ExtendedRig(const DiagnosisResult& answer, const config::RigFile& rig) {
  std::string comments;
  const std::vector<NamedParameter> parameters = Parameters(answer);
  for (const NamedParameter& p : parameters) {
    comments += fmt::format("# {} {} = {:.5g}{}{} ({:.5g} to {:.5g})\n", p.effect, p.name, p.value,
                            p.unit.empty() ? "" : " ", p.unit, p.low, p.high);
  }
  for (const std::string& total : TotalSentences(parameters)) {
    comments += fmt::format("# {}\n", total);
  }
  return comments + WithEffects(rig, EffectEntries(answer));
}

}  // namespace levitas::diagnosis
