#pragma once
// Sensitivity of the sampled loop, as ISO 14839-3 grades it: stability first, then the peaks.
//
// Equation   S(z) = (I + P(z) C(z))^-1 on the unit circle, z = e^{j w T}: P the sampled plant with
//            its delay, C the discrete law. Axis i: |S_ii|, all loops closed, which is what the
//            standard's measurement (excite one axis, all axes levitated) gives.
// Zones      ISO 14839-3:2006: A below 3, B below 4, C below 5, D from there on.
// Range      0.1 Hz to half the sampling rate; refined around every peak and every lightly damped
//            pole of the closed loop until the peak is known to about 1e-6 of its value.
// Margins    of the loop of one axis with the others closed, L_i = 1/S_ii - 1. An AMB loop is
//            conditionally stable: it has a gain margin towards more and one towards less gain.
//            Crossings are sought from z = 1, where a law without integrator meets the magnet's
//            negative stiffness and a loop too weak is lost, to z = -1.
// Failure    an unstable loop is a result, not an error: peaks are still given, zones are not,
//            since a peak says nothing about a loop that does not settle.
// Thread     any.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "controller/law/law_config.hpp"
#include "plant_sim/plant/operating_point.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct SampledLoop;

enum class Zone : std::uint8_t { kA, kB, kC, kD };
[[nodiscard]] std::string_view Name(Zone zone) noexcept;  ///< "A" .. "D"
[[nodiscard]] Zone ZoneOf(double sensitivity_peak) noexcept;

/// What may happen to one axis' loop before it is at the edge of stability; empty: no crossing.
struct AxisMargins {
  std::optional<double> gain_up;    ///< [1] smallest factor > 1 that reaches the edge
  std::optional<double> gain_down;  ///< [1] largest factor < 1 that reaches the edge
  std::optional<double> phase_rad;  ///< smallest distance to -180 degrees where |L| = 1
  std::optional<double> phase_at_hz;
};

struct AxisSensitivity {
  double peak{};             ///< [1] max |S_ii|
  double frequency_hz{};     ///< where
  std::optional<Zone> zone;  ///< empty when the loop is unstable
  AxisMargins margins;       ///< empty when the loop is unstable
};

struct SensitivityResult {
  double speed_rad_per_s{};
  bool stable{};                  ///< also: the static load is carried
  plant::OperatingPoint point;    ///< about which the loop is linear
  double largest_pole_modulus{};  ///< [1] of the closed loop; stable below 1
  std::vector<AxisSensitivity> axes;
  double largest_singular_value{};  ///< [1] max over frequency of the norm of S
  double largest_singular_value_hz{};
  std::optional<Zone> zone;  ///< of the worst axis; empty when the loop is unstable
};

/// Throws BadInput when the law's axes do not fit the plant's.
[[nodiscard]] SensitivityResult SensitivityPeaks(const plant::PlantConfig& plant,
                                                 const law::LawConfig& law, double speed_rad_per_s);

/// The same of a loop that is closed already.
[[nodiscard]] SensitivityResult SensitivityPeaks(const SampledLoop& loop, double speed_rad_per_s);

/// |S_ii| at given frequencies, one row per frequency and one entry per axis: for plots and checks.
[[nodiscard]] std::vector<std::vector<double>> SensitivityAt(
    const plant::PlantConfig& plant, const law::LawConfig& law, double speed_rad_per_s,
    const std::vector<double>& frequencies_hz);

}  // namespace levitas::analysis
