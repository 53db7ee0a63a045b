#pragma once
// Condition of geared shafts from a record at a held speed: what turns with a wheel and is neither
// the regular engagement of the teeth nor what its shaft does once, twice or three times a turn.
// A tooth that is unlike its neighbours (a crack, a spall) makes it: a pulse once a turn.
//
// Average   synchronous with the wheels: over one repeat of all shafts (T turns of the first) the
//           orbits r = x + jy are sampled anew at even angles, c_m their Fourier coefficients in
//           multiples m of a turn in T, forward and backward; mean and scatter over the repeats.
// Residual  of a shaft that turns n times in a repeat: the lines m = k n without those of the
//           mesh (i M and up to two turns of either shaft about it), without 1, 2 and 3 times any
//           shaft's rotation, and without what is also a multiple of another shaft's. A shaft whose
//           every multiple is one of another's (ratio 2) keeps those and says so: `shared`.
// Energy    E = sum over lines and bearings of |mean c_m|^2 - s^2/R,  s^2 the scatter of R repeats:
//           0 on average where there is noise alone, and then as often below. Its deviation
//           follows from the same scatter: v^2 R/(R - 1) + 2 |c|^2 v per line, v = s^2/R.
// FM4       N sum d^4/(sum d^2)^2 of the residual d over one turn, x and y together (Zakrajsek,
//           Townsend & Decker 1993, NASA TM-105950): 3 for noise, less for a steady line, more for
//           a pulse. Deviation by leaving out one repeat at a time (Efron 1982).
// Source    McFadden 1986, J. Vib. Acoust. 108(2) 165; Stewart 1977, ISVR report MHM/R/10/77.
// Units     SI. Thread: any; offline. Failure: std::invalid_argument for a rig without gears.
// Not done  which tooth; resampling of orbits above an eighth of the sampling rate.

#include <cstddef>
#include <string>
#include <vector>

#include "plant_sim/plant/plant_config.hpp"
#include "session/exchange/recording.hpp"

namespace levitas::analysis {

/// Rows that turn at one speed within 0.5 %, levitated, without a test signal or a missing cycle.
struct HeldSpeed {
  session::RowRange rows;
  double speed_rad_per_s{};  ///< mean, of the first shaft
};

/// What passes after a speed was reached, [s].
inline constexpr double kSettleAtSpeedS = 0.3;

/// Stretches of at least `least_s` behind what passes, in the order of the record.
[[nodiscard]] std::vector<HeldSpeed> HeldSpeeds(const session::Recording& recording,
                                                double least_s);

/// A value with the deviation that the scatter from repeat to repeat leaves in it.
struct Measured {
  double value{};
  double deviation{};
};

/// Of one shaft that carries a wheel.
struct ShaftCondition {
  std::size_t shaft{};
  std::string wheels;               ///< "driven wheel of mesh", for people
  std::vector<std::size_t> shared;  ///< shafts whose multiples include all of this one's
  std::vector<double> line_m2;      ///< unbiased energy of each line
  Measured energy_m2;               ///< their sum
  Measured fm4;
  double once_m{};  ///< rms over the bearings of its line at once a turn, to either side

  /// Root of the energy, 0 where that is not above 0 [m].
  [[nodiscard]] double Amplitude() const noexcept;
};

struct GearCondition {
  double speed_rad_per_s{};
  std::size_t repeats{};
  double mesh_m{};  ///< rms of all lines at multiples of the meshes
  std::vector<double> mean_position_m, mean_current_a;  ///< per axis
  std::vector<ShaftCondition> shafts;
};

/// Least repeats for a scatter that is worth its name.
inline constexpr std::size_t kLeastRepeats = 5;

/// Time of one repeat [s].
[[nodiscard]] double RepeatSeconds(const plant::PlantConfig& rig, double speed_rad_per_s);

/// `rows` must hold kLeastRepeats; fewer give no shafts.
[[nodiscard]] GearCondition MeasureGears(const session::Recording& recording, const HeldSpeed& held,
                                         const plant::PlantConfig& rig);

}  // namespace levitas::analysis
