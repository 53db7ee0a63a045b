#include "diagnosis/report/extended_rig.hpp"

#include <fmt/core.h>

#include <sstream>

#include "common/problem.hpp"
#include "diagnosis/report/named_values.hpp"
#include "diagnosis/report/report_text.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// Why the strict reader refuses the rig; empty when it takes it.
std::string Refusal(const config::RigFile& rig) {
  try {
    static_cast<void>(config::ParseRig(config::WriteRig(rig), "extended_rig.yaml"));
    return {};
  } catch (const BadInput& refused) {
    return refused.what();
  }
}

/// Each line of a text as a comment of YAML.
std::string AsComment(const std::string& text) {
  std::string comment;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) comment += fmt::format("#   {}\n", line);
  return comment;
}

}  // namespace

std::vector<effect::EffectConfig> EffectEntries(const DiagnosisResult& answer) {
  std::vector<effect::EffectConfig> entries;
  for (const PlacedEffect& cause : CausesByPlace(answer)) {
    if (const auto entry = EntryFor(*answer.view, cause)) entries.push_back(*entry);
  }
  return entries;
}

std::string WithEffects(config::RigFile rig, const std::vector<effect::EffectConfig>& entries) {
  std::vector<effect::EffectConfig>& effects = rig.plant.effects;
  const std::vector<effect::EffectConfig> of_file = effects;
  effects.insert(effects.end(), entries.begin(), entries.end());
  if (Refusal(rig).empty()) return config::WriteRig(rig);
  effects = of_file;
  std::string refused;
  for (const effect::EffectConfig& entry : entries) {
    effects.push_back(entry);
    const std::string reason = Refusal(rig);
    if (reason.empty()) continue;
    effects.pop_back();
    refused += fmt::format("# not known to this build's reader: {}\n{}", effect::At(entry.id).name,
                           AsComment(reason));
  }
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
