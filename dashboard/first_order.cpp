#include "dashboard/first_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dashboard/full_spectrum.hpp"

namespace levitas::dashboard {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kFewestTurns = 2.0;

/// How many of the newest samples are whole turns; 0: too few of them.
std::size_t WholeTurns(const SampleStore& store) {
  const std::size_t most = std::min(store.contiguous(), kSpectrumLength);
  double turned = 0.0;
  double turns = kFewestTurns;  // the next number of whole turns to be found
  std::size_t whole = 0;
  for (std::size_t back = 0; back + 1 < most; ++back) {
    const double step = std::remainder(
        static_cast<double>(store.Angle(back)) - static_cast<double>(store.Angle(back + 1)), kTurn);
    if (!std::isfinite(step)) return 0;
    turned += step;
    if (std::abs(turned) < turns * kTurn) continue;
    whole = back + 1;
    turns += 1.0;
  }
  return whole;
}

}  // namespace

std::optional<std::vector<std::complex<double>>> FirstOrderOf(const SampleStore& store) {
  const std::size_t samples = WholeTurns(store);
  if (samples == 0) return std::nullopt;
  std::vector<std::complex<double>> turning;
  for (std::size_t back = 0; back < samples; ++back) {
    turning.push_back(std::polar(1.0, -static_cast<double>(store.Angle(back))));
  }
  std::vector<std::complex<double>> orders;
  for (std::size_t axis = 0; axis < store.axes(); ++axis) {
    double mean = 0.0;
    for (std::size_t back = 0; back < samples; ++back) {
      mean += static_cast<double>(store.Position(axis, back)) / static_cast<double>(samples);
    }
    std::complex<double> sum;
    for (std::size_t back = 0; back < samples; ++back) {
      sum += (static_cast<double>(store.Position(axis, back)) - mean) * turning[back];
    }
    if (!std::isfinite(sum.real())) return std::nullopt;
    orders.push_back(2.0 * sum / static_cast<double>(samples));
  }
  return orders;
}

}  // namespace levitas::dashboard
