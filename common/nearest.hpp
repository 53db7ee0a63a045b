#pragma once
// "Did you mean": edit distance between a found word and the words allowed.

#include <span>
#include <string>
#include <string_view>

namespace levitas {

/// Levenshtein distance: insertions, deletions, substitutions of one character.
[[nodiscard]] std::size_t EditDistance(std::string_view a, std::string_view b);

/// The allowed word nearest to `found` (the first of equals); empty when there is none.
[[nodiscard]] std::string Nearest(std::string_view found, std::span<const std::string> allowed);

/// The same among the words that begin with `found`, if there are any; else of all of them, but
/// empty when even the nearest is too far away to have been meant.
[[nodiscard]] std::string LikelyMeant(std::string_view found, std::span<const std::string> allowed);

/// "a, b, c".
[[nodiscard]] std::string Listed(std::span<const std::string> words);

}  // namespace levitas
