#include "cli/study/controller_output.hpp"

#include "cli/text_file.hpp"

namespace levitas::cli {

void WriteControllerFile(const std::string& path, const std::string& head,
                         const config::ControllerFile& controller, const RigNumbers& rig) {
  const std::string text = head + config::WriteController(controller, rig);
  (void)config::ParseController(text, path + " (not written)", rig);
  WriteTextFile(path, text);
}

}  // namespace levitas::cli
