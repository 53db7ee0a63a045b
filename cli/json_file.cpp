#include "cli/json_file.hpp"

#include <fmt/core.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/problem.hpp"

namespace levitas::cli {

void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content) {
  if (path.empty()) return;
  std::ofstream file(path);
  file << content.dump(2) << '\n';
  file.flush();
  if (!file) {
    throw BadInput(
        fmt::format("--json {}: cannot be written; check that the folder exists and is yours "
                    "to write to",
                    path));
  }
}

}  // namespace levitas::cli
