// Torque of the measured couplings of a geared rig: over the run, and its half spectrum.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "analysis/full_spectrum.hpp"
#include "common/rotational_speed.hpp"
#include "report/session/pictures.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kStretches = 500;  // about one per pixel of a picture
constexpr std::size_t kLength = 8192;    ///< rows of a spectrum

double TorqueAt(const Recording& r, std::size_t coupling, std::size_t row) {
  const std::int64_t at = r.torsion_row[row];
  if (at < 0) return std::numeric_limits<double>::quiet_NaN();
  return r.torsion.torque_n_m[coupling][static_cast<std::size_t>(at)];
}

/// Least and largest of each stretch of time.
std::array<svg::Series, 2> Edges(const Recording& r, std::size_t coupling) {
  std::array<svg::Series, 2> edges;
  for (svg::Series& edge : edges) {
    edge.colour = svg::Colour(coupling);
    edge.width = 1.0;
  }
  edges[0].name = r.torsion.couplings[coupling];
  const std::size_t size = std::max<std::size_t>(1, (r.size() + kStretches - 1) / kStretches);
  for (std::size_t first = 0; first < r.size(); first += size) {
    double least = std::numeric_limits<double>::quiet_NaN();
    double most = least;
    for (std::size_t i = first; i < std::min(first + size, r.size()); ++i) {
      const double torque = TorqueAt(r, coupling, i);
      least = std::fmin(least, torque);  // ignores what is not a number
      most = std::fmax(most, torque);
    }
    for (svg::Series& edge : edges) edge.x.push_back(r.TimeOf(first));
    edges[0].y.push_back(most);
    edges[1].y.push_back(least);
  }
  return edges;
}

NamedPicture OverTime(const Recording& r) {
  svg::Panel panel{"torque of the couplings, beside the mean load", "time, s", "torque, N m"};
  for (std::size_t c = 0; c < r.torsion.couplings.size(); ++c) {
    for (svg::Series& edge : Edges(r, c)) panel.series.push_back(std::move(edge));
  }
  panel.x_range = svg::Range{0.0, r.TimeOf(r.size() - 1)};
  return {"torque",
          "Least and largest torque of each measured coupling, per stretch of time; the mean that "
          "the load brings is not in it.",
          Wide(std::move(panel))};
}

/// Behind the last kLength rows at the top speed (within 0.3 %) of which no torque is lost.
std::optional<std::size_t> EndOfTop(const Recording& r) {
  constexpr double kSameSpeed = 0.003;
  std::optional<std::size_t> end;
  for (std::size_t i = r.size(); i-- > 0;) {
    const double speed = std::abs(static_cast<double>(r.speed_rad_per_s[i]));
    const bool here = r.torsion_row[i] >= 0 && r.top_speed_rad_per_s > 0.0 &&
                      speed >= (1.0 - kSameSpeed) * r.top_speed_rad_per_s;
    if (!here) {
      end.reset();
      continue;
    }
    if (!end) end = i + 1;
    if (*end - i == kLength) return end;
  }
  return std::nullopt;
}

std::vector<NamedPicture> AtTopSpeed(const Recording& r) {
  const std::optional<std::size_t> end = EndOfTop(r);
  if (!end || !r.Uninterrupted(*end - kLength, *end - 1)) return {};
  const double line_hz = 1.0 / (r.rig.period_s() * static_cast<double>(kLength));
  svg::Panel panel{
      fmt::format("half spectrum of the torque at {:.0f} rpm", RadPerSToRpm(r.top_speed_rad_per_s)),
      "frequency, Hz", "torque, N m"};
  panel.y_scale = svg::Scale::kLogarithmic;
  for (std::size_t c = 0; c < r.torsion.couplings.size(); ++c) {
    std::vector<std::complex<double>> torque;
    for (std::size_t i = *end - kLength; i < *end; ++i) torque.emplace_back(TorqueAt(r, c, i), 0.0);
    constexpr std::size_t kLines = kLength / 2 - 1;
    const std::vector<double> both = analysis::FullAmplitudes(std::move(torque), kLines);
    svg::Series series{.name = r.torsion.couplings[c], .colour = svg::Colour(c)};
    series.width = 0.9;
    // Forward and backward half are alike: of a real signal one is shown, with both amplitudes.
    for (std::size_t k = 1; k <= kLines; ++k) {
      series.x.push_back(static_cast<double>(k) * line_hz);
      series.y.push_back(2.0 * both[kLines + k]);
    }
    panel.series.push_back(std::move(series));
  }
  return {{"torque_spectrum",
           "Amplitudes of the torque of each measured coupling over the last 8192 samples at the "
           "top speed; between the lines stands the noise of the gauges.",
           Wide(std::move(panel))}};
}

}  // namespace

std::vector<NamedPicture> TorsionPictures(const Recording& recording) {
  if (recording.torsion.rows() == 0) return {};
  std::vector<NamedPicture> pictures{OverTime(recording)};
  for (NamedPicture& picture : AtTopSpeed(recording)) pictures.push_back(std::move(picture));
  return pictures;
}

}  // namespace levitas::report
