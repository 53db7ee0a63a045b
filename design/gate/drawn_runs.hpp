#pragma once
// A law on the nonlinear rig at one speed: contact, saturation, noise, converters, gravity.
//
// Run        the rotor is lifted out of its touchdown bearings in 0.3 s, stands as long, then turns
//            at the speed at once, settles for `settle_s`, is watched for `watch_s`. No supervisor:
//            what it would trip on counts as lost here.
// Run-up     the drive takes the rotor to the speed at the rig's rate instead, and back to rest; a
//            law over speed follows as in the control cycle. All of it is watched.
// Lost       contact, or an orbit beyond half the clearance (what the protections allow).
// Orbit      largest radius of the noise-free sensors per bearing, static offset included.
// Current    amplitude at 1x per axis by correlation over whole turns, and the static part.
// Same seed  same numbers. Thread: any; pure.

#include <complex>
#include <vector>

#include "configuration/rig_file.hpp"

namespace levitas::design {

struct RunOptions {
  double speed_rad_per_s{};
  double settle_s{0.4};
  double watch_s{0.3};
  std::uint64_t seed{1};
  bool run_up{};
  bool keep_orbit{};  ///< the last two turns (standing: 20 ms), for pictures
};

struct RunFigures {
  bool lost{};
  double saturated_share{};            ///< of the watched periods, any axis
  std::vector<double> orbit_m;         ///< per bearing
  std::vector<double> static_a;        ///< per axis
  std::vector<double> synchronous_a;   ///< per axis, 0 at rest
  std::vector<AxisArray> positions_m;  ///< when kept
};

[[nodiscard]] RunFigures RunOnce(const configuration::RigFile& rig, const law::LawConfig& law,
                                 const RunOptions& options);

/// A force of `newtons` at three times the speed, against rotation, at the shaft's drive end: what
/// a misaligned coupling does. Rigs with geared shafts stay as they are.
[[nodiscard]] configuration::RigFile WithThirdHarmonic(const configuration::RigFile& rig,
                                                       double newtons);

}  // namespace levitas::design
