#include "cli/run/rig_as_run.hpp"

#include <fmt/core.h>

namespace levitas::cli {

RigAsRun ReadRigAsRun(const std::string& path, std::optional<double> bias_current_a) {
  config::RigFile rig = config::LoadRig(path);
  if (!bias_current_a) {
    std::string text = config::WriteRig(rig);
    return {std::move(rig), std::move(text)};
  }
  rig.numbers.bias_current_a = *bias_current_a;
  for (auto& bearing : rig.plant.bearings) bearing.magnet.bias_current_a = *bias_current_a;
  std::string text = config::WriteRig(rig);
  config::RigFile read =
      config::ParseRig(text, fmt::format("{} with --bias-current-a {:g}", path, *bias_current_a));
  return {std::move(read), std::move(text)};
}

}  // namespace levitas::cli
