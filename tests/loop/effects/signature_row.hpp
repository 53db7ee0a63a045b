#pragma once
// One row of the table of signatures: what an effect changes, where, at which order, which way.

#include <cmath>
#include <functional>
#include <ostream>

#include "plant_sim/effect/catalogue.hpp"

namespace levitas::plant::test {

struct SignatureRow {
  effect::Id id{};
  effect::Place place{};
  const char* order{};  ///< of what shows: "+1x", "2f", "static", "pole" ...
  int sign{};           ///< of what is found
  /// What the rig does with the effect beyond what it does without, from the simulated plant.
  std::function<double()> found;
  double expected{};   ///< closed form
  double tolerance{};  ///< relative; its reason beside the row
  /// Largest of what must not change, as a share of what does; null: the row's own tests say it.
  std::function<double()> beside;
};

inline std::ostream& operator<<(std::ostream& out, const SignatureRow& row) {
  return out << effect::At(row.id).name;
}

}  // namespace levitas::plant::test
