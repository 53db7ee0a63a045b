#include "analysis/records/innovations.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "analysis/records/departures.hpp"
#include "analysis/records/excitation_coherence.hpp"
#include "analysis/records/spectrum.hpp"
#include "common/problem.hpp"
#include "numerics/hann_window.hpp"

namespace levitas::analysis {
namespace {

constexpr std::array kBandEdgesHz{0.0,   10.0,  30.0,   70.0,   130.0, 200.0,
                                  350.0, 600.0, 1000.0, 2000.0, 1e9};
constexpr int kHighestOrder = 3;
constexpr std::size_t kWindows = 10;
/// Long enough for lines 2.4 Hz apart at 10 kHz, short enough to average over a second of record.
constexpr std::size_t kLongestSegment = 4096;
constexpr std::size_t kShortestSegment = 256;
/// Orders: a window must hold this many turns to tell neighbouring orders apart.
constexpr double kTurnsPerWindow = 5.0;
constexpr std::size_t kOrderWindow = 2048;
/// Power of a Hann window: mean square over squared mean.
constexpr double kHannNoise = 1.5;

std::size_t SegmentFor(const InnovationRun& run) {
  std::size_t longest = 0;
  for (const auto& piece : run.pieces) longest = std::max(longest, piece.size());
  std::size_t segment = kLongestSegment;
  while (segment > kShortestSegment && segment > longest / 2) segment /= 2;
  if (longest >= segment) return segment;
  throw BadInput(fmt::format(
      "the record holds {} consecutive samples that can be compared ({} left out while the "
      "observer settles, {} while not levitated), at least {} are needed: give a longer record",
      longest, run.settling_rows, run.idle_rows, kShortestSegment));
}

/// All compared rows of one channel, and where the pieces begin.
std::vector<std::vector<double>> ChannelPieces(const InnovationRun& run, std::size_t channel) {
  std::vector<std::vector<double>> pieces;
  for (const auto& piece : run.pieces) {
    pieces.emplace_back();
    for (const auto& row : piece) pieces.back().push_back(row.innovation_m[channel]);
  }
  return pieces;
}

double Ratio(double power, double expected) { return std::sqrt(power / expected); }

/// Share of `excess`, the channel's unexplained power, that lies in a place.
double Share(double power, double expected, double excess) {
  return excess > 0.0 ? std::max(0.0, power - expected) / excess : 0.0;
}

void TimeFigures(const std::vector<std::vector<double>>& pieces, ChannelReport& report) {
  double power = 0.0;
  double neighbours = 0.0;
  std::size_t count = 0;
  for (const auto& piece : pieces) {
    for (std::size_t i = 0; i < piece.size(); ++i) {
      power += piece[i] * piece[i];
      if (i > 0) neighbours += piece[i] * piece[i - 1];
      report.peak_m = std::max(report.peak_m, std::abs(piece[i]));
    }
    count += piece.size();
  }
  report.rms_m = std::sqrt(power / static_cast<double>(count));
  report.lag_one = power > 0.0 ? neighbours / power : 0.0;
}

void Spectrum(const std::vector<std::vector<double>>& pieces, std::size_t segment,
              double sample_rate_hz, double expected_m2, ChannelReport& report) {
  Welch welch(segment, sample_rate_hz);
  for (const auto& piece : pieces) welch.Add(piece);
  report.density_m2_per_hz = welch.Density();
  const double spacing_hz = welch.line_spacing_hz();
  const double expected_density = expected_m2 / (0.5 * sample_rate_hz);
  const double excess = report.rms_m * report.rms_m - expected_m2;
  const auto& density = report.density_m2_per_hz;
  const auto top = std::max_element(density.begin(), density.end());
  report.dominant_hz = static_cast<double>(top - density.begin()) * spacing_hz;
  report.dominant_ratio = *top / expected_density;
  for (std::size_t b = 0; b + 1 < kBandEdgesHz.size(); ++b) {
    double power = 0.0;
    double expected = 0.0;
    for (std::size_t line = 0; line < density.size(); ++line) {
      const double f = static_cast<double>(line) * spacing_hz;
      if (f < kBandEdgesHz[b] || f >= kBandEdgesHz[b + 1]) continue;
      power += density[line] * spacing_hz;
      expected += expected_density * spacing_hz;
    }
    if (expected == 0.0) continue;
    report.bands.push_back({kBandEdgesHz[b], std::min(kBandEdgesHz[b + 1], 0.5 * sample_rate_hz),
                            Ratio(power, expected), Share(power, expected, excess)});
  }
}

/// Mean square of the line of one order in one window, as an amplitude squared; negative: the rotor
/// turns too slowly in this window.
double OrderAmplitude2(const std::vector<InnovationRow>& piece, std::size_t start,
                       std::size_t channel, int order, double period_s) {
  std::complex<double> sum{};
  double weights = 0.0;
  double turns = 0.0;
  for (std::size_t i = 0; i < kOrderWindow; ++i) {
    const InnovationRow& row = piece[start + i];
    const double weight = numerics::HannWeight(i, kOrderWindow);
    sum += weight * row.innovation_m[channel] * std::polar(1.0, -order * row.angle_rad);
    weights += weight;
    turns += std::abs(row.speed_rad_per_s) * period_s / (2.0 * std::numbers::pi);
  }
  return turns < kTurnsPerWindow ? -1.0 : std::norm(2.0 * sum / weights);
}

void Orders(const InnovationRun& run, std::size_t channel, double expected_m2,
            ChannelReport& report) {
  // White noise leaves this mean squared amplitude in a window.
  const double floor_m2 = 4.0 * expected_m2 * kHannNoise / kOrderWindow;
  const double excess = report.rms_m * report.rms_m - expected_m2;
  for (int order = 1; order <= kHighestOrder; ++order) {
    double sum = 0.0;
    std::size_t windows = 0;
    for (const auto& piece : run.pieces) {
      for (std::size_t s = 0; s + kOrderWindow <= piece.size(); s += kOrderWindow / 2) {
        const double amplitude2 = OrderAmplitude2(piece, s, channel, order, run.period_s);
        if (amplitude2 < 0.0) continue;
        sum += amplitude2;
        ++windows;
      }
    }
    if (windows == 0) return;
    const double amplitude2 = sum / static_cast<double>(windows);
    report.orders.push_back({order, std::sqrt(amplitude2), Ratio(amplitude2, floor_m2),
                             Share(0.5 * amplitude2, 0.5 * floor_m2, excess)});
  }
}

void Windows(const InnovationRun& run, std::size_t channel, double expected_m2,
             ChannelReport& report) {
  const std::uint64_t rows = run.rows();
  const std::uint64_t length = (rows + kWindows - 1) / kWindows;
  const std::uint64_t first = run.first_cycle;
  double power = 0.0;
  double speed = 0.0;
  std::uint64_t count = 0;
  std::uint64_t start = first;
  const auto finish = [&](std::uint64_t end) {
    const auto n = static_cast<double>(count);
    report.windows.push_back({static_cast<double>(start - first) * run.period_s,
                              static_cast<double>(end - first) * run.period_s, speed / n,
                              Ratio(power / n, expected_m2)});
    power = speed = 0.0;
    count = 0;
  };
  for (const auto& piece : run.pieces) {
    for (const auto& row : piece) {
      if (count == 0) start = row.cycle;
      power += row.innovation_m[channel] * row.innovation_m[channel];
      speed += row.speed_rad_per_s;
      if (++count == length) finish(row.cycle + 1);
    }
  }
  if (count > 0) finish(run.pieces.back().back().cycle + 1);
}

}  // namespace

InnovationReport Examine(const InnovationRun& run, const ObserverGain& gain, std::size_t axes) {
  const std::size_t segment = SegmentFor(run);
  const double sample_rate_hz = 1.0 / run.period_s;
  InnovationReport report;
  report.duration_s = static_cast<double>(run.rows()) * run.period_s;
  report.line_spacing_hz = sample_rate_hz / static_cast<double>(segment);
  for (std::size_t channel = 0; channel < axes; ++channel) {
    const auto pieces = ChannelPieces(run, channel);
    const double expected_m = gain.expected_innovation_m[channel];
    const double expected_m2 = expected_m * expected_m;
    ChannelReport entry;
    TimeFigures(pieces, entry);
    entry.multiple = entry.rms_m / gain.sensor_noise_m[channel];
    entry.expected_multiple = expected_m / gain.sensor_noise_m[channel];
    Spectrum(pieces, segment, sample_rate_hz, expected_m2, entry);
    entry.excitation = FollowExcitation(run, channel, axes, kBandEdgesHz);
    Orders(run, channel, expected_m2, entry);
    Windows(run, channel, expected_m2, entry);
    report.channels.push_back(std::move(entry));
  }
  report.departures = Departures(report.channels);
  return report;
}

}  // namespace levitas::analysis
