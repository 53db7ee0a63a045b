#pragma once
// Texts of a state machine that is written as a table of edges: names of its enumerations, rows of
// Markdown and the diagram (Mermaid) of docs/safety.md.
//
// Edge      anything with from, event, to, action and perhaps a guard, whose enumerations have a
//           function Name beside them; the guard of value 0 always holds and is not drawn.
// Thread    any. NameIn allocates nothing; the others are for documents and allocate.

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace levitas {

/// "invalid" beyond the end.
template <class Enum, std::size_t kCount>
[[nodiscard]] constexpr std::string_view NameIn(const std::array<std::string_view, kCount>& names,
                                                Enum value) noexcept {
  const auto index = static_cast<std::size_t>(value);
  return index < kCount ? names[index] : "invalid";
}

[[nodiscard]] inline std::string MarkdownRow(std::initializer_list<std::string_view> cells) {
  std::string text = "|";
  for (const std::string_view cell : cells) text.append(" ").append(cell).append(" |");
  return text + "\n";
}
/// The line under a head of `columns` cells.
[[nodiscard]] inline std::string MarkdownRule(std::size_t columns) {
  std::string text = "|";
  for (std::size_t column = 0; column < columns; ++column) text += "---|";
  return text + "\n";
}

/// `first`: where the machine begins. A state that no edge leaves, at most one, is where it ends.
template <class State, class Edges>
[[nodiscard]] std::string StateDiagram(State first, const Edges& edges) {
  std::string text = "```mermaid\nstateDiagram-v2\n  [*] --> ";
  text.append(Name(first)).append("\n");
  for (const auto& edge : edges) {
    text.append("  ").append(Name(edge.from)).append(" --> ").append(Name(edge.to));
    text.append(" : ").append(Name(edge.event));
    if constexpr (requires { edge.guard; }) {
      if (static_cast<std::size_t>(edge.guard) != 0) {
        text.append(" [").append(Name(edge.guard)).append("]");
      }
    }
    text += "\n";
  }
  std::string ends;
  for (const auto& edge : edges) {
    const bool left = std::any_of(edges.begin(), edges.end(),
                                  [&edge](const auto& other) { return other.from == edge.to; });
    if (!left) ends = std::string("  ").append(Name(edge.to)).append(" --> [*]\n");
  }
  return text.append(ends).append("```\n");
}

template <class Edges>
[[nodiscard]] std::string EdgeRows(const Edges& edges) {
  constexpr bool kGuarded = requires { edges[0].guard; };
  std::string text = kGuarded ? MarkdownRow({"from", "event", "only if", "to", "action"})
                              : MarkdownRow({"from", "event", "to", "action"});
  text += MarkdownRule(kGuarded ? 5 : 4);
  for (const auto& edge : edges) {
    if constexpr (kGuarded) {
      text += MarkdownRow(
          {Name(edge.from), Name(edge.event), Name(edge.guard), Name(edge.to), Name(edge.action)});
    } else {
      text += MarkdownRow({Name(edge.from), Name(edge.event), Name(edge.to), Name(edge.action)});
    }
  }
  return text;
}

}  // namespace levitas
