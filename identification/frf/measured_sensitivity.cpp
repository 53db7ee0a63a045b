#include "identification/frf/measured_sensitivity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identification/frf/smoothed_sensitivity.hpp"

namespace levitas::identification {
namespace {

using Index = Eigen::Index;

constexpr double kClearShare = 0.1;
constexpr std::size_t kFewestLines = 20;
/// Lines where a loop can have its peak; beyond, S is one whatever the loop is.
constexpr double kLoopHz = 1000.0;
constexpr double kLeastClearLines = 0.5;
/// Of the peak: when both neighbours are lower, the true peak may be as far above them again.
constexpr double kLeastNeighbour = 0.7;
constexpr double kWidestSpacing = 0.2;  // of the frequency
/// At the lowest line; |S(0)| is then at most 5 % above it.
constexpr double kFlatNeighbour = 0.85;
constexpr double kDisagreement = 0.2;

double Size(const FrequencyResponse& r, std::size_t line, Index axis) {
  return std::abs(r.sensitivity[line](axis, axis));
}

double Sigma(const FrequencyResponse& r, std::size_t line, Index axis) {
  return std::sqrt(r.own_variance[line][axis]);
}

std::vector<std::size_t> ClearLines(const FrequencyResponse& r, Index axis) {
  std::vector<std::size_t> clear;
  for (std::size_t k = 0; k < r.frequency_hz.size(); ++k) {
    if (Sigma(r, k, axis) < kClearShare * Size(r, k, axis)) clear.push_back(k);
  }
  return clear;
}

std::size_t BelowLoop(const FrequencyResponse& r, const std::vector<std::size_t>& lines) {
  return static_cast<std::size_t>(std::count_if(
      lines.begin(), lines.end(), [&](std::size_t k) { return r.frequency_hz[k] < kLoopHz; }));
}

/// The first line is the first multiple of the spacing and the next is nearly as large: |S| is even
/// in the frequency, so that |S(0)| lies above the first by a third of the step to the second.
bool FlatTowardsZero(const FrequencyResponse& r, Index axis,
                     const std::vector<std::size_t>& clear) {
  if (clear.size() < 2 || clear[0] != 0 || clear[1] != 1) return false;
  const double spacing_hz = r.frequency_hz[1] - r.frequency_hz[0];
  return r.frequency_hz[0] < 1.5 * spacing_hz &&
         Size(r, 1, axis) > kFlatNeighbour * Size(r, 0, axis);
}

std::string Objection(const FrequencyResponse& r, Index axis, const std::vector<std::size_t>& clear,
                      std::size_t at, const MeasuredPeak& peak) {
  const auto in_loop = static_cast<std::size_t>(std::count_if(
      r.frequency_hz.begin(), r.frequency_hz.end(), [](double f) { return f < kLoopHz; }));
  const std::size_t said = BelowLoop(r, clear);
  if (said < kFewestLines ||
      static_cast<double>(said) < kLeastClearLines * static_cast<double>(in_loop)) {
    return fmt::format("only {} of {} lines below 1 kHz are clear of noise: excite more, or longer",
                       said, in_loop);
  }
  if ((at == 0 && !FlatTowardsZero(r, axis, clear)) || at + 1 == clear.size()) {
    return "the largest is the first or the last line: excite a wider range";
  }
  if (at == 0) return {};
  const double beside = std::max(Size(r, clear[at - 1], axis), Size(r, clear[at + 1], axis));
  if (peak.spacing_hz > kWidestSpacing * peak.frequency_hz ||
      beside < kLeastNeighbour * peak.peak) {
    return fmt::format("lines {:.3g} Hz apart are too far apart for this peak: use a longer period",
                       peak.spacing_hz);
  }
  return {};
}

MeasuredPeak PeakOf(const FrequencyResponse& r, Index axis) {
  MeasuredPeak peak;
  peak.channel = r.channels[static_cast<std::size_t>(axis)];
  const std::vector<std::size_t> clear = ClearLines(r, axis);
  if (clear.empty()) {
    peak.refused = "no line is clear of noise: excite more, or longer";
    return peak;
  }
  const std::vector<SmoothedLine> smooth = SmoothedSensitivity(r, axis);
  const auto single =
      std::ranges::max_element(clear, {}, [&](std::size_t line) { return Size(r, line, axis); });
  peak.line_peak = Size(r, *single, axis);
  peak.line_sigma = Sigma(r, *single, axis);
  const auto largest =
      std::ranges::max_element(clear, {}, [&](std::size_t line) { return smooth[line].size; });
  const auto at = static_cast<std::size_t>(largest - clear.begin());
  peak.peak = smooth[*largest].size;
  peak.sigma = smooth[*largest].sigma;
  peak.lines = smooth[*largest].lines;
  peak.frequency_hz = r.frequency_hz[*largest];
  for (const std::size_t beside : {at == 0 ? at : at - 1, std::min(at + 1, clear.size() - 1)}) {
    peak.spacing_hz =
        std::max(peak.spacing_hz, std::abs(r.frequency_hz[clear[beside]] - peak.frequency_hz));
  }
  peak.refused = Objection(r, axis, clear, at, peak);
  if (peak.refused.empty()) peak.zone = analysis::ZoneOf(peak.peak);
  return peak;
}

}  // namespace

std::vector<MeasuredPeak> MeasuredPeaks(const FrequencyResponse& response) {
  std::vector<MeasuredPeak> peaks;
  for (Index axis = 0; axis < response.axes(); ++axis) peaks.push_back(PeakOf(response, axis));
  return peaks;
}

bool Disagree(double computed, double measured) noexcept {
  return std::abs(computed - measured) > kDisagreement * measured;
}

}  // namespace levitas::identification
