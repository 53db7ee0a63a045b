#pragma once
// A scenario of test signals for a new rig: what `amb identify modal` and `amb diagnose` ask of a
// record, with amplitudes that its loop bears.
//
// Signal     pseudo-random binary current of +-A on each axis in turn, on a clock of half the rate,
//            four periods of 0.57 to 1.13 s (longer below 1 kHz): at rest and at two speeds, a
//            quarter and half of the top speed, each moved by half at most until it is 12 % away
//            from every critical speed, and left out where they leave no room.
// Amplitude  the smaller of a tenth of the bias current and what moves the rotor by a fifth of the
//            touchdown clearance: 3.3 standard deviations of y = P S d at rest, the deviation from
//            the lines of the sequence, A^2 (N + 1)/N^2 sinc^2(f/f_clock), N = 2^order - 1.
// Orbit      cut back by the controller beyond 0.4 of the clearance, unbalance included.
// Does not   know how the rotor differs from its file: the command says so when it was cut back.
// Cost       about a second. Thread: any. Failure: as analysis::CloseLoop.

#include <string>
#include <vector>

#include "cli/new_rig/rig_sketch.hpp"
#include "configuration/rig_file.hpp"

namespace levitas::cli {

struct TestSignal {
  double amplitude_a{};
  int order{};    ///< of the binary sequence
  int divisor{};  ///< sampling periods a bit
  double orbit_limit_m{};
  std::vector<double> speeds_rad_per_s;  ///< besides rest, ascending; two at most
};

/// `rig` is that of the sketch, `law` one that holds it.
[[nodiscard]] TestSignal TestSignalOf(const configuration::RigFile& rig, const law::LawConfig& law);

/// [s] of the rig's time that the scenario takes, to a second or two.
[[nodiscard]] double DurationOf(const RigSketch& sketch, const configuration::RigFile& rig,
                                const TestSignal& signal);

/// Text of the scenario file.
[[nodiscard]] std::string SketchIdentify(const RigSketch& sketch, const configuration::RigFile& rig,
                                         const TestSignal& signal);

}  // namespace levitas::cli
