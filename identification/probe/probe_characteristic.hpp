#pragma once
// Static characteristic of a probe from a table of a positioning platform: gain, offset, curvature,
// hysteresis, repeatability, and the points that a rig file takes.
//
// Equation     reading = offset + gain (x + a2 x^2 + a3 x^3) + d h/2, x the platform's place,
//              d = +1 while it moves towards +x and -1 while it moves back; h only where the table
//              has both ways. Linear least squares in offset, gain, gain a2, gain a3, h; standard
//              deviations of a2 and a3 by their slopes. Residuals are taken as independent and of
//              one size, the platform as exact.
// Places       the way is divided into at most `most_places` equal parts; the rows in one are a
//              place. A way turns where the platform has come back by more than half a part.
// Repeatability  standard deviation of the rows of one place and one way about their mean, pooled;
//              about a line where the rows lie apart within the place, which takes three of them.
// Suffices     whether the cubic describes the probe: no place's mean off by more than its rows
//              scatter. Not judged where nothing was repeated: then nothing says what is noise.
// Straight     from where to where gain and offset alone are off by `straight_error_m` at most,
//              by the fitted curve, within the table.
// Points       means of the places without offset and hysteresis, (0, 0) among them, both columns
//              ascending (plant_sim/sensor/characteristic.hpp). Readings in V are divided by gain.
//              Offset and gain of the cubic; where it does not suffice those of the straight line
//              through the five places nearest to the centre.
// Thread       any. Failure: BadInput: fewer than kLeastPlaces places, a centre that is not in the
//              table, a reading that does not rise with the displacement.
// Not done     temperature, the target's material, tilt; the platform's own error.

#include <optional>
#include <string>
#include <vector>

#include "identification/nonlinear/hammerstein_wiener.hpp"
#include "identification/probe/platform_table.hpp"
#include "plant_sim/sensor/probe_point.hpp"

namespace levitas::identification {

struct ProbeFitOptions {
  std::size_t most_places{50};
  double straight_error_m{1e-6};
};

struct Estimate {
  double value{};
  double deviation{};  ///< one standard deviation
};

struct ProbeCharacteristic {
  static constexpr std::size_t kLeastPlaces = 6;

  bool volts{};
  Estimate offset;                           ///< m, or V: the reading at displacement 0
  Estimate gain;                             ///< [1], or V/m: slope there
  Estimate a2;                               ///< 1/m
  Estimate a3;                               ///< 1/m^2
  std::optional<Estimate> hysteresis;        ///< h in the unit of the reading; empty: one way only
  std::optional<double> largest_hysteresis;  ///< of any place that was visited both ways
  std::optional<double> repeatability;       ///< empty: no place has two rows of one way
  double residual{};                         ///< rms of the fit, in the unit of the reading
  double largest_misfit{};                   ///< of a place's mean against the cubic
  std::optional<bool> cubic_suffices;        ///< empty: nothing was repeated
  double points_offset{}, points_gain{};     ///< that the points were made with, as offset and gain
  double low_m{}, high_m{};                  ///< of the table
  double straight_low_m{}, straight_high_m{};
  double largest_curvature_m{};  ///< of gain and offset alone, within the table
  std::size_t rows{}, places{};
  std::vector<sensor::ProbePoint> points;

  [[nodiscard]] SensorCharacteristic Cubic() const noexcept { return {a2.value, a3.value}; }
};

/// `name` begins a message: the file.
[[nodiscard]] ProbeCharacteristic FitProbe(const PlatformTable& table, const std::string& name,
                                           const ProbeFitOptions& options = {});

}  // namespace levitas::identification
