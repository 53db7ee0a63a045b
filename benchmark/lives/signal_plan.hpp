#pragma once
// Lives in which nothing is wrong but what is asked for: test signals of any kind and strength that
// a file or a request may ask for, on any axes, by a scenario and over the network at once.
//
// Random   from the seed alone. Thread: any; allocates.

#include "benchmark/lives/plan.hpp"
#include "common/random.hpp"

namespace levitas::lives {

/// Any signal that the table of excitations allows on this rig.
[[nodiscard]] scenario::Excitation DrawSignal(Random& random, const RigNumbers& rig);

/// The rotor is lifted, brought to `speed_rpm` by its drive at the highest rate, and excited from
/// 0.3 s after that for 1.5 s.
[[nodiscard]] LifePlan DrawSignals(std::uint64_t seed, double speed_rpm, const RigNumbers& rig);

}  // namespace levitas::lives
