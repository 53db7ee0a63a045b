#pragma once
// Coil currents of a rig whose coils are on a voltage: what its model makes of the recorded
// commands at the recorded positions, beside what was measured.
//
// Model      amplifier::VoltageCoil per coil (plant_sim/amplifier/voltage_coil.hpp), free running:
//            it starts from the first measured current and never sees another. The gap is that of
//            the recorded position, in the middle of each period the mean of its ends; the command
//            acts after the delay of the rig file, fractions of a sample included.
// Fit        100 % (1 - |measured - predicted| / |measured - its mean|): 100 is perfect, 0 as good
//            as the mean, below worse than that.
// Units      A, m, s. After a gap in the record the model starts anew.
// Failure    BadInput when the rig has no such coils or the rows no measured currents.
// Thread     any.

#include <string>
#include <vector>

#include "analysis/records/innovations.hpp"
#include "plant_sim/plant/plant_config.hpp"

namespace levitas::analysis {

struct CoilFit {
  std::string coil;  ///< "ball_x towards +"
  double fit_percent{};
  double measured_mean_a{};
  double predicted_mean_a{};
  double error_rms_a{};
};

/// Row by row, in the order of RecordedRow::coil_current_a.
using CoilCurrents = std::vector<std::array<double, 2 * kMaxAxes>>;

[[nodiscard]] CoilCurrents PredictCoilCurrents(const plant::PlantConfig& rig,
                                               const std::vector<RecordedRow>& rows);

/// Of every coil, over the rows later than `from_s` after the first.
[[nodiscard]] std::vector<CoilFit> FitCoils(const std::vector<RecordedRow>& rows,
                                            const CoilCurrents& predicted, double period_s,
                                            double from_s,
                                            const std::vector<std::string>& channels);

}  // namespace levitas::analysis
