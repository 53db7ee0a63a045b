#include "cli/run/rig_as_run.hpp"

#include <fmt/core.h>

#include "plant_sim/effect/effect_config.hpp"

namespace levitas::cli {
namespace {

/// "- {id: ...}" and "id: ..." are "{id: ...}".
std::string InBraces(const std::string& entry) {
  constexpr const char* kBefore = " \t-";
  const auto first = entry.find_first_not_of(kBefore);
  if (first == std::string::npos) return "{}";
  const std::string bare = entry.substr(first);
  return bare.front() == '{' ? bare : "{" + bare + "}";
}

/// One entry, read as that of a rig file is; before the rest, so that its place is in line 1.
void AddEffect(const std::string& path, const std::string& entry, configuration::RigFile& rig) {
  configuration::RigFile healthy = rig;
  healthy.plant.effects.clear();
  std::string text = configuration::WriteRig(healthy);
  const std::string none = "\neffects: []\n";
  if (const auto at = text.find(none); at != std::string::npos) text.replace(at, none.size(), "\n");
  text = fmt::format("effects: [{}]\n{}", InBraces(entry), text);
  const configuration::RigFile read =
      configuration::ParseRig(text, fmt::format("{} with --effect '{}'", path, entry));
  rig.plant.effects.insert(rig.plant.effects.end(), read.plant.effects.begin(),
                           read.plant.effects.end());
}

}  // namespace

RigAsRun ReadRigAsRun(const std::string& path, const RigChanges& changes) {
  configuration::RigFile rig = configuration::LoadRig(path);
  std::string name = path;
  if (changes.bias_current_a) {
    rig.numbers.bias_current_a = *changes.bias_current_a;
    for (auto& bearing : rig.plant.bearings)
      bearing.magnet.bias_current_a = *changes.bias_current_a;
    name += fmt::format(" with --bias-current-a {:g}", *changes.bias_current_a);
    rig = configuration::ParseRig(configuration::WriteRig(rig), name);
  }
  for (const std::string& entry : changes.effects) AddEffect(name, entry, rig);
  std::string text = configuration::WriteRig(rig);
  if (!changes.effects.empty()) rig = configuration::ParseRig(text, name + " with --effect");
  return {std::move(rig), std::move(text)};
}

}  // namespace levitas::cli
