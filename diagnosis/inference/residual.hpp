#pragma once
// Residual analysis after calibration and causes: excess power by channel, band and order of
// rotation, and the signals it is coherent with.
//
// Power      of the innovations relative to the sensors' own noise, in third-octave bands and
//            single lines; a line counts half, because there are many of them. The noise is taken
//            from the highest third of the spectrum, where neither rotor nor magnet moves; a
//            correct model leaves no band above it.
// Coherence  of the residual with the control currents, the positions, the rotation (orders 1 to 6)
//            and the mains (50, 60 Hz and multiples): the one that most of its excess follows.
// Thread     any.

#include <string>
#include <vector>

#include "diagnosis/model/model_run.hpp"

namespace levitas::diagnosis {

struct ChannelResidual {
  double noise_rms_m{};       ///< from the upper third of the spectrum
  double sigma{};             ///< excess of the worst band, in standard deviations
  double band_ratio{};        ///< power there over the noise's
  double peak_hz{};           ///< where
  std::vector<double> ratio;  ///< power over noise, line by line
};

struct Residual {
  std::vector<ChannelResidual> channels;
  double line_spacing_hz{};
  std::size_t worst_channel{};
  double sigma{};         ///< of the worst channel
  double frequency_hz{};  ///< of its excess
  double order{};         ///< of rotation; 0 = not bound to it
  std::string coherent_with{"nothing"};
};

[[nodiscard]] Residual AnalyseResidual(const RigView& rig, const std::vector<Trajectory>& runs);

/// Why nothing can be said of what these runs leave, and what helps: no stretch is long enough, the
/// model left the readings, or there is no noise in them. Empty: something can be said.
[[nodiscard]] std::string WhyNotJudged(const RigView& rig, const std::vector<Trajectory>& runs);

}  // namespace levitas::diagnosis
