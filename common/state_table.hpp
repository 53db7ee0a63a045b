#pragma once
// Search in a state machine that is written as a table of edges.
//
// Edge    anything with `from` and `event`; a table holds each pair at most once.
// Thread  any; pure, no allocation.

namespace levitas {

/// The edge of (state, event), or nullptr.
template <class Edges, class State, class Event>
[[nodiscard]] constexpr const typename Edges::value_type* FindEdgeIn(const Edges& edges,
                                                                     State state,
                                                                     Event event) noexcept {
  for (const auto& edge : edges) {
    if (edge.from == state && edge.event == event) return &edge;
  }
  return nullptr;
}

}  // namespace levitas
