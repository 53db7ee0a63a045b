#pragma once
// What shows in single samples and in the noise, not in the mean motion: lost frames, noise level.
//
// Lost       a cycle missing from the record, a command whose currents all repeat bit for bit, and
//            a frame whose readings do, where that is more than chance (repeated_frames.hpp). What
//            the rig file's own `dropped_samples` explains does not count.
// Noise      the level in the upper third of the spectrum against the rig file's, which a healthy
//            rig keeps within kNoiseTolerance (standard deviation of its logarithm).
// Thread     any; pure.

#include <vector>

#include "diagnosis/inference/diagnose.hpp"

namespace levitas::diagnosis {

inline constexpr double kNoiseTolerance = 0.06;

/// Frames of flight that were to come, those that did not, and the bursts that these make up.
struct LostFrames {
  std::size_t sent{}, lost{}, bursts{};
};
[[nodiscard]] LostFrames CountFrames(const RigView& rig, const std::vector<Record>& records);

/// Causes found this way with their evidence. Noise counts the channels whose own evidence is
/// decisive (kDecisive).
[[nodiscard]] std::vector<Candidate> FindEvents(const RigView& rig,
                                                const std::vector<Record>& records,
                                                const Residual& residual);

}  // namespace levitas::diagnosis
