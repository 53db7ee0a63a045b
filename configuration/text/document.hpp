#pragma once
// A YAML text as a plain tree that remembers where everything stood. The only place that knows the
// YAML library.
//
// Strict   one document; no anchors, aliases or tags (they hide where a number comes from).
// Size     at most kMostBytes: the library takes a second for some MB, and no file of ours has a
//          hundredth of that (a controller of 48 states has 50 kB).
// Lines    and columns count from 1, as editors do.

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace levitas::configuration {

inline constexpr std::size_t kMostBytes = std::size_t{4} << 20;

struct Place {
  int line{1};
  int column{1};
  // Version 14 of the checker takes the comparison for a null pointer.
  friend auto operator<=>(const Place&, const Place&) = default;  // NOLINT(modernize-use-nullptr)
};

struct Node {
  enum class Kind { kEmpty, kScalar, kSequence, kMap };
  Kind kind{Kind::kEmpty};
  Place place;
  std::string text{};                                 ///< scalar
  bool quoted{};                                      ///< scalar in quotes: text, never a number
  std::vector<Node> items{};                          ///< sequence; values of a map
  std::vector<std::pair<std::string, Place>> keys{};  ///< map, beside `items`; duplicates are kept
};

struct SyntaxProblem {
  Place place;
  std::string text;
};

struct Document {
  Node root;
  std::optional<SyntaxProblem> problem;  ///< when set, `root` is not to be used
};

[[nodiscard]] Document ReadDocument(const std::string& text);

}  // namespace levitas::configuration
