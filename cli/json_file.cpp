#include "cli/json_file.hpp"

#include <nlohmann/json.hpp>

#include "cli/options/analysis_options.hpp"
#include "cli/text_file.hpp"

namespace levitas::cli {

void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content) {
  if (path.empty()) return;
  WriteTextFile(path, content.dump(2) + '\n');
}

nlohmann::ordered_json LoopJson(const RigNumbers& rig, const FoundController& controller,
                                double delay_s) {
  return {{"rig", rig.name},
          {"controller", controller.file.name},
          {"controller_file", controller.path},
          {"delay_s", delay_s}};
}

}  // namespace levitas::cli
