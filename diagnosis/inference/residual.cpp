#include "diagnosis/inference/residual.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "analysis/records/spectrum.hpp"

namespace levitas::diagnosis {
namespace {

constexpr std::size_t kSegment = 2048;

/// One uninterrupted, settled stretch of a run; single lost frames in it have innovations of zero.
struct Piece {
  const Trajectory* run;
  std::size_t first, count;
};

std::vector<Piece> PiecesOf(const std::vector<Trajectory>& runs, std::size_t shortest = kSegment) {
  std::vector<Piece> pieces;
  for (const Trajectory& run : runs) {
    std::size_t first = 0;
    const auto& m = run.moments;
    for (std::size_t n = 0; n <= m.size(); ++n) {
      const bool goes_on = n < m.size() && m[n].settled && !m[n].restarted;
      if (goes_on) continue;
      if (n - first >= shortest) pieces.push_back({&run, first, n - first});
      first = n + 1;
    }
  }
  return pieces;
}

template <class Value>
std::vector<double> Signal(const Piece& piece, Value value) {
  std::vector<double> signal(piece.count);
  for (std::size_t n = 0; n < piece.count; ++n) {
    signal[n] = static_cast<double>(value(piece.run->moments[piece.first + n]));
  }
  return signal;
}

/// Mean density of the highest third of the spectrum: nothing of the rig moves there.
double NoiseDensity(const std::vector<double>& density) {
  std::vector<double> top(density.begin() + static_cast<std::ptrdiff_t>(density.size() * 2 / 3),
                          density.end() - 1);
  double sum = 0.0;
  for (const double d : top) sum += d;
  return top.empty() ? 0.0 : sum / static_cast<double>(top.size());
}

struct Bands {
  double worst_sigma{};
  double worst_ratio{1.0};
  double frequency_hz{};
};

/// Third-octave bands: their mean excess in standard deviations of chance.
Bands JudgeBands(const std::vector<double>& ratio, double spacing_hz, std::size_t averages) {
  Bands bands;
  const double lines_per_average = static_cast<double>(averages) * 0.7;  // half overlap, Hann
  for (double low = 3.0; low < static_cast<double>(ratio.size()) * 0.66; low *= 1.26) {
    const auto from = static_cast<std::size_t>(low);
    const auto to = std::max(from + 1, static_cast<std::size_t>(low * 1.26));
    double sum = 0.0;
    double weighted = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      sum += ratio[i];
      weighted += ratio[i] * static_cast<double>(i);
    }
    const auto lines = static_cast<double>(to - from);
    const double mean = sum / lines;
    const double sigma = (mean - 1.0) * std::sqrt(lines * lines_per_average);
    if (sigma > bands.worst_sigma) {
      bands = {sigma, mean, spacing_hz * weighted / sum};
    }
  }
  return bands;
}

/// Largest squared coherence near the frequency with any axis; 0 when chance may have made it.
double LargestCoherence(const std::vector<Piece>& pieces, std::size_t channel, std::size_t axes,
                        double frequency_hz, double spacing_hz, bool current) {
  double largest = 0.0;
  for (std::size_t a = 0; a < axes; ++a) {
    analysis::Coherence coherence(kSegment);
    for (const Piece& piece : pieces) {
      coherence.Add(Signal(piece, [&](const SamplePoint& m) { return m.innovation_m[channel]; }),
                    Signal(piece, [&](const SamplePoint& m) {
                      return current ? m.command_now_a[a] : m.reading_m[a];
                    }));
    }
    const auto squared = coherence.Squared();
    const auto line = static_cast<std::size_t>(std::lround(frequency_hz / spacing_hz));
    for (std::size_t i = line > 0 ? line - 1 : 0; i <= line + 1 && i < squared.size(); ++i) {
      // Chance exceeds x times its mean with e^-x: once in a thousand looks at three lines of four.
      constexpr double kManyTimes = 9.4;
      if (squared[i] > kManyTimes * coherence.Chance()) largest = std::max(largest, squared[i]);
    }
  }
  return largest;
}

/// Mean over windows of the amplitude at an order, relative to what noise leaves.
double OrderRatio(const std::vector<Piece>& pieces, std::size_t channel, int order,
                  double noise_rms_m) {
  double power = 0.0;
  double chance = 0.0;
  for (const Piece& piece : pieces) {
    for (std::size_t from = 0; from + kSegment <= piece.count; from += kSegment) {
      double c = 0.0;
      double s = 0.0;
      bool turns = true;
      for (std::size_t n = from; n < from + kSegment; ++n) {
        const SamplePoint& m = piece.run->moments[piece.first + n];
        turns = turns && m.speed_rad_per_s > 10.0F;
        c += static_cast<double>(m.innovation_m[channel]) * std::cos(order * m.angle_rad);
        s += static_cast<double>(m.innovation_m[channel]) * std::sin(order * m.angle_rad);
      }
      if (!turns) continue;
      power += c * c + s * s;
      chance += noise_rms_m * noise_rms_m * kSegment;
    }
  }
  return chance > 0.0 ? power / chance : 0.0;
}

/// A line, not the flank of a broad peak: four times the power a few lines away.
bool StandsAlone(const std::vector<double>& ratio, double frequency_hz, double spacing_hz) {
  const auto line = static_cast<std::size_t>(std::lround(frequency_hz / spacing_hz));
  if (line < 6 || line + 6 >= ratio.size()) return false;
  double beside = 0.0;
  for (const std::size_t away : {4U, 5U, 6U}) {
    beside += (ratio[line - away] + ratio[line + away]) / 6.0;
  }
  return std::max({ratio[line - 1], ratio[line], ratio[line + 1]}) > 4.0 * beside;
}

/// Spectrum of one channel against its own noise: the worst band, or a line that is worse.
ChannelResidual ExamineChannel(const std::vector<Piece>& pieces, std::size_t channel_index,
                               analysis::Welch& welch, double rate_hz) {
  for (const Piece& piece : pieces) {
    welch.Add(Signal(
        piece, [channel_index](const SamplePoint& m) { return m.innovation_m[channel_index]; }));
  }
  ChannelResidual channel;
  const auto density = welch.Density();
  const double noise = NoiseDensity(density);
  channel.noise_rms_m = std::sqrt(noise * 0.5 * rate_hz);
  std::vector<double> ratio(density.size());
  for (std::size_t i = 0; i < ratio.size(); ++i) ratio[i] = noise > 0.0 ? density[i] / noise : 0.0;
  const Bands bands = JudgeBands(ratio, welch.line_spacing_hz(), welch.averages());
  channel.sigma = bands.worst_sigma;
  channel.band_ratio = bands.worst_ratio;
  channel.peak_hz = bands.frequency_hz;
  for (std::size_t i = 3; i < ratio.size() * 2 / 3; ++i) {
    const double sigma = (ratio[i] - 1.0) * std::sqrt(static_cast<double>(welch.averages()) * 0.7);
    // A single line needs more than a band: there are many of them, and their law has a tail.
    if (sigma > 2.0 * channel.sigma) {
      channel.sigma = 0.5 * sigma;
      channel.band_ratio = ratio[i];
      channel.peak_hz = static_cast<double>(i) * welch.line_spacing_hz();
    }
  }
  channel.ratio = std::move(ratio);
  return channel;
}

/// The order of the rotation that the worst channel holds most of; 0: none stands out.
int StrongestOrder(const std::vector<Piece>& pieces, std::size_t channel, double noise_rms_m) {
  int strongest = 0;
  double strongest_ratio = 4.0;  // noise leaves 1 +- a few tenths
  for (int order = 1; order <= 6; ++order) {
    const double ratio = OrderRatio(pieces, channel, order, noise_rms_m);
    if (ratio > strongest_ratio) {
      strongest_ratio = ratio;
      strongest = order;
    }
  }
  return strongest;
}

bool IsLineOfTheMains(const Residual& out, const ChannelResidual& worst) {
  for (const double mains : {50.0, 60.0, 100.0, 120.0, 150.0, 180.0}) {
    if (std::abs(out.frequency_hz - mains) < out.line_spacing_hz && worst.band_ratio > 2.0 &&
        StandsAlone(worst.ratio, mains, out.line_spacing_hz)) {
      return true;
    }
  }
  return false;
}

/// Which signal of the loop the worst channel's residual follows at its worst frequency.
std::string CoherentSignal(const RigView& rig, const std::vector<Piece>& pieces,
                           const Residual& out) {
  constexpr double kFollows = 0.05;
  const double spacing = out.line_spacing_hz;
  const double with_current =
      LargestCoherence(pieces, out.worst_channel, rig.axes, out.frequency_hz, spacing, true);
  const double with_position =
      LargestCoherence(pieces, out.worst_channel, rig.axes, out.frequency_hz, spacing, false);
  if (std::max(with_current, with_position) <= kFollows) return out.coherent_with;
  return with_current >= with_position ? "current" : "position";
}

/// Where the model's prediction is no number any more.
struct Departure {
  double time_s{};
  std::size_t channel{};
};

std::optional<Departure> FirstDeparture(const std::vector<Piece>& pieces, std::size_t axes) {
  for (const Piece& piece : pieces) {
    for (std::size_t n = piece.first; n < piece.first + piece.count; ++n) {
      const SamplePoint& m = piece.run->moments[n];
      for (std::size_t a = 0; a < axes; ++a) {
        if (!std::isfinite(m.innovation_m[a])) return Departure{m.time_s, a};
      }
    }
  }
  return std::nullopt;
}

std::string TooShort(const RigView& rig, const std::vector<Trajectory>& runs) {
  std::size_t longest = 0;
  for (const Piece& piece : PiecesOf(runs, 1)) longest = std::max(longest, piece.count);
  std::size_t rows = 0;
  std::size_t starts = 0;
  for (const Trajectory& run : runs) {
    rows += run.moments.size();
    starts += static_cast<std::size_t>(
        std::ranges::count_if(run.moments, [](const SamplePoint& m) { return m.restarted; }));
  }
  return fmt::format(
      "the longest stretch that can be judged has {} samples ({:.3f} s), a spectrum of what "
      "remains "
      "needs {} ({:.3f} s): the {:.2f} s of free flight are in {} piece(s), parted by drop-outs, "
      "contact or trips, and at the start of each the model's observer has to settle. Record "
      "longer, or without drop-outs",
      longest, static_cast<double>(longest) * rig.period_s, kSegment,
      static_cast<double>(kSegment) * rig.period_s, static_cast<double>(rows) * rig.period_s,
      starts);
}

}  // namespace

