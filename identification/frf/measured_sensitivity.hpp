#pragma once
// The sensitivity peaks of a levitated rig as ISO 14839-3 asks for them: measured.
//
// Equation   |S_ii| of a frequency response (one axis excited, all levitated), fitted over
//            neighbouring lines and freed of the noise's share (smoothed_sensitivity.hpp); its
//            largest value at the lines that say something: sigma of the line alone below a tenth
//            of |S_ii|. sigma from the scatter over the periods, smoothed over neighbouring lines.
//            Beside it the largest of the single lines, which noise makes too high: by 5 to 15 %
//            where sigma is a tenth of |S|.
// Grade      ISO 14839-3, refused with the reason where the lines do not carry it: fewer than
//            twenty or half of them clear, too far apart at the peak (a peak narrower than the
//            lines is under-read), or the largest at an end of the lines, unless |S| lies flat
//            towards zero frequency, as it does with a law without integrator.
// Thread     any. Failure: none; see `refused`.

#include <optional>
#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "identification/frf/frequency_response.hpp"

namespace levitas::identification {

struct MeasuredPeak {
  std::string channel;
  double peak{};          ///< max |S_ii| at a clear line
  double sigma{};         ///< standard deviation there
  std::size_t lines{};    ///< over which the value was fitted
  double line_peak{};     ///< the largest single line, noise included
  double line_sigma{};    ///< standard deviation of that line
  double frequency_hz{};  ///< of the peak
  double spacing_hz{};    ///< to the farther of its neighbours: what is narrower is under-read
  std::optional<analysis::Zone> zone;
  std::string refused;  ///< why there is no zone; empty: there is
};

/// One per axis, in the order of the channels.
[[nodiscard]] std::vector<MeasuredPeak> MeasuredPeaks(const FrequencyResponse& response);

/// Computed and measured peak differ by more than 20 % of the measured one.
[[nodiscard]] bool Disagree(double computed, double measured) noexcept;

}  // namespace levitas::identification
