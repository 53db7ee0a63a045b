#include "diagnosis/report/extended_rig.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <sstream>

#include "common/problem.hpp"
#include "diagnosis/report/event_values.hpp"
#include "diagnosis/report/named_values.hpp"
#include "diagnosis/report/report_text.hpp"
#include "plant_sim/effect/catalogue.hpp"

namespace levitas::diagnosis {
namespace {

/// Why the strict reader refuses the rig; empty when it takes it.
std::string Refusal(const configuration::RigFile& rig) {
  try {
    static_cast<void>(configuration::ParseRig(configuration::WriteRig(rig), "extended_rig.yaml"));
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

/// What was counted is all there is: it stands in the place of what the file says of it.
void ReplaceIn(std::vector<effect::EffectConfig>& effects, const effect::EffectConfig& entry) {
  if (entry.id != effect::Id::kDroppedSamples && entry.id != effect::Id::kSensorNoise) return;
  for (effect::EffectConfig& own : effects) {
    if (own.id == entry.id) own.axes &= ~entry.axes;
  }
  std::erase_if(effects, [&entry](const effect::EffectConfig& own) {
    return own.id == entry.id && (own.axes == 0U || own.id == effect::Id::kDroppedSamples);
  });
}

}  // namespace

std::vector<effect::EffectConfig> EffectEntries(const DiagnosisResult& answer) {
  std::vector<effect::EffectConfig> entries;
  for (const PlacedEffect& cause : CausesByPlace(answer)) {
    if (IsShorterDelay(cause)) continue;
    if (const auto entry = EntryFor(*answer.view, cause)) entries.push_back(*entry);
  }
  for (const effect::EffectConfig& entry : EventEntries(answer)) entries.push_back(entry);
  return entries;
}

configuration::RigFile WithOwnKeys(const DiagnosisResult& answer, configuration::RigFile rig) {
  for (const PlacedEffect& cause : CausesByPlace(answer)) {
    if (!IsShorterDelay(cause)) continue;
    rig.plant.delay_samples = std::max(0.0, rig.plant.delay_samples + cause.At("samples"));
  }
  return rig;
}

std::string WithEffects(configuration::RigFile rig,
                        const std::vector<effect::EffectConfig>& entries) {
  std::vector<effect::EffectConfig>& effects = rig.plant.effects;
  for (const effect::EffectConfig& entry : entries) ReplaceIn(effects, entry);
  const std::vector<effect::EffectConfig> of_file = effects;
  effects.insert(effects.end(), entries.begin(), entries.end());
  if (Refusal(rig).empty()) return configuration::WriteRig(rig);
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
  return refused + configuration::WriteRig(rig);
}

std::string ExtendedRig(const DiagnosisResult& answer, const configuration::RigFile& rig) {
  std::string comments;
  const std::vector<NamedParameter> parameters = Parameters(answer);
  for (const NamedParameter& p : parameters) {
    comments += fmt::format("# {} {} = {:.5g}{}{}{}\n", p.effect, p.name, p.value,
                            p.unit.empty() ? "" : " ", p.unit, BracketText(p));
  }
  for (const std::string& total : TotalSentences(parameters)) {
    comments += fmt::format("# {}\n", total);
  }
  return comments + WithEffects(WithOwnKeys(answer, rig), EffectEntries(answer));
}

}  // namespace levitas::diagnosis
