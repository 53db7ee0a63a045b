#pragma once
// The files that come with the program.
//
// Thread   any. Failure: none; an installation without its files has no names.

#include <string>
#include <vector>

namespace levitas::configuration {

/// Names, sorted, of the shipped files of a kind: "rigs", "controllers", "scenarios".
[[nodiscard]] std::vector<std::string> ShippedNames(const std::string& kind);

}  // namespace levitas::configuration
