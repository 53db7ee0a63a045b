#pragma once
// Growing states of a state-space law that its currents do not show, or its sensors do not reach.
//
// Why        such a state is held by no feedback, however the rotor moves: it overflows after a
//            while, and zero times infinity is not a number in every current. A growing state that
//            is both seen and reached may belong to a sound law (an unstable controller); one that
//            is not, is a slip of the pen or of a reduction.
// Test       Popov-Belevitch-Hautus, pole by pole: the blocks that share a pole are seen exactly
//            when their columns of C are linearly independent, and reached when their rows of B
//            are. Of a pair of states both are taken as one complex number. A column counts as
//            dependent when less than kDependent of its length is left over: rounding of printed
//            coefficients.
// Growing    on or outside the unit circle (in s: on or right of the imaginary axis).
// Thread     any; reads the configuration only, allocates. Failure: none.
// Not done   states that decay: hidden, they are useless but harmless.

#include <cstddef>
#include <vector>

#include "controller/law/law_config.hpp"

namespace levitas::law {

struct GrowingBlock {
  std::size_t block{};  ///< index into StateSpaceConfig::blocks
  bool seen{};          ///< the currents show it
  bool reached{};       ///< the sensors drive it
};

inline constexpr double kDependent = 1e-9;
/// Poles this close to the unit circle count as lying on it: a rounding of 1 in a printed number.
inline constexpr double kOnCircle = 1e-12;

/// Every block with a growing pole, in the order of the configuration.
[[nodiscard]] std::vector<GrowingBlock> GrowingBlocks(const StateSpaceConfig& config);

}  // namespace levitas::law
