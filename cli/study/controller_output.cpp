#include "cli/study/controller_output.hpp"

#include "cli/text_file.hpp"

namespace levitas::cli {

void WriteControllerFile(const std::string& path, const std::string& head,
                         const configuration::ControllerFile& controller, const RigNumbers& rig) {
  const std::string text = head + configuration::WriteController(controller, rig);
  (void)configuration::ParseController(text, path + " (not written)", rig);
  WriteTextFile(path, text);
}

}  // namespace levitas::cli
