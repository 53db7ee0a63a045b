#pragma once
// What a record's columns have to be taken for, so that they are those of the rig: the hypothesis
// that a search for errors of a record tries, and what a corrected map of columns says.
//
// Equation   quantity of axis a = factor * column[from](n + late): `from` counts the rig's axes by
//            the names that the columns have now, `late` is by how many rows the column is behind.
// Frame      bearing frame. Exchanged wires carry the polarity of the other axis: `factor` has it.
// Thread     plain data.

#include <array>
#include <cstddef>

#include "common/axes.hpp"

namespace levitas::diagnosis {

struct ColumnUse {
  std::size_t from{};
  double factor{1.0};
  int late{};

  [[nodiscard]] bool operator==(const ColumnUse&) const = default;
};

struct ColumnUses {
  ColumnUses() noexcept : position{}, current{} {
    for (std::size_t a = 0; a < kMaxAxes; ++a) position[a].from = current[a].from = a;
  }
  std::array<ColumnUse, kMaxAxes> position;
  std::array<ColumnUse, kMaxAxes> current;

  [[nodiscard]] bool operator==(const ColumnUses&) const = default;
};

}  // namespace levitas::diagnosis
