// Test signals of a run: how each begins, and that those of one time are not correlated.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "report/session/pictures.hpp"

namespace levitas::report {
namespace {

constexpr std::size_t kPoints = 200;
constexpr double kGapS = 0.05;
constexpr int kLags = 20;  ///< points, on either side
/// Points that the correlation is of: those of a published identification of a pump, twice.
constexpr std::size_t kCorrelated = 16'000;

struct Signal {
  std::size_t channel{};
  std::size_t first{}, last{};  ///< rows, both included
  std::size_t hold{1};          ///< rows of one point, which a binary sequence holds
};

/// Rows of one point: the shortest time for which a value is held.
std::size_t HoldOf(const std::vector<float>& values, std::size_t first, std::size_t last) {
  std::size_t since = first;
  std::size_t shortest = last - first + 1;
  for (std::size_t i = first + 1; i <= last; ++i) {
    if (values[i] == values[i - 1]) continue;
    shortest = std::min(shortest, i - since);
    since = i;
  }
  return std::max<std::size_t>(shortest, 1);
}

/// Signals of a channel in turn: what is zero for kGapS lies between two of them.
std::vector<Signal> SignalsOf(const Recording& r, std::size_t channel) {
  const std::vector<float>& values = r.excitation[channel];
  const auto gap = static_cast<std::size_t>(std::lround(kGapS / r.rig.period_s()));
  std::vector<Signal> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] == 0.0F) continue;
    if (found.empty() || i - found.back().last > gap) found.push_back({channel, i, i, 1});
    found.back().last = i;
  }
  for (Signal& signal : found) signal.hold = HoldOf(values, signal.first, signal.last);
  return found;
}

std::vector<std::vector<Signal>> Signals(const Recording& r) {
  std::vector<std::vector<Signal>> found;
  for (std::size_t channel = 0; channel < r.excitation.size(); ++channel) {
    auto own = SignalsOf(r, channel);
    if (!own.empty()) found.push_back(std::move(own));
  }
  return found;
}

std::string NameOf(const Recording& r, std::size_t channel) { return r.rig.channels.at(channel); }

NamedPicture Beginnings(const Recording& r, const std::vector<std::vector<Signal>>& signals) {
  const double to_unit = r.excitation_at_reading ? kUm : 1.0;
  const std::string where = r.excitation_at_reading ? "at the reading" : "at the current";
  NamedPicture picture{
      "test_signals",
      fmt::format("The first test signal of each axis, its first {} points.", kPoints),
      {}};
  for (const std::vector<Signal>& own : signals) {
    const Signal& signal = own.front();
    svg::Series series{.colour = svg::Colour(0)};
    const std::size_t end = std::min(signal.first + kPoints * signal.hold, signal.last + 1);
    // A value is held until the next: two ends of each step are drawn.
    for (std::size_t i = signal.first; i < end; ++i) {
      const double value = to_unit * static_cast<double>(r.excitation[signal.channel][i]);
      const double from_ms = 1e3 * r.rig.period_s() * static_cast<double>(i - signal.first);
      if (!series.y.empty() && series.y.back() == value && i + 1 < end) continue;
      if (!series.y.empty()) {
        series.x.push_back(from_ms);
        series.y.push_back(series.y.back());
      }
      series.x.push_back(from_ms);
      series.y.push_back(value);
    }
    svg::Panel panel{fmt::format("{} {}, from {:.3f} s, {:g} ms a point", NameOf(r, signal.channel),
                                 where, r.TimeOf(signal.first),
                                 1e3 * r.rig.period_s() * static_cast<double>(signal.hold)),
                     "time since it began, ms",
                     r.excitation_at_reading ? "signal, µm" : "signal, A"};
    panel.series.push_back(std::move(series));
    svg::Figure one = Wide(std::move(panel));
    if (picture.figure.panels.empty())
      picture.figure = one;
    else
      picture.figure.panels.push_back(std::move(one.panels.front()));
  }
  picture.figure.panel_height = 130;
  return picture;
}

/// Points of two signals while both act, about their means.
struct Both {
  std::vector<double> a, b;
  double size{};  ///< sqrt of the product of both sums of squares
};

Both Points(const Recording& r, const Signal& a, const Signal& b) {
  Both both;
  const std::size_t from = std::max(a.first, b.first);
  const std::size_t to = std::min(a.last, b.last);
  const std::size_t hold = std::max(a.hold, b.hold);
  for (std::size_t i = from; i <= to && from < to && both.a.size() < kCorrelated; i += hold) {
    both.a.push_back(r.excitation[a.channel][i]);
    both.b.push_back(r.excitation[b.channel][i]);
  }
  std::array<double, 2> squares{};
  for (const auto& [values, square] : {std::pair{&both.a, &squares[0]}, {&both.b, &squares[1]}}) {
    double mean = 0.0;
    for (const double value : *values) mean += value / static_cast<double>(values->size());
    for (double& value : *values) {
      value -= mean;
      *square += value * value;
    }
  }
  both.size = std::sqrt(squares[0] * squares[1]);
  return both;
}

double Coefficient(const Both& both, int lag) {
  double sum = 0.0;
  const auto count = static_cast<int>(both.a.size());
  for (int i = std::max(0, -lag); i < std::min(count, count - lag); ++i) {
    sum += both.a[static_cast<std::size_t>(i)] * both.b[static_cast<std::size_t>(i + lag)];
  }
  return sum / both.size;
}

/// The first two signals of two channels that act at one time for long enough; empty: none do.
std::optional<Both> Together(const Recording& r, const std::vector<Signal>& some,
                             const std::vector<Signal>& others) {
  for (const Signal& one : some) {
    for (const Signal& other : others) {
      Both both = Points(r, one, other);
      if (both.a.size() > static_cast<std::size_t>(2 * kLags) && both.size > 0.0) return both;
    }
  }
  return std::nullopt;
}

std::vector<NamedPicture> Correlations(const Recording& r,
                                       const std::vector<std::vector<Signal>>& signals) {
  svg::Panel panel{"correlation of test signals that act at one time",
                   "lag, points of the slower one", "coefficient"};
  std::size_t colour = 0;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    for (std::size_t j = i + 1; j < signals.size(); ++j) {
      const auto both = Together(r, signals[i], signals[j]);
      if (!both) continue;
      svg::Series series{.name = fmt::format("{} with {}", NameOf(r, signals[i].front().channel),
                                             NameOf(r, signals[j].front().channel)),
                         .colour = svg::Colour(colour++)};
      for (int lag = -kLags; lag <= kLags; ++lag) {
        series.x.push_back(lag);
        series.y.push_back(Coefficient(*both, lag));
      }
      panel.series.push_back(std::move(series));
    }
  }
  if (panel.series.empty()) return {};
  panel.y_range = svg::Range{-1.0, 1.0};
  return {
      {"test_signal_correlation",
       "Near zero the signals are uncorrelated, as an identification of all axes at once needs.",
       Wide(std::move(panel))}};
}

}  // namespace

std::vector<NamedPicture> ExcitationPictures(const Recording& recording) {
  const auto signals = Signals(recording);
  if (signals.empty()) return {};
  std::vector<NamedPicture> pictures{Beginnings(recording, signals)};
  for (NamedPicture& picture : Correlations(recording, signals))
    pictures.push_back(std::move(picture));
  return pictures;
}

}  // namespace levitas::report
