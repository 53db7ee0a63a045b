#pragma once
// The rig as a record measured it, for a T that no rig file is needed for.
//
// Equation   P(j w) from the command of a sample to the position read at the sample, line by line
//            (identification/frf/frequency_response.hpp); with the law's own C(z) the answer of a
//            block is S = (I + P C)^-1 or S P (docs/derivations.md, N3 and N4).
// Between    lines: on the straight line between the two beside the frequency, each the mean of its
//            neighbours within kSmoothed of it. Speeds: on the straight line between two records,
//            that of the nearest beyond them: P changes with speed by gyroscopic moments only.
// Failure    BadInput where no line is near a frequency that is asked for.
// Thread     any; pure.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "analysis/sampled_loop.hpp"
#include "controller/synchronous/synchronous_config.hpp"

namespace levitas::design {

struct MeasuredPlant {
  double speed_rad_per_s{};
  std::vector<double> frequency_hz;     ///< rising
  std::vector<Eigen::MatrixXcd> plant;  ///< per line [m/A]
};

/// Of the frequency: lines so near to one that P is the same but for its noise.
inline constexpr double kSmoothed = 0.01;

/// `records` by rising speed, at least one.
[[nodiscard]] Eigen::MatrixXcd PlantAt(std::span<const MeasuredPlant> records,
                                       double speed_rad_per_s, double frequency_hz);

/// What a block's amplitudes are answered with; of `loop` the law alone counts.
[[nodiscard]] Eigen::MatrixXcd MeasuredAnswer(std::span<const MeasuredPlant> records,
                                              const analysis::SampledLoop& loop,
                                              const synchronous::BlockConfig& block,
                                              double speed_rad_per_s);

}  // namespace levitas::design
