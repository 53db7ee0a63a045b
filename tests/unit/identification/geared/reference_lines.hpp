#pragma once
// The exact lines of a geared rotor that an independent program computed, and what is known of its
// rig beforehand: tests/data/reference/README.md.

#include <vector>

#include "identification/geared/full_spectrum.hpp"
#include "tests/support/paths.hpp"

namespace levitas::identification {

inline const GearedKnown kKnown{{2.0, 60.0, 2.0e5}, {3.5, 80.0, 2.4e5}, {}, 0.0};

inline std::vector<GearedLine> Reference() {
  return ReadGearedLines(test::DataFolder() + "/reference/geared_rotor_4dof_lines.csv");
}

}  // namespace levitas::identification