std::string WhyNotJudged(const RigView& rig, const std::vector<Trajectory>& runs) {
  const auto pieces = PiecesOf(runs);
  if (pieces.empty()) return TooShort(rig, runs);
  if (const auto departure = FirstDeparture(pieces, rig.axes)) {
    return fmt::format(
        "the model of rig {} leaves the readings of {} for good by {:.3f} s of the record (its "
        "prediction is no number): is it the rig that was recorded? A session's own rig is taken "
        "without --rig",
        rig.numbers.name, rig.numbers.channels[departure->channel], departure->time_s);
  }
  const Residual residual = AnalyseResidual(rig, runs);
  for (std::size_t a = 0; a < rig.axes; ++a) {
    if (residual.channels[a].noise_rms_m > 0.0) continue;
    return fmt::format(
        "what the model leaves of {} has no noise at all in the upper third of its spectrum: are "
        "its readings measured ones?",
        rig.numbers.channels[a]);
  }
  return {};
}

Residual AnalyseResidual(const RigView& rig, const std::vector<Trajectory>& runs) {
  Residual out;
  const auto pieces = PiecesOf(runs);
  const double rate_hz = 1.0 / rig.period_s;
  for (std::size_t a = 0; a < rig.axes; ++a) {
    analysis::Welch welch(kSegment, rate_hz);
    out.channels.push_back(ExamineChannel(pieces, a, welch, rate_hz));
    out.line_spacing_hz = welch.line_spacing_hz();
  }
  for (std::size_t a = 0; a < rig.axes; ++a) {
    if (out.channels[a].sigma > out.channels[out.worst_channel].sigma) out.worst_channel = a;
  }
  if (out.channels.empty() || pieces.empty()) return out;
  const ChannelResidual& worst = out.channels[out.worst_channel];
  out.sigma = worst.sigma;
  out.frequency_hz = worst.peak_hz;
  if (const int order = StrongestOrder(pieces, out.worst_channel, worst.noise_rms_m); order > 0) {
    out.order = order;
    out.coherent_with = "rotation";
  } else if (IsLineOfTheMains(out, worst)) {
    out.coherent_with = "mains";
  } else {
    out.coherent_with = CoherentSignal(rig, pieces, out);
  }
  return out;
}

}  // namespace levitas::diagnosis
