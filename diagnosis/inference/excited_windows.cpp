#include "diagnosis/inference/excited_windows.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace levitas::diagnosis {
namespace {

using Rows = std::vector<analysis::RecordedRow>;

/// Sum of the squares of an axis' test signal up to each row, so that a stretch is a difference.
std::vector<double> Energy(const Rows& rows, std::size_t axis) {
  std::vector<double> sum(rows.size() + 1);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const double signal = rows[n].levitated ? rows[n].excitation_a[axis] : 0.0;
    sum[n + 1] = sum[n] + signal * signal;
  }
  return sum;
}

double Of(const std::vector<double>& sum, const Window& window) {
  return sum[window.first + window.length] - sum[window.first];
}

bool Misses(const std::vector<double>& energy, const std::vector<Window>& windows) {
  constexpr double kOfItsShare = 0.5;
  double held = 0.0;
  std::size_t rows = 0;
  for (const Window& window : windows) {
    held += Of(energy, window);
    rows += window.length;
  }
  const double share = static_cast<double>(rows) / static_cast<double>(energy.size() - 1);
  return held < kOfItsShare * share * energy.back();
}

bool Overlap(const Window& a, const Window& b) {
  return a.first < b.first + b.length && b.first < a.first + a.length;
}

/// The window with the largest value that overlaps none of those taken; nothing: there is none.
template <class Value>
std::optional<Window> Best(const Rows& rows, std::size_t length, const std::vector<Window>& taken,
                           const Value& value) {
  std::optional<Window> best;
  double largest = 0.0;
  const std::size_t step = std::max<std::size_t>(1, length / 8);
  for (std::size_t first = 0; first + length <= rows.size(); first += step) {
    const Window window{first, length};
    if (std::ranges::any_of(taken, [&](const Window& other) { return Overlap(window, other); })) {
      continue;
    }
    const double here = value(window);
    if (!(here > largest)) continue;
    largest = here;
    best = window;
  }
  return best;
}

}  // namespace

std::vector<Window> TellingWindows(const Rows& rows, std::vector<Window> even,
                                   std::size_t shortest) {
  std::vector<std::vector<double>> signals;
  bool missed = false;
  for (std::size_t axis = 0; axis < kMaxAxes; ++axis) {
    std::vector<double> energy = Energy(rows, axis);
    if (energy.back() == 0.0) continue;
    missed = missed || Misses(energy, even);
    signals.push_back(std::move(energy));
  }
  if (!missed) return even;
  std::size_t budget = 0;
  for (const Window& window : even) budget += window.length;
  const std::size_t count = std::min(std::max(even.size(), signals.size() + 1), budget / shortest);
  if (count < signals.size()) return even;
  const std::size_t length = budget / count;
  std::vector<Window> windows;
  const auto take = [&](const auto& value) {
    if (windows.size() == count) return;
    if (const auto best = Best(rows, length, windows, value)) windows.push_back(*best);
  };
  for (const auto& energy : signals) {
    take([&](const Window& window) { return Of(energy, window); });
  }
  take([&](const Window& window) {
    const auto& middle = rows[window.first + window.length / 2];
    return middle.levitated ? std::abs(middle.sample.speed_rad_per_s) : 0.0;
  });
  for (const auto& energy : signals) {
    take([&](const Window& window) { return Of(energy, window); });
  }
  std::ranges::sort(windows, {}, &Window::first);
  return windows;
}

}  // namespace levitas::diagnosis
