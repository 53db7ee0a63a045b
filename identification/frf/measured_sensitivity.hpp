#pragma once
// The sensitivity peaks of a levitated rig as ISO 14839-3 asks for them: measured.
//
// Equation   |S_ii| on the lines of a frequency response (one axis excited, all levitated); its
//            largest value among the lines that say something: sigma of the mean below a tenth of
//            |S_ii|. sigma from the scatter over the periods, smoothed over neighbouring lines.
// Grade      ISO 14839-3, refused with the reason where the lines do not carry it: fewer than
//            twenty or half of them clear, too far apart at the peak (a peak narrower than the
//            lines is under-read), or the largest at an end of the lines.
// Thread     any. Failure: none; see `refused`.

#include <optional>
#include <string>
#include <vector>

#include "analysis/sensitivity.hpp"
#include "identification/frf/frequency_response.hpp"

namespace levitas::identification {

struct MeasuredPeak {
  std::string channel;
  double peak{};          ///< max |S_ii| on a clear line
  double sigma{};         ///< standard deviation there
  double frequency_hz{};  ///< of that line
  double spacing_hz{};    ///< to the farther of its neighbours: what is narrower is under-read
  std::optional<analysis::Zone> zone;
  std::string refused;  ///< why there is no zone; empty: there is
};

/// One per axis, in the order of the channels.
[[nodiscard]] std::vector<MeasuredPeak> MeasuredPeaks(const FrequencyResponse& response);

/// Computed and measured peak differ by more than 20 % of the measured one.
[[nodiscard]] bool Disagree(double computed, double measured) noexcept;

}  // namespace levitas::identification
