#pragma once
// Agreement of a prediction (diagnosis/isolability) with what the diagnosis answered.
//
// Kind     of an answer: the hidden effect is named first and alone; is among what is named or
//          tied; something else is named; nothing is. Verdict `suspected` names, `unknown` does
//          not.
// Agrees   the kinds are the same. That of a foretold tie also where the hidden effect is not the
//          first of the tied ones.
// Entries  of the hidden effect's row of the matrix: for every other effect, whether it is named
//          beside or instead of the hidden one; and whether anything is.
// Thread   any; pure.

#include <string>
#include <vector>

#include "diagnosis/isolability/separation.hpp"

namespace levitas::accuracy {

/// First cause and what is tied with it; empty when nothing is named.
[[nodiscard]] std::vector<effect::Id> NamedOrTied(const std::string& verdict,
                                                  const std::vector<effect::Id>& named,
                                                  const std::vector<effect::Id>& ties);

[[nodiscard]] diagnosis::Isolation KindOf(effect::Id hidden,
                                          const std::vector<effect::Id>& named_or_tied) noexcept;

/// What a prediction says would be named or tied.
[[nodiscard]] std::vector<effect::Id> Foretold(const diagnosis::Prediction& prediction);

struct RowEntries {
  std::size_t all{}, right{};
};

/// Over the hidden effect itself and the prediction's alternatives.
[[nodiscard]] RowEntries CompareRow(const diagnosis::Prediction& prediction,
                                    const std::vector<effect::Id>& named_or_tied);

}  // namespace levitas::accuracy
