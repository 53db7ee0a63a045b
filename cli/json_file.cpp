#include "cli/json_file.hpp"

#include <nlohmann/json.hpp>

#include "cli/text_file.hpp"

namespace levitas::cli {

void WriteJsonFile(const std::string& path, const nlohmann::ordered_json& content) {
  if (path.empty()) return;
  WriteTextFile(path, content.dump(2) + '\n');
}

}  // namespace levitas::cli
