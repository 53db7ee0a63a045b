#pragma once
// The verdict written for people (a table, no colour) and for programs (JSON, units in the keys, SI
// except rpm and percent-free shares).
//
// Width    at most 100 columns while bearing names have at most 9 letters; longer names widen it.
// Thread   any. Failure: none.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "verdict/verdict.hpp"

namespace levitas::verdict {

/// Lines end with '\n'; the last line is the sentence.
[[nodiscard]] std::string Table(const Verdict& verdict);
/// One object, in the order of the table.
[[nodiscard]] nlohmann::ordered_json Json(const Verdict& verdict);

}  // namespace levitas::verdict
