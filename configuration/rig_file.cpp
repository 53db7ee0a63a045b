#include "configuration/rig_file.hpp"

#include <fstream>
#include <sstream>

#include "common/problem.hpp"
#include "configuration/schema/schema.hpp"
#include "configuration/text/reader.hpp"
#include "configuration/text/writer.hpp"

namespace levitas::config {
namespace {

std::string ReadText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  // Reading a folder opens well and then fails, so the read is checked, not only the opening.
  if (file) text << file.rdbuf();
  if (!file || text.fail()) {
    // An empty file makes operator<< fail although nothing is wrong with reading it.
    if (file.is_open() && file.peek() == std::ifstream::traits_type::eof() && !file.bad())
      return {};
    throw BadInput(path + ": cannot be read; give the path of a file");
  }
  return text.str();
}

template <class Value, class Body>
Value Read(const std::string& text, const std::string& file_name, std::string_view kind,
           Body describe) {
  const Document document = ReadDocument(text);
  Reader reader(document, file_name);
  Value value{};
  if (reader.WrongKind(kind)) {
    reader.FinishEarly();
  } else {
    describe(reader, value);
    reader.Finish();
  }
  return value;
}

}  // namespace

RigFile ParseRig(const std::string& text, const std::string& file_name) {
  return Read<RigFile>(text, file_name, "rig", [](Visitor& v, RigFile& rig) { Describe(v, rig); });
}

ControllerFile ParseController(const std::string& text, const std::string& file_name,
                               const RigNumbers& rig) {
  return Read<ControllerFile>(text, file_name, "controller",
                              [&](Visitor& v, ControllerFile& file) { Describe(v, file, rig); });
}

scenario::ScenarioConfig ParseScenario(const std::string& text, const std::string& file_name,
                                       const RigNumbers& rig) {
  return Read<scenario::ScenarioConfig>(
      text, file_name, "scenario",
      [&](Visitor& v, scenario::ScenarioConfig& file) { Describe(v, file, rig); });
}

RigFile LoadRig(const std::string& path) { return ParseRig(ReadText(path), path); }

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

}  // namespace levitas::config
