#include "dashboard/http_answer.hpp"

#include <nlohmann/json.hpp>

namespace levitas::dashboard {

HttpAnswer Answer(int status, const char* outcome, const std::string& text) {
  const nlohmann::json json{{"outcome", outcome}, {"text", text}};
  // A text may quote what a stranger sent: what is no UTF-8 is replaced, not thrown.
  return {status, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

}  // namespace levitas::dashboard
