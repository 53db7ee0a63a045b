#pragma once
// How much of what a model leaves a whitening filter takes away.
//
// Why      what is left is nearly white here (1.0 to 1.1 times): a filter that takes more away
//          holds a fault.
// Thread   any; pure.

#include "diagnosis/model/normal_equations.hpp"

namespace levitas::diagnosis {

/// Times from which a fault, or an orbit, is loud enough to be held.
inline constexpr double kLoud = 1.5;

/// Whether the rms of what is left is `times` that behind the filter, on some axis. `plain`: a
/// filter of order 0 of the same runs. Every filter begins with one over the rms of what it leaves.
[[nodiscard]] inline bool TakesAway(const Whitener& filter, const Whitener& plain, double times) {
  for (std::size_t a = 0; a < filter.filter.size(); ++a) {
    if (filter.filter[a].front() > times * plain.filter[a].front()) return true;
  }
  return false;
}

}  // namespace levitas::diagnosis
