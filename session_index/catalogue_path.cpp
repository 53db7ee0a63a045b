#include "session_index/catalogue_path.hpp"

#include <cstdlib>

namespace levitas::session_index {

std::optional<std::string> CataloguePath() {
  if (const char* told = std::getenv("LEVITAS_CATALOGUE"); told != nullptr) {
    return *told == '\0' ? std::nullopt : std::optional<std::string>(told);
  }
  if (const char* data = std::getenv("XDG_DATA_HOME"); data != nullptr && *data == '/') {
    return std::string(data) + "/levitas/sessions.db";
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    return std::string(home) + "/.local/share/levitas/sessions.db";
  }
  return std::nullopt;
}

}  // namespace levitas::session_index
