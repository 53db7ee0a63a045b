#include "dashboard/request_fields.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace levitas::dashboard {
namespace {

using nlohmann::json;

constexpr int kDeepest = 4;

}  // namespace

json ParseRequest(const std::string& body) {
  // The depth is judged while reading: a body of brackets alone would else fill the stack.
  const auto shallow = [](int depth, json::parse_event_t, json&) {
    if (depth > kDeepest) throw std::invalid_argument("nested too deeply");
    return true;
  };
  json request = json::parse(body, shallow, false);
  if (request.is_discarded()) throw std::invalid_argument("the request is no JSON");
  if (!request.is_object()) throw std::invalid_argument("the request is no JSON object");
  return request;
}

void RefuseUnknownKeys(const json& request, std::initializer_list<std::string_view> keys) {
  for (const auto& [key, value] : request.items()) {
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      throw std::invalid_argument(
          fmt::format("'{}' is not known here; there are {}", key, fmt::join(keys, ", ")));
    }
  }
}

double NumberIn(const json& request, const char* key, double least, double most) {
  if (!request.contains(key) || !request[key].is_number()) {
    throw std::invalid_argument(fmt::format("{} is missing or no number", key));
  }
  const double value = request[key].get<double>();
  if (!(value >= least && value <= most)) {
    throw std::invalid_argument(
        fmt::format("{} = {:.6g}, allowed {:.6g} to {:.6g}", key, value, least, most));
  }
  return value;
}

std::string TextIn(const json& request, const char* key) {
  if (!request.contains(key) || !request[key].is_string()) {
    throw std::invalid_argument(fmt::format("{} is missing or no text", key));
  }
  return request[key].get<std::string>();
}

std::size_t ChoiceIn(const json& request, const char* key,
                     std::initializer_list<std::string_view> choices) {
  const std::string text = TextIn(request, key);
  const auto at = std::find(choices.begin(), choices.end(), text);
  if (at == choices.end()) {
    throw std::invalid_argument(
        fmt::format("no {} '{}'; there are {}", key, text, fmt::join(choices, ", ")));
  }
  return static_cast<std::size_t>(at - choices.begin());
}

}  // namespace levitas::dashboard
