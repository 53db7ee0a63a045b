#pragma once
// S_ii over frequency with its phase, for pictures: |S|, and the loop L_i = 1/S_ii - 1 about -1.
//
// Grid     that on which analysis/sensitivity.hpp seeks the peaks, 0.1 Hz to half the sampling
//          rate, and denser wherever the loop would have corners. The curve's largest point may be
//          a little below the refined peak.
// Thread   any; allocates. Failure: BadInput when the law's axes do not fit the plant's.

#include <complex>
#include <vector>

#include "controller/law/law_config.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct SensitivityCurves {
  std::vector<double> frequency_hz;
  std::vector<std::vector<std::complex<double>>> axes;  ///< one per axis, one value per frequency
};

[[nodiscard]] SensitivityCurves CurvesOf(const plant::PlantConfig& plant, const law::LawConfig& law,
                                         double speed_rad_per_s);

}  // namespace levitas::analysis
