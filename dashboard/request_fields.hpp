#pragma once
// Reads the fields of a request one by one and names the first that cannot be used: what is
// missing, of the wrong kind, out of range, or unknown.
//
// Failure   std::invalid_argument with one sentence. Thread any.

#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace levitas::dashboard {

/// An object, or a refusal of what is none. Nothing that is nested deeper than kDeepest is read.
[[nodiscard]] nlohmann::json ParseRequest(const std::string& body);

/// Refuses a key that is not in the list.
void RefuseUnknownKeys(const nlohmann::json& request, std::initializer_list<std::string_view> keys);

/// Finite and within [least, most].
[[nodiscard]] double NumberIn(const nlohmann::json& request, const char* key, double least,
                              double most);
[[nodiscard]] std::string TextIn(const nlohmann::json& request, const char* key);
/// Place of the text among the choices.
[[nodiscard]] std::size_t ChoiceIn(const nlohmann::json& request, const char* key,
                                   std::initializer_list<std::string_view> choices);

}  // namespace levitas::dashboard
