// Where the shipped files are.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "common/nearest.hpp"
#include "common/problem.hpp"
#include "configuration/rig_file.hpp"
#include "configuration/shipped_names.hpp"

namespace levitas::configuration {
namespace {

namespace fs = std::filesystem;

/// The folder that holds rigs/, controllers/ and scenarios/: as told, else above the program (a
/// build tree inside the checkout, or an installation with share/levitas), else the sources it was
/// built from, else where the Debian package puts it: for a program of one's own.
fs::path ShippedFolder() {
  if (const char* told = std::getenv("LEVITAS_CONFIG"); told != nullptr && *told != '\0') {
    return told;
  }
  std::error_code none;
  fs::path folder = fs::read_symlink("/proc/self/exe", none).parent_path();
  while (folder.has_relative_path()) {
    for (const fs::path inside : {"config", "share/levitas"}) {
      if (fs::is_directory(folder / inside / "rigs", none)) return folder / inside;
    }
    folder = folder.parent_path();
  }
  return fs::is_directory(LEVITAS_CONFIG_FOLDER, none) ? LEVITAS_CONFIG_FOLDER
                                                       : "/usr/share/levitas";
}

}  // namespace

std::vector<std::string> ShippedNames(const std::string& kind) {
  std::error_code none;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(ShippedFolder() / kind, none)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string FindConfig(const std::string& name, const std::string& kind) {
  std::error_code none;
  if (fs::is_regular_file(name, none)) return name;
  const fs::path folder = ShippedFolder() / kind;
  if (const fs::path shipped = folder / (name + ".yaml"); fs::is_regular_file(shipped, none)) {
    return shipped.string();
  }
  const std::vector<std::string> known = ShippedNames(kind);
  std::string text = name + (fs::is_directory(name, none) ? ": it is a folder" : ": no such file") +
                     ", and none of that name among the " + kind + " in " + folder.string();
  if (!known.empty()) text += " (" + Listed(known) + ")";
  const std::string meant = LikelyMeant(name, known);
  if (!meant.empty()) text += "; nearest " + meant;
  throw BadInput(text);
}

}  // namespace levitas::configuration
