#pragma once
// A first rig from the few numbers that are known of it: rig file, controller file and scenario
// with a comment behind each number that was assumed.
//
// Rotor     a steel shaft as long as given; its diameter is what the mass asks for, less the discs.
// Unbalance balance grade G 2.5 of ISO 21940-11 at top speed, half of it at each bearing.
// Law       for each bearing the mass m that it carries, a quarter of the rotor at least, against
//           the magnet's own stiffness ks = ki i0 / s0:
//             Kp = r ks / ki,  Kd = 2 zeta sqrt((r - 1) ks m) / ki,  Ki = 5 Kp 1/s,
//           with a lead and notches; start_law.hpp chooses r, zeta and those.
// Limits    objectives: 5 % of the touchdown clearance standing, 30 % spinning (the limit of zone A
//           of ISO 14839-2).
// Failure   BadInput: bearings or discs beyond the shaft, discs heavier than the rotor.
// Thread    any; pure.

#include <string>
#include <vector>

namespace levitas::cli {

/// Between a pole and its magnet's axis, of eight poles evenly spaced, where the coil is given.
inline constexpr double kHalfPoleAngleDeg = 22.5;

struct SketchDisc {
  double z_mm{};
  double mass_kg{};
  double diameter_mm{};
};

struct RigSketch {
  std::string name;
  double mass_kg{};  ///< of all that turns
  double length_mm{};
  double max_speed_rpm{};
  double ki_n_per_a{};  ///< of the coil, where `turns` says it
  double gap_mm{};      ///< at the pole, where the coil is given
  double turns{};       ///< of one coil; 0: the strength is ki
  double pole_area_mm2{};
  double bias_a{};
  double rate_hz{10'000.0};
  double delay_samples{1.0};
  double amplifier_hz{1'000.0};
  bool vertical{};
  std::vector<double> bearings_mm;  ///< two places; empty: at 15 and 85 % of the length
  std::vector<SketchDisc> discs;
};

/// Form of the law that a sketch starts with.
struct StartLaw {
  double stiffness{2.0};  ///< r: of Kp ki over ks
  double damping{0.7};    ///< zeta
  bool lead{};            ///< from 0.05 to 0.15 of the rate
  std::vector<double> notch_hz;
};

/// What follows from a sketch.
struct SketchNumbers {
  double shaft_mass_kg{};
  double diameter_mm{};
  double centre_mm{};               ///< of mass, from the drive end
  std::vector<double> bearings_mm;  ///< magnets, from the drive end
  std::vector<double> carried_kg;   ///< by each bearing, by the lever
  double ks_n_per_m{};              ///< of each magnet
  double clearance_um{};            ///< touchdown: half the gap
};

[[nodiscard]] SketchNumbers NumbersOf(const RigSketch& sketch);
/// Of the drive [rpm/s].
[[nodiscard]] double SketchAcceleration(const RigSketch& sketch);
/// How long a step waits for a speed [s].
[[nodiscard]] double SketchPatience(const RigSketch& sketch);

/// Texts of the three files. The rig names the other two by their file names.
[[nodiscard]] std::string SketchRig(const RigSketch& sketch, const std::string& controller_file,
                                    const std::string& scenario_file);
[[nodiscard]] std::string SketchController(const RigSketch& sketch, const StartLaw& law);
[[nodiscard]] std::string SketchScenario(const RigSketch& sketch);

}  // namespace levitas::cli
