#pragma once
// What a run left unused: current of the magnets, orbit above the noise of the probes, damping of
// the loop. Reported, not judged.
//
// Current  largest |control current| of the judged cycles over min(i0, i_max - i0), which keeps
//          both coils of an axis in their range; the axis and phase with the largest share.
// Noise    rms of a bearing's two probes by the rig file, sqrt(nx^2 + ny^2), white noise and the
//          step of the converter (step^2 / 12); over the rms radius of the orbit standing, or
//          spinning where it never stood. The law answers noise with current, so that a share near
//          one says that a better probe, not another law, would make the orbit smaller.
// Damping  least damping ratio of the closed-loop poles that oscillate, at the speeds at which the
//          sensitivity was computed (0, top of the run, worst between); from the model.
// Modes    the same of each resonant pole (damping ratio below 1/sqrt(2)), followed over the speeds
//          of the run (analysis/critical_speeds.hpp); forward and backward whirl that are one at
//          rest count as one mode.
// Units    SI. Thread: any, offline. Failure: what a run does not hold is left empty.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "configuration/rig_file.hpp"
#include "verdict/session_statistics.hpp"

namespace levitas::verdict {

struct CurrentReserve {
  std::string axis;
  bool spinning{};
  double peak_a{};
  double limit_a{};
  double share{};  ///< [1] used
};

struct LeastDamping {
  double damping_ratio{};
  double frequency_hz{};  ///< signed: forward positive
  double speed_rad_per_s{};
};

struct ModeDamping {
  double at_rest_hz{};  ///< where it is first found, without sign
  LeastDamping least;   ///< frequency without sign
};

/// Per bearing [m]; see the head.
[[nodiscard]] std::vector<double> ProbeNoise(const plant::PlantConfig& plant);

/// Empty where no cycle was judged.
[[nodiscard]] std::optional<CurrentReserve> CurrentUse(const RigNumbers& rig,
                                                       const SessionFigures& session);

/// Empty without a speed, or where nothing oscillates.
[[nodiscard]] std::optional<LeastDamping> DampingOver(
    std::span<const analysis::SensitivityResult> speeds, const plant::PlantConfig& plant,
    const law::LawConfig& law);

/// By rising frequency at rest.
[[nodiscard]] std::vector<ModeDamping> DampingOfModes(const plant::PlantConfig& plant,
                                                      const law::LawConfig& law,
                                                      double top_rad_per_s);

}  // namespace levitas::verdict
