#include "configuration/run_files.hpp"

#include <filesystem>

#include "common/problem.hpp"

namespace levitas::configuration {
namespace {

/// With a slash it is a path beside the rig's file; without one, the name of a shipped file.
std::string FindOwn(const std::string& key, const std::string& name, const std::string& kind) {
  std::error_code none;
  const bool path = name.find('/') != std::string::npos;
  if (path && std::filesystem::is_regular_file(name, none)) return name;
  const std::string where = "run." + key + " of the rig file: ";
  if (path) {
    throw BadInput(where + name +
                   ": no such file; a path in a rig file counts from the folder of that " +
                   "file. Give one with --" + key + ", or correct the key");
  }
  try {
    return FindConfig(name, kind);
  } catch (const BadInput& problem) {
    throw BadInput(where + problem.what() + "; of a file beside the rig file write ./" + name);
  }
}

std::string Find(const std::string& key, const std::string& own, const std::string& given,
                 const std::string& otherwise) {
  const std::string kind = key + "s";
  if (!given.empty()) return FindConfig(given, kind);
  return own.empty() ? FindConfig(otherwise, kind) : FindOwn(key, own, kind);
}

}  // namespace

std::string FindController(const RunDefaults& rig, const std::string& given,
                           const std::string& otherwise) {
  return Find("controller", rig.controller, given, otherwise);
}

ControllerFile LoadFound(const std::string& path, const RigFile& rig, const std::string& given) {
  if (!given.empty() || !rig.run.controller.empty()) return LoadController(path, rig.numbers);
  try {
    return LoadController(path, rig.numbers);
  } catch (const BadInput&) {
    throw BadInput("the rig file of " + rig.numbers.name +
                   " names no controller (run.controller), and the usual one is not for its "
                   "bearings: give one with --controller, or write run: {controller: ./FILE.yaml} "
                   "into the rig file, with FILE.yaml beside it");
  }
}

std::string FindScenario(const RunDefaults& rig, const std::string& given,
                         const std::string& otherwise) {
  return Find("scenario", rig.scenario, given, otherwise);
}

}  // namespace levitas::configuration
