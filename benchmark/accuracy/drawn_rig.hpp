#pragma once
// A rig that nobody has tuned anything on: rotor, magnets, probe noise and law drawn from a seed.
//
// Rotor   that of the rig file, or one of three that are not shipped (machine with a disc between
//         its bearings, overhung disc on a stiff shaft, short spindle), lengths off by up to a
//         tenth.
// Magnets ki i0 log-uniform 5 to 500 N, ks = ki i0/s0. Density and Young's modulus are scaled
//         together: the rotor's weight suits the magnets and its modes keep their frequency.
// Probes  noise log-uniform 0.05 to 3 um, converters of 18 bits.
// Law     the rig file's rotor keeps its shipped laws (they scale with the weight). The others have
//         a PD law of textbook gains, Kp = 2 ks/ki, Kd for a damping ratio of 0.6, with a slow
//         integrator. What does not levitate is drawn anew.
// Tolerances  of unbalance and static load follow the weight, and so do the deviations of the rig.
// For     a flexible shaft on two bearings; any other rig stays as it is.
// Thread  any; no shared state.

#include "benchmark/accuracy/trial.hpp"
#include "common/random.hpp"

namespace levitas::accuracy {

inline constexpr double kLeastNoiseM = 0.05e-6, kMostNoiseM = 3e-6;
inline constexpr double kLeastForceN = 5.0, kMostForceN = 500.0;

/// True for rigs that DrawRig can change.
[[nodiscard]] bool CanBeDrawn(const configuration::RigFile& rig) noexcept;

/// Whether it levitates is not known yet.
[[nodiscard]] TestRig DrawRig(const TestRig& shipped, Random& random);

/// The trial of `plan` on a rig drawn from its seed: the first draw on which it levitates. BadInput
/// when none of many does.
[[nodiscard]] Trial MakeDrawnTrial(const TestRig& shipped, const TrialPlan& plan);

}  // namespace levitas::accuracy
