#include "configuration/rig_file.hpp"

#include <array>
#include <filesystem>
#include <fstream>

#include "common/problem.hpp"
#include "configuration/schema/schema.hpp"
#include "configuration/text/read_file.hpp"
#include "configuration/text/writer.hpp"

namespace levitas::configuration {

std::string ReadText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  std::array<char, 65536> block{};
  // One byte more than is allowed is enough to be refused; /dev/zero never ends.
  while (file && text.size() <= kMostBytes) {
    file.read(block.data(), block.size());
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
  }
  // Reading a folder opens well and then fails, so the read is checked, not only the opening.
  if (!file.is_open() || file.bad()) {
    throw BadInput(path + ": cannot be read; give the path of a file");
  }
  return text;
}

RigFile ParseRig(const std::string& text, const std::string& file_name) {
  return ReadAs<RigFile>(text, file_name, "rig",
                         [](Visitor& v, RigFile& rig) { Describe(v, rig); });
}

ControllerFile ParseController(const std::string& text, const std::string& file_name,
                               const RigNumbers& rig) {
  return ReadAs<ControllerFile>(text, file_name, "controller",
                                [&](Visitor& v, ControllerFile& file) { Describe(v, file, rig); });
}

scenario::ScenarioConfig ParseScenario(const std::string& text, const std::string& file_name,
                                       const RigNumbers& rig) {
  return ReadAs<scenario::ScenarioConfig>(
      text, file_name, "scenario",
      [&](Visitor& v, scenario::ScenarioConfig& file) { Describe(v, file, rig); });
}

RigFile LoadRig(const std::string& path) {
  RigFile rig = ParseRig(ReadText(path), path);
  // What a rig names by a path lies beside it. From here on the path is a whole one: the rig is
  // written into sessions and other folders, and read again from anywhere.
  for (std::string* own : {&rig.run.controller, &rig.run.scenario}) {
    const std::filesystem::path named(*own);
    if (own->find('/') == std::string::npos || named.is_absolute()) continue;
    const std::filesystem::path beside = std::filesystem::path(path).parent_path() / named;
    std::error_code unknown;
    const std::filesystem::path whole = std::filesystem::absolute(beside, unknown);
    *own = (unknown ? beside : whole).lexically_normal().string();
  }
  return rig;
}

ControllerFile LoadController(const std::string& path, const RigNumbers& rig) {
  return ParseController(ReadText(path), path, rig);
}

scenario::ScenarioConfig LoadScenario(const std::string& path, const RigNumbers& rig) {
  return ParseScenario(ReadText(path), path, rig);
}

std::string WriteRig(const RigFile& rig) {
  Writer writer("rig");
  RigFile copy = rig;
  Describe(writer, copy);
  return writer.text();
}

std::string WriteController(const ControllerFile& controller, const RigNumbers& rig) {
  Writer writer("controller");
  ControllerFile copy = controller;
  Describe(writer, copy, rig);
  return writer.text();
}

std::string WriteScenario(const scenario::ScenarioConfig& scenario) {
  Writer writer("scenario");
  scenario::ScenarioConfig copy = scenario;
  Describe(writer, copy, RigNumbers{});
  return writer.text();
}

}  // namespace levitas::configuration
