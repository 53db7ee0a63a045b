#pragma once
// Levitators with something hidden in them, to try the diagnosis on.
//
// Truth      the rig file off by a standard deviation of its tolerances everywhere, and one effect
//            on top; laws written a second time, with another detail where books differ (softer
//            dead band, two eddy paths, saturation of fourth order, friction with a slope).
// Step       Runge-Kutta of fourth order, 50 us, where the diagnosis steps once a period.
// Records    steps and sines of 2 mm with a random signal, the lower coil idle in one record and
//            excited in the next; 16 um and 6 mA of noise, converters as of the logs.
// Failure    `stable` false when the ball was lost. Thread: any; same seed, same bits.

#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/levitator/series.hpp"

namespace levitas::accuracy {

/// What one can be asked to hide: effect and its clear size.
struct LevitatorEffect {
  const char* id;
  double size;
};

[[nodiscard]] const std::vector<LevitatorEffect>& LevitatorEffects();

struct LevitatorTrial {
  std::string hidden;  ///< "none", or an id
  double size{};
  std::vector<levitator::Series> records;
  bool stable{true};
};

/// The effect is drawn from the seed; `hidden` names it instead, "none" for a healthy rig.
[[nodiscard]] LevitatorTrial MakeLevitatorTrial(const configuration::RigFile& rig,
                                                std::uint64_t seed, const std::string& hidden = {});

}  // namespace levitas::accuracy
